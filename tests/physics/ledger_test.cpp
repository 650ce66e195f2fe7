// The energy ledger closes, and the force it implies is the one at the hub.
#include <map>

#include "insertion.h"

using namespace acus;
using namespace acus::physics;

namespace {

struct Case {
  std::string name;
  Scene scene;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  all.push_back({"straight_puncture", table_one(0.15, 30e-3)});
  all.push_back({"buckled", table_one(0.2, 40e-3)});
  Scene snap = table_one(0.2, 45e-3);
  snap.contact.rupture_force = 0.66;
  snap.contact.friction = 20.0;
  all.push_back({"snap", snap});
  Scene paper = table_one(0.15, 30e-3);
  paper.tissue.element = Element::linear;
  paper.contact.coupling = Coupling::nearest_node;
  all.push_back({"nearest_node", paper});
  Scene slit = table_one(0.15, 30e-3);
  slit.contact.crack = Crack::slit;
  slit.needle.support = needle::Support::clamped_clamped;
  all.push_back({"slit_clamped", slit});
  Scene back = table_one(0.15, 20e-3);
  back.hand.kind = HandKind::path;
  back.hand.path = {{0.0, 0.0}, {1.0, 20e-3}, {1.2, 20e-3}, {2.0, 2e-3}};
  all.push_back({"withdrawal", back});
  Scene held = back;
  held.hand.grip = 20e-3;
  held.hand.stiffness = 500.0;
  all.push_back({"held_before_the_hub", held});
  const std::size_t columns = all.size();
  for (std::size_t i = 0; i < columns; ++i) {
    Case rod = all[i];
    rod.name = "rod_" + rod.name;
    // The springs of a rod that is held at the nearest node change their energy as they jump to the next one.
    if (rod.scene.contact.coupling == Coupling::embedded) all.push_back(rod);
    all[i].scene.needle_model = NeedleModel::column;
  }
  Scene guided = back;
  guided.guide = {.length = 40e-3, .gap = 5e-3, .stiffness = 1e6, .friction = 10.0};
  all.push_back({"rod_in_a_guide", guided});
  return all;
}

const Insertion& run_of(const Case& of) {
  static std::map<std::string, Insertion> runs;
  const auto known = runs.find(of.name);
  return known != runs.end() ? known->second : runs.emplace(of.name, insert(of.scene)).first->second;
}

class Ledger : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Of, Ledger, testing::ValuesIn(cases()),
                         [](const auto& of) { return of.param.name; });

// The demand is 1 % of the hand's work; what is left is the solver's tolerance.
TEST_P(Ledger, closes) {
  const Insertion& run = run_of(GetParam());
  double most_work = 0.0;
  for (const Frame& f : run.frames) most_work = std::max(most_work, std::abs(f.ledger.work_hand));
  for (const Frame& f : run.frames) ASSERT_LT(std::abs(f.energy_residual), 1e-5 * most_work) << f.time;
  // Not by hiding: what the integrator dissipates is a small part of what physics does, and is never
  // negative.
  EXPECT_LT(run.frames.back().ledger.work_numerical, 0.05 * most_work);
  for (std::size_t k = 1; k < run.frames.size(); ++k)
    ASSERT_GT(run.frames[k].ledger.work_numerical,
              run.frames[k - 1].ledger.work_numerical - 1e-6 * most_work);
  // Nor in the snap: it gives off no more than the column held, and takes in, once, in the step of the
  // puncture (8e-5 of the work), what the force at the step's end errs by.
  for (std::size_t k = 1; k < run.frames.size(); ++k) {
    const force::Ledger &before = run.frames[k - 1].ledger, &now = run.frames[k].ledger;
    ASSERT_GT(now.work_snap, before.work_snap - 1.5e-4 * most_work) << run.frames[k].time;
    ASSERT_LT(now.work_snap, before.work_snap + before.energy_needle + 1e-6 * most_work)
        << run.frames[k].time;
  }
}

// Eq. 14-18 over every step of the moving hand gives the hub's reaction within 3 % of the peak.
TEST_P(Ledger, energy_force_is_the_reaction_at_the_hub) {
  const Insertion& run = run_of(GetParam());
  double peak = 0.0;
  for (const Frame& f : run.frames) peak = std::max(peak, std::abs(f.hand_force));
  for (std::size_t k = 1; k < run.frames.size(); ++k) {
    const Frame& now = run.frames[k];
    if (std::abs(now.hand_travel - run.frames[k - 1].hand_travel) < force::energy_force_travel) continue;
    ASSERT_NEAR(now.energy_force, now.hand_force, 0.03 * peak) << now.time;
  }
}

// The residual alone would not notice a wrong energy, because the numerical line is the difference between a
// step's work and the energy it gained. That line must be the integrator's: of first order in the time step.
TEST(Ledger, numerical_dissipation_halves_with_the_time_step) {
  std::vector<double> lost;
  for (double step : {1e-3, 0.5e-3, 0.25e-3}) {
    Scene scene = column_in_table_one(0.15, 15e-3);
    scene.run.time_step = step;
    const force::Ledger end = insert(scene).frames.back().ledger;
    lost.push_back(end.work_numerical);
    EXPECT_LT(std::abs(end.work_snap), 1e-3 * end.work_hand);  // a straight needle does not snap
  }
  EXPECT_LT(lost[1], 0.7 * lost[0]);
  EXPECT_LT(lost[2], 0.7 * lost[1]);
  EXPECT_GT(lost[2], 0.0);
}

// A needle that buckles, breaks through and snaps straight: what the hand feels must not depend on the time
// step, nor what the jump gives off, which is the drop of the column's energy less the work it does on the
// way in. All else that is numerical halves with the step here too.
TEST(Ledger, snap_is_the_same_at_every_time_step) {
  std::vector<double> numerical, given_off, least_force, largest_drop;
  for (double step : {1e-3, 0.5e-3, 0.25e-3}) {
    Scene scene = column_in_table_one(0.2, 26e-3, 20e-3, 1000);
    scene.contact.rupture_force = 0.66;
    scene.contact.friction = 20.0;
    scene.run.time_step = step;
    const Insertion run = insert(scene);
    ASSERT_TRUE(run.first(EventKind::straightening));
    double least = 1.0, drop = 0.0;
    for (std::size_t k = 1; k < run.frames.size(); ++k) {
      least = std::min(least, run.frames[k].hand_force);
      drop = std::max(drop, run.frames[k - 1].hand_force - run.frames[k].hand_force);
    }
    least_force.push_back(least);
    largest_drop.push_back(drop);
    numerical.push_back(run.frames.back().ledger.work_numerical);
    given_off.push_back(run.frames.back().ledger.work_snap);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GE(least_force[i], 0.0);  // the needle pushes, it is never pulled in
    EXPECT_NEAR(largest_drop[i], largest_drop[2], 0.03 * largest_drop[2]);
    EXPECT_NEAR(given_off[i], given_off[2], 0.02 * given_off[2]);
  }
  EXPECT_GT(given_off[2], 0.0);
  EXPECT_LT(numerical[1], 0.75 * numerical[0]);
  EXPECT_LT(numerical[2], 0.75 * numerical[1]);
}

}  // namespace
