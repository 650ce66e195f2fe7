#include "step_cost.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <vector>

#include "acus/sim/rod_contact.h"
#include "acus/sim/rod_step.h"
#include "reference_step.h"

namespace acus::bench {
namespace {

constexpr int turns = 10;           // of reference and engine, one after the other
constexpr int reference_warm = 40;  // steps, until its residual has settled
constexpr double depth = 20e-3;     // m, of needle inside the tissue while measuring

double processor_us() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// A needle short enough not to buckle that goes in quickly and then at the default speed.
Scene scene_for(int tetrahedra, double tolerance) {
  Scene scene;
  scene.needle.length = 0.12;
  scene.tissue.tetrahedra = tetrahedra;
  scene.contact.rupture_force = 0.2;
  scene.run.solver_tolerance = tolerance;
  return scene;
}
constexpr double approach_speed = 0.1;  // m/s
constexpr int settling_steps = 50;      // at the default speed, before measuring

struct Residual {
  double of_momentum = 0.0, of_load = 0.0;
};

// Of the step just solved, its contact and friction with the forces they really have.
Residual true_residual(const Model& m, const State& s, const Scratch& w, numeric::NodeVector& product) {
  const double h = m.scene.run.time_step;
  numeric::NodeVector b = w.momentum;
  double load = 0.0;  // N
  for (const RodContact& c : w.rod.contacts) {
    const Vec3 force = contact_load(c, h * (at_contact(s.needle.rod.rate, c) - tissue_rate(s, c)));
    coupling::add_spread(b, *c.at, h * force);
    load += force.norm();
  }
  tissue::multiply_into(product, m.tissue, w.corotation, w.matrix, s.velocity);
  const double norm = std::sqrt(numeric::dot(b, b));
  numeric::add_scaled_into(b, -1.0, product);
  const double left = std::sqrt(numeric::dot(b, b));
  return {left / norm, left / (h * load)};
}

// The engine's step with a stop watch on its parts.
class MeasuredInsertion {
 public:
  explicit MeasuredInsertion(Model model)
      : model_(std::move(model)), state_(initial_state(model_)), scratch_(build_scratch(model_)) {
    tissue::corotate_into(scratch_.corotation, model_.tissue, state_.position);
    product_ = state_.velocity;
    constexpr std::size_t most_events = 64;
    events_.reserve(most_events);
  }

  void advance(double speed) {
    part_us_.fill(0.0);
    travel_ += speed * model_.scene.run.time_step;
    since_ = processor_us();
    advance_rod(model_, state_, scratch_, hub_pose(model_, travel_), frame_, events_,
                {&MeasuredInsertion::heard, this});
    whole_us_ = 0.0;
    for (double us : part_us_) whole_us_ += us;
  }

  const Frame& frame() const { return frame_; }
  const Model& model() const { return model_; }
  double whole_us() const { return whole_us_; }
  double part_us(int part) const { return part_us_[part]; }
  const Residual& residual() const { return residual_; }
  void solve_to(double tolerance) { model_.scene.run.solver_tolerance = tolerance; }

 private:
  static void heard(void* self, StepPart part) { static_cast<MeasuredInsertion*>(self)->done(part); }
  void done(StepPart part) {
    part_us_[static_cast<int>(part)] += processor_us() - since_;
    if (part == StepPart::solve) residual_ = true_residual(model_, state_, scratch_, product_);
    since_ = processor_us();
  }

