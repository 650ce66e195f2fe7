#include "step_cost.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "acus/sim/rod_contact.h"
#include "acus/sim/rod_step.h"
#include "measuring.h"
#include "reference_step.h"

namespace acus::bench {
namespace {

// The reference is run as such programs are: from rest, some steps that do not count and 40 that do; then
// again from rest. It is the same run each time, so its residuals, which cost products, are found beforehand.
constexpr int reference_warm = 5, reference_steps = 40;
constexpr int turns_a_run = 8;   // of reference and engine, one after the other
constexpr double depth = 20e-3;  // m, of needle inside the tissue while measuring

// A needle short enough not to buckle that goes in quickly and then at the default speed.
Scene scene_for(const StepWanted& wanted, double tolerance) {
  Scene scene;
  scene.needle.length = 0.12;
  scene.tissue.tetrahedra = wanted.tetrahedra;
  scene.tissue.element = wanted.element;
  scene.contact.rupture_force = 0.2;
  scene.run.solver_tolerance = tolerance;
  return scene;
}
constexpr double approach_speed = 0.1;  // m/s
constexpr int settling_steps = 50;      // at the default speed, before measuring

double norm(const numeric::NodeVector& v) { return std::sqrt(numeric::dot(v, v)); }

// |b - A v|
double left_by(const numeric::NodeVector& v, const numeric::NodeVector& b, const Model& m,
               const tissue::Corotation& exact, const Scratch& w) {
  numeric::NodeVector product = v;
  tissue::multiply_into(product, m.tissue, exact, w.matrix, v);
  numeric::scale_and_add_into(product, -1.0, b);
  return norm(product);
}

// Of the step just solved, before anything moves: in double, its contact and friction with the forces they
// really have, and nothing taken from the solve.
Residual true_residual(const Model& m, const State& s, const Scratch& w, tissue::Corotation& exact) {
  const double h = m.scene.run.time_step;
  numeric::NodeVector before = s.velocity, b = before;
  numeric::add_scaled_into(before, -1.0, s.velocity_change);
  // The forces of the step where they are exact: once more corrected rotations would differ by 1e-12.
  if (!w.corotation.is_single())
    exact = w.corotation;
  else
    tissue::corotate_into(exact, m.tissue, s.position);
  tissue::momentum_into(b, m.tissue, before, exact.elastic_force, h);
  double load = 0.0;  // N
  for (const RodContact& c : w.rod.contacts) {
    const Vec3 force = contact_load(c, h * (at_contact(s.needle.rod.rate, c) - tissue_rate(s, c)));
    coupling::add_spread(b, *c.at, h * force);
    load += force.norm();
  }
  const double left = left_by(s.velocity, b, m, exact, w);
  return {left / norm(b), left / left_by(before, b, m, exact, w), left / (h * load)};
}

// The engine's step with a stop watch on its parts.
class MeasuredInsertion {
 public:
  MeasuredInsertion(Model model, int threads)
      : clock_(clock_for(threads)),
        threads_(threads),
        model_(std::move(model)),
        state_(initial_state(model_)),
        scratch_(build_scratch(model_, threads)) {
    exact_ = tissue::build_corotation(model_.tissue);
    tissue::corotate_into(scratch_.corotation, model_.tissue, state_.position);
    constexpr std::size_t most_events = 64;
    events_.reserve(most_events);
  }

  void advance(double speed) {
    part_us_.fill(0.0);
    travel_ += speed * model_.scene.run.time_step;
    since_ = clock_();
    advance_rod(model_, state_, scratch_, hub_pose(model_, travel_), frame_, events_,
                {&MeasuredInsertion::heard, this});
    whole_us_ = 0.0;
    for (double us : part_us_) whole_us_ += us;
  }

