// The kernels of a step, each on its own, on the default block of 10 000 tetrahedra: time and nanoseconds per
// item.
#include <benchmark/benchmark.h>

#include "acus/needle/column.h"
#include "acus/needle/rod_motion.h"
#include "acus/sim/simulation.h"
#include "acus/sim/step.h"

namespace {

using namespace acus;

const Model& model() {
  static const Model built = build_model(Scene{}, nullptr).value();
  return built;
}

// A step's working memory with the matrix at rest, and a field.
struct Assembled {
  Scratch scratch = build_scratch(model());
  numeric::NodeVector x = initial_state(model()).velocity;
  numeric::NodeVectorOf<float> single;
  Assembled() {
    tissue::corotate_into(scratch.corotation, model().tissue, model().mesh.nodes);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = i % 4 < 3 ? std::sin(static_cast<double>(i)) : 0.0;
    single.assign(x.begin(), x.end());
  }
};

void count(benchmark::State& state, int items) {
  state.counters["ns_per_item"] = benchmark::Counter(
      1e-9 * items, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// Of tissue that is sheared to and fro, by what a step turns it near a needle.
void rotation_and_force(benchmark::State& state) {
  Assembled a;
  std::vector<Vec3> there = model().mesh.nodes, back = there;
  constexpr double shear = 1e-3;
  for (Vec3& x : there) x.x() += shear * x.z();
  for (auto _ : state) {
    tissue::corotate_into(a.scratch.corotation, model().tissue, there);
    std::swap(there, back);
  }
  count(state, model().tissue.tets);
}
BENCHMARK(rotation_and_force);

void matrix_product(benchmark::State& state) {
  Assembled a;
  numeric::NodeVector y = a.x;
  const tissue::Corotation exact = tissue::build_corotation(model().tissue);
  for (auto _ : state) tissue::multiply_into(y, model().tissue, exact, a.scratch.matrix, a.x);
  count(state, model().tissue.tets);
}
BENCHMARK(matrix_product);

void matrix_product_single(benchmark::State& state) {
  Assembled a;
  numeric::NodeVectorOf<float> y = a.single;
  for (auto _ : state)
    tissue::multiply_into(y, model().tissue, a.scratch.corotation, a.scratch.matrix, a.single);
  count(state, model().tissue.tets);
}
BENCHMARK(matrix_product_single);

void coarse_correction(benchmark::State& state) {
  Assembled a;
  numeric::NodeVectorOf<float> z = a.single;
  for (auto _ : state) numeric::add_coarse_correction_into(z, model().coarse, a.single, a.scratch.coarse);
  count(state, model().tissue.free_nodes);
}
BENCHMARK(coarse_correction);

void conjugate_gradient_iteration(benchmark::State& state) {
  Assembled a;
  using Single = numeric::NodeVectorOf<float>;
  constexpr int iterations = 20;
  for (auto _ : state) {
    Single v(a.single.size(), 0.0F);
    numeric::solve_into(
        v, a.single, 0.0, iterations, a.scratch.solver.single,
        [&](Single& y, const Single& p) {
          tissue::multiply_into(y, model().tissue, a.scratch.corotation, a.scratch.matrix, p);
        },
        [&](Single& z, const Single& r) {
          numeric::multiply_blocks_into(z, model().inverse_block, r);
          numeric::add_coarse_correction_into(z, model().coarse, r, a.scratch.coarse);
        });
  }
  count(state, iterations * model().tissue.free_nodes);
}
BENCHMARK(conjugate_gradient_iteration);

void disc_embedding(benchmark::State& state) {
  coupling::Attachment at;
  constexpr double depth = 20.3e-3;  // m
  for (auto _ : state) attach_tip_into(at, model(), depth);
  count(state, 1);
}
BENCHMARK(disc_embedding);

void column_response(benchmark::State& state) {
  constexpr double free_length = 0.15, shortening = 1e-3;  // m
  for (auto _ : state)
    benchmark::DoNotOptimize(needle::column_response(model().column, free_length, shortening));
  count(state, 1);
}
BENCHMARK(column_response);

// A needle of 60 elements in disorder, and what a step of it takes.
struct MovingRod {
  needle::Rod rod = needle::build_rod(needle::NeedleSpec{}, 60);
  needle::Pose hub;
  needle::RodState state = needle::unloaded_rod(rod, hub);
  needle::RodMotion motion = needle::build_rod_motion(rod);
  static constexpr double h = 1e-3;  // s
  MovingRod() {
    for (int i = 0; i < rod.unknowns(); ++i)
      motion.change[i] = (needle::is_spin(i) ? 1e-2 : 1e-5) * std::sin(0.7 * i);
    needle::displace(state, rod, motion.change);
  }
  void linearise() {
    needle::linearise(motion, rod, state, hub, hub, h, 0.0);
    needle::hold_hub(motion);
  }
  void solve() {
    motion.change = motion.residual;
    motion.matrix.solve(motion.change.data());
  }
};

void rod_linearisation(benchmark::State& state) {
  MovingRod r;
  for (auto _ : state) r.linearise();
  count(state, r.rod.edges);
}
BENCHMARK(rod_linearisation);

void rod_factorisation(benchmark::State& state) {
  MovingRod r;
  r.linearise();
  const needle::RodMatrix matrix = r.motion.matrix;
  for (auto _ : state) {
    r.motion.matrix = matrix;
    benchmark::DoNotOptimize(r.motion.matrix.factor());
  }
  count(state, r.rod.edges);
}
BENCHMARK(rod_factorisation);

// A whole step of a rod that buckles against a stop, its books included.
void rod_step(benchmark::State& state) {
  Scene scene;
  scene.tissue.rigid = true;
  Simulation simulation = Simulation::build(scene).value();
  double travel = 0.0;
  constexpr double advance = 10e-6, farthest = 40e-3;  // m: 10 mm/s
  for (auto _ : state) {
    if (travel > farthest) {
      state.PauseTiming();
      simulation = Simulation::build(scene).value();
      travel = 0.0;
      state.ResumeTiming();
    }
    simulation.step(travel += advance);
  }
}
BENCHMARK(rod_step);

void rod_solution(benchmark::State& state) {
  MovingRod r;
  r.linearise();
  r.motion.matrix.factor();
  for (auto _ : state) r.solve();
  count(state, r.rod.edges);
}
BENCHMARK(rod_solution);

void rod_newton_iteration(benchmark::State& state) {
  MovingRod r;
  for (auto _ : state) {
    r.linearise();
    r.motion.matrix.factor();
    r.solve();
    needle::apply_change(r.motion, r.rod, r.state, r.h);
  }
  count(state, r.rod.edges);
}
BENCHMARK(rod_newton_iteration);

}  // namespace

BENCHMARK_MAIN();