  Model model_;
  State state_;
  Scratch scratch_;
  Frame frame_;
  std::vector<Event> events_;
  numeric::NodeVector product_;
  std::array<double, step_parts> part_us_{};
  double travel_ = 0.0, since_ = 0.0, whole_us_ = 0.0;
  Residual residual_;
};

struct Samples {
  std::vector<double> reference_us, reference_residual, reference_residual_of_load;
  std::vector<double> whole_us, iterations, residual, residual_of_load;
  std::array<std::vector<double>, step_parts> part_us;
};

void measure_reference(ReferenceStep& reference, int steps, Samples& samples) {
  for (int i = 0; i < steps; ++i) {
    const double from = processor_us();
    reference.advance();
    samples.reference_us.push_back(processor_us() - from);
    samples.reference_residual.push_back(reference.residual());
    samples.reference_residual_of_load.push_back(reference.residual_of_load());
  }
}

void measure_insertion(MeasuredInsertion& insertion, int steps, Samples& samples) {
  for (int i = 0; i < steps; ++i) {
    insertion.advance(insertion.model().scene.hand.speed);
    samples.whole_us.push_back(insertion.whole_us());
    samples.iterations.push_back(insertion.frame().solver_iterations);
    samples.residual.push_back(insertion.residual().of_momentum);
    samples.residual_of_load.push_back(insertion.residual().of_load);
    for (int part = 0; part < step_parts; ++part) samples.part_us[part].push_back(insertion.part_us(part));
  }
}

StepCost summed_up(const Model& model, const Samples& samples) {
  StepCost cost;
  cost.tetrahedra = model.tissue.tets;
  cost.nodes = model.tissue.nodes;
  cost.iterations = median(samples.iterations);
  cost.residual = *std::max_element(samples.residual.begin(), samples.residual.end());
  cost.residual_of_load = *std::max_element(samples.residual_of_load.begin(), samples.residual_of_load.end());
  cost.us_per_step = median(samples.whole_us);
  for (int part = 0; part < step_parts; ++part) cost.us[part] = median(samples.part_us[part]);
  cost.reference_us_per_step = median(samples.reference_us);
  cost.reference_residual = median(samples.reference_residual);
  cost.reference_residual_of_load = median(samples.reference_residual_of_load);
  cost.ratio = cost.us_per_step / cost.reference_us_per_step;
  cost.real_time_factor = 1e6 * model.scene.run.time_step / cost.us_per_step;
  return cost;
}

}  // namespace

Result<StepCost> measure(int tetrahedra, int steps, EqualBy equal_by) {
  Samples samples;
  ReferenceStep reference(tetrahedra);
  measure_reference(reference, reference_warm, samples);
  constexpr double margin = 0.85;         // towards the better residual
  constexpr double margin_by_load = 0.6;  // which varies more from step to step
  constexpr double rounding = 1e-12;  // on the smallest meshes the reference reaches what doubles can hold
  const double tolerance = std::max(margin * samples.reference_residual.back(), rounding);
  // Of the last steps, because it rises and falls with the swing of the block.
  auto& of_load = samples.reference_residual_of_load;
  const double wanted_of_load = median({of_load.end() - of_load.size() / 2, of_load.end()});
  samples = {};

  auto model = build_model(scene_for(tetrahedra, tolerance), nullptr);
  if (!model) return model.error();
  MeasuredInsertion insertion(std::move(*model));
  while (insertion.frame().inserted_length < depth && insertion.frame().health == Health::good)
    insertion.advance(approach_speed);
  double loosest = 1.0;  // the tolerance at which a step has the residual that is wanted by load
  for (int i = 0; i < settling_steps; ++i) {
    insertion.advance(insertion.model().scene.hand.speed);
    const Residual& found = insertion.residual();
    loosest = std::min(loosest, wanted_of_load * found.of_momentum / found.of_load);
  }
  if (equal_by == EqualBy::load) {
    insertion.solve_to(std::max(margin_by_load * loosest, rounding));
    for (int i = 0; i < settling_steps; ++i) insertion.advance(insertion.model().scene.hand.speed);
  }

  const int steps_a_turn = std::max(1, (steps + turns - 1) / turns);
  for (int turn = 0; turn < turns; ++turn) {
    measure_reference(reference, steps_a_turn, samples);
    measure_insertion(insertion, steps_a_turn, samples);
  }
  if (insertion.frame().health != Health::good)
    return Error{"the insertion that is measured stopped after " + std::to_string(insertion.frame().time) +
                 " s of its time"};
  return summed_up(insertion.model(), samples);
}

}  // namespace acus::bench