  const Frame& frame() const { return frame_; }
  const Model& model() const { return model_; }
  double whole_us() const { return whole_us_; }
  double part_us(int part) const { return part_us_[part]; }
  // A step that is not timed: what is computed beside it takes its place in the cache.
  const Residual& advance_and_look(double speed) {
    solved_ = false;
    advance(speed);
    solved_ = true;
    return residual_;
  }
  void solve_to(double tolerance) {
    model_.scene.run.solver_tolerance = tolerance;
    scratch_ = build_scratch(model_, threads_);  // in the precision that goes with it
    tissue::corotate_into(scratch_.corotation, model_.tissue, state_.position);
  }

 private:
  static void heard(void* self, StepPart part) { static_cast<MeasuredInsertion*>(self)->done(part); }
  void done(StepPart part) {
    part_us_[static_cast<int>(part)] += us_between(since_, clock_());
    // The books are first opened when the solve is over and nothing has moved yet.
    if (part == StepPart::ledger && !std::exchange(solved_, true))
      residual_ = true_residual(model_, state_, scratch_, exact_);
    since_ = clock_();
  }

  std::int64_t (*clock_)();
  int threads_;
  Model model_;
  State state_;
  Scratch scratch_;
  Frame frame_;
  std::vector<Event> events_;
  tissue::Corotation exact_;
  std::array<double, step_parts> part_us_{};
  double travel_ = 0.0, whole_us_ = 0.0;
  std::int64_t since_ = 0;
  bool solved_ = true;  // and looked at, in the step under way
  Residual residual_;
};

struct Samples {
  std::vector<double> reference_us, whole_us, iterations;
  std::vector<Residual> residual;
  std::array<std::vector<double>, step_parts> part_us;
};

void measure_reference(ReferenceStep& reference, int steps, int threads, Samples& samples) {
  const auto clock = clock_for(threads);  // of the engine, so that both are timed alike
  for (int i = 0; i < steps; ++i) {
    const std::int64_t from = clock();
    reference.advance();
    samples.reference_us.push_back(us_between(from, clock()));
  }
}

void measure_insertion(MeasuredInsertion& insertion, int steps, Samples& samples) {
  for (int i = 0; i < steps; ++i) {
    insertion.advance(insertion.model().scene.hand.speed);
    samples.whole_us.push_back(insertion.whole_us());
    samples.iterations.push_back(insertion.frame().solver_iterations);
    for (int part = 0; part < step_parts; ++part) samples.part_us[part].push_back(insertion.part_us(part));
  }
}

// Quantity by quantity; a share of 1 gives the largest.
Residual residual_at(const std::vector<Residual>& residuals, double share) {
  Residual all;
  std::vector<double> values(residuals.size());
  for (double Residual::*quantity : {&Residual::of_momentum, &Residual::of_change, &Residual::of_load}) {
    std::transform(residuals.begin(), residuals.end(), values.begin(),
                   [&](const Residual& r) { return r.*quantity; });
    all.*quantity = quantile(values, share);
  }
  return all;
}

// The runs of the reference, and the engine's steps spread evenly between them; then as many to see what they
// leave.
void measure_in_turns(ReferenceStep& reference, MeasuredInsertion& insertion, const StepWanted& wanted,
                      Samples& samples) {
  const int steps = wanted.steps;
  const int turns = turns_a_run * ((steps + reference_steps - 1) / reference_steps);
  int taken = 0;
  for (int turn = 0; turn < turns; ++turn) {
    if (turn % turns_a_run == 0) {
      reference.restart();
      for (int i = 0; i < reference_warm; ++i) reference.advance();
    }
    measure_reference(reference, reference_steps / turns_a_run, wanted.threads, samples);
    const int due = static_cast<int>(static_cast<long>(steps) * (turn + 1) / turns);
    measure_insertion(insertion, due - taken, samples);
    taken = due;
  }
  for (int i = 0; i < steps; ++i)
    samples.residual.push_back(insertion.advance_and_look(insertion.model().scene.hand.speed));
}

// What the reference leaves, the medians of a run that is not timed.
Residual residual_of(ReferenceStep& reference) {
  std::vector<Residual> residuals;
  for (int i = 0; i < reference_warm; ++i) reference.advance();
  for (int i = 0; i < reference_steps; ++i) {
    reference.advance();
    residuals.push_back(reference.residual());
  }
  return residual_at(residuals, 0.5);
}

// The tolerance with which the engine leaves no more than the reference in the quantity that is wanted.
// Advances the insertion by some steps to see how the quantities go together: the tolerance is of |b| and the
// load's impulse together.
double tolerance_for(MeasuredInsertion& insertion, const Residual& reference, EqualBy equal_by) {
  // How the tolerance and the load go together is known, how the others do varies from step to step.
  const double margin = equal_by == EqualBy::load ? 0.9 : 0.6;
  const auto quantity = measure_of(equal_by);
  for (int i = 0; i < settling_steps; ++i) insertion.advance(insertion.model().scene.hand.speed);
  double loosest = 1.0;
  for (int i = 0; i < settling_steps; ++i) {
    const Residual& found = insertion.advance_and_look(insertion.model().scene.hand.speed);
    const double of_tolerance = 1.0 / (1.0 / found.of_momentum + 1.0 / found.of_load);
    loosest = std::min(loosest, reference.*quantity * of_tolerance / (found.*quantity));
  }
  return margin * loosest;
}

StepCost summed_up(const Model& model, const ReferenceStep& reference, const Samples& samples) {
  StepCost cost;
  cost.tetrahedra = model.tissue.tets;
  cost.nodes = model.tissue.nodes;
  cost.iterations = median(samples.iterations);
  cost.residual = residual_at(samples.residual, 0.5);
  cost.largest_residual = residual_at(samples.residual, 1.0);
  cost.us_per_step = median(samples.whole_us);
  cost.mean_us_per_step = mean(samples.whole_us);
  for (int part = 0; part < step_parts; ++part) cost.us[part] = median(samples.part_us[part]);
  cost.reference_tetrahedra = reference.tetrahedra();
  cost.reference_nodes = reference.nodes();
  cost.reference_us_per_step = median(samples.reference_us);
  cost.ratio = cost.us_per_step / cost.reference_us_per_step;
  cost.real_time_factor = 1e6 * model.scene.run.time_step / cost.us_per_step;
  return cost;
}

}  // namespace

Result<StepCost> measure(const StepWanted& wanted) {
  constexpr double rounding = 1e-14;  // on the smallest meshes the reference reaches what doubles can hold
  ReferenceStep reference(wanted.tetrahedra);
  const Residual of_reference = residual_of(reference);
  auto model = build_model(scene_for(wanted, std::max(of_reference.of_momentum, rounding)), nullptr);
  if (!model) return model.error();
  MeasuredInsertion insertion(std::move(*model), wanted.threads);
  while (insertion.frame().inserted_length < depth && insertion.frame().health == Health::good)
    insertion.advance(approach_speed);
  double tolerance = std::max(tolerance_for(insertion, of_reference, wanted.equal_by), rounding);
  const auto quantity = measure_of(wanted.equal_by);
  // Where one step has left more than the reference, again and more exactly, as far as the needle may go.
  constexpr int most_steps = 2000;
  for (int taken = 0;; taken += 2 * wanted.steps) {
    insertion.solve_to(tolerance);
    for (int i = 0; i < settling_steps; ++i) insertion.advance(insertion.model().scene.hand.speed);
    Samples samples;
    measure_in_turns(reference, insertion, wanted, samples);
    if (insertion.frame().health != Health::good)
      return Error{"the insertion that is measured stopped after " + std::to_string(insertion.frame().time) +
                   " s of its time"};
    StepCost cost = summed_up(insertion.model(), reference, samples);
    cost.reference_residual = of_reference;
    const double over = cost.largest_residual.*quantity / (of_reference.*quantity);
    if (over <= 1.0 || tolerance == rounding || taken + 2 * wanted.steps > most_steps) return cost;
    constexpr double margin = 0.7;
    tolerance = std::max(margin * tolerance / over, rounding);
  }
}

}  // namespace acus::bench
