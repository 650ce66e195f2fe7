// A hand that stops feels the tissue relax.
#include "acus/tissue/material.h"
#include "insertion.h"

using namespace acus;
using namespace acus::physics;

namespace {

class Relaxation : public testing::TestWithParam<NeedleModel> {};
INSTANTIATE_TEST_SUITE_P(Of, Relaxation, testing::Values(NeedleModel::column, NeedleModel::rod),
                         [](const auto& of) { return of.param == NeedleModel::rod ? "rod" : "column"; });

// Along a path over tissue that loses `share` of its stiffness; nothing ruptures, nothing buckles.
Scene pressed(NeedleModel model, double share, double time, std::vector<HandPoint> path) {
  Scene scene = table_one(0.12, 5e-3);
  scene.needle_model = model;
  scene.tissue.relaxation_share = share;
  scene.tissue.relaxation_time = time;
  scene.hand.kind = HandKind::path;
  scene.hand.path = std::move(path);
  scene.run.solver_tolerance = 1e-8;  // forces are compared to a nanonewton
  return scene;
}
const std::vector<HandPoint> push_and_hold = {{0.0, 0.0}, {0.05, 2.5e-3}, {1.2, 2.5e-3}};
const std::vector<HandPoint> push_and_return = {{0.0, 0.0}, {0.2, 2.5e-3}, {0.4, 0.0}};

TEST_P(Relaxation, a_held_needle_feels_the_force_fall_to_that_of_the_tissue_without_it) {
  const Insertion relaxing = insert(pressed(GetParam(), 0.4, 0.1, push_and_hold));
  const Insertion elastic = insert(pressed(GetParam(), 0.0, 0.1, push_and_hold));
  double peak = 0.0, before = 1e9;
  for (const Frame& f : relaxing.frames) {
    peak = std::max(peak, f.hand_force);
    if (f.time < 0.08) continue;  // the tissue's own swinging is over
    ASSERT_LE(f.hand_force, before + 1e-9) << f.time;
    before = f.hand_force;
  }
  const double lasting = elastic.frames.back().hand_force;
  EXPECT_GT(peak, 1.2 * lasting);
  EXPECT_NEAR(relaxing.frames.back().hand_force, lasting, 1e-3 * lasting);
}

TEST_P(Relaxation, a_turn_to_and_fro_spends_more_than_without_it_and_the_branch_says_how_much) {
  const force::Ledger with = insert(pressed(GetParam(), 0.4, 0.1, push_and_return)).frames.back().ledger;
  const force::Ledger without = insert(pressed(GetParam(), 0.0, 0.1, push_and_return)).frames.back().ledger;
  EXPECT_GT(with.work_hand, without.work_hand);
  EXPECT_GT(without.work_hand, 0.0);
  EXPECT_EQ(without.work_relaxation, 0.0);
  EXPECT_GT(with.work_relaxation, 0.5 * with.work_hand);
}

// Far too slow to relax in that time, the tissue is as stiff as it is to a sudden load, and in volume as
// stiff as ever.
TEST_P(Relaxation, far_slower_than_the_hand_it_is_elastic_tissue_of_the_sudden_stiffness) {
  Scene slow = pressed(GetParam(), 0.4, 1e6, push_and_hold);
  slow.contact.near_field = false;  // which is elastic, and as stiff as the tissue is in the long term
  Scene stiff = slow;
  stiff.tissue.relaxation_share = 0.0;
  const tissue::Material lasting{slow.tissue.youngs_modulus, slow.tissue.poisson_ratio, 1000.0};
  const double K = tissue::bulk_modulus(lasting), G = tissue::shear_modulus(lasting) / (1.0 - 0.4);
  stiff.tissue.youngs_modulus = 9.0 * K * G / (3.0 * K + G);
  stiff.tissue.poisson_ratio = (3.0 * K - 2.0 * G) / (2.0 * (3.0 * K + G));
  const Insertion one = insert(slow), other = insert(stiff);
  for (std::size_t k = 0; k < one.frames.size(); ++k)
    ASSERT_NEAR(one.frames[k].hand_force, other.frames[k].hand_force, 1e-4) << one.frames[k].time;
}

TEST_P(Relaxation, far_faster_than_a_step_it_is_not_there) {
  const Insertion fast = insert(pressed(GetParam(), 0.4, 1e-6, push_and_hold));
  const Insertion elastic = insert(pressed(GetParam(), 0.0, 1.0, push_and_hold));
  for (std::size_t k = 0; k < fast.frames.size(); ++k)
    ASSERT_NEAR(fast.frames[k].hand_force, elastic.frames[k].hand_force, 1e-3) << fast.frames[k].time;
}

TEST_P(Relaxation, without_a_share_changes_no_bit) {
  Scene plain = pressed(GetParam(), 0.0, 1.0, push_and_return);
  Scene named = pressed(GetParam(), 0.0, 1e-3, push_and_return);
  EXPECT_EQ(insert(plain).hash, insert(named).hash);
  named.tissue.relaxation_share = 0.01;
  EXPECT_NE(insert(plain).hash, insert(named).hash);
}

// Through puncture, cutting and withdrawal, or a snap.
TEST_P(Relaxation, ledger_closes_and_the_dashpots_only_spend) {
  Scene through = table_one(0.15, 20e-3);
  through.hand.kind = HandKind::path;
  through.hand.path = {{0.0, 0.0}, {1.0, 20e-3}, {1.3, 20e-3}, {2.0, 2e-3}};
  Scene snap = table_one(0.2, 45e-3);
  snap.contact.rupture_force = 0.66;
  snap.contact.friction = 20.0;
  Scene paper = table_one(0.15, 30e-3);
  paper.tissue.element = Element::linear;
  paper.contact.coupling = Coupling::nearest_node;
  for (Scene scene : {through, snap, paper})
    for (double time : {1e-6, 0.02, 0.3, 1e6}) {
      if (time != 0.3 && scene.hand.kind != HandKind::path) continue;
      scene.needle_model = GetParam();
      scene.tissue.relaxation_share = 0.4;
      scene.tissue.relaxation_time = time;
      const Insertion run = insert(scene);
      double most_work = 0.0;
      for (const Frame& f : run.frames) most_work = std::max(most_work, std::abs(f.ledger.work_hand));
      for (std::size_t k = 1; k < run.frames.size(); ++k) {
        const force::Ledger &before = run.frames[k - 1].ledger, &now = run.frames[k].ledger;
        ASSERT_LT(std::abs(run.frames[k].energy_residual), 1e-5 * most_work) << time << ", " << k;
        ASSERT_GE(now.work_relaxation, before.work_relaxation) << time << ", " << k;
        // What a step spends on dashpots and integration together never falls; the second alone may, by very
        // little, where tissue creeps.
        const double spent = now.work_numerical + now.work_relaxation;
        ASSERT_GT(spent, before.work_numerical + before.work_relaxation - 1e-6 * most_work)
            << time << ", " << k;
        ASSERT_GT(now.work_numerical, before.work_numerical - 1e-5 * most_work) << time << ", " << k;
      }
      EXPECT_LT(run.frames.back().ledger.work_numerical, 0.06 * most_work) << time;
      EXPECT_GT(run.frames.back().ledger.work_relaxation, time == 0.3 ? 0.005 * most_work : 0.0) << time;
    }
}

// The numerical line holds what the others leave, so a wrong dissipation would stay in it however short the
// step.
TEST(RelaxationLedger, what_is_numerical_halves_with_the_time_step_and_what_relaxes_stays) {
  std::vector<double> numerical, relaxed;
  for (double step : {1e-3, 0.5e-3, 0.25e-3}) {
    Scene scene = table_one(0.15, 15e-3);
    scene.tissue.relaxation_share = 0.4;
    scene.tissue.relaxation_time = 0.1;
    scene.run.time_step = step;
    const force::Ledger end = insert(scene).frames.back().ledger;
    numerical.push_back(end.work_numerical);
    relaxed.push_back(end.work_relaxation);
  }
  EXPECT_LT(numerical[1], 0.7 * numerical[0]);
  EXPECT_LT(numerical[2], 0.7 * numerical[1]);
  EXPECT_GT(numerical[2], 0.0);
  EXPECT_NEAR(relaxed[1], relaxed[2], 0.02 * relaxed[2]);
  EXPECT_GT(relaxed[2], 10.0 * numerical[2]);
}

}  // namespace
