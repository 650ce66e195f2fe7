// Random needles, tissues and hands: always finite, the ledger always closed, friction and cutting never
// negative.
#include <cstdlib>
#include <random>

#include "insertion.h"

using namespace acus;
using namespace acus::physics;

namespace {

Scene random_scene(std::mt19937_64& random, NeedleModel model) {
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  Scene scene;
  scene.needle_model = model;
  scene.needle.length = between(0.06, 0.3);
  scene.needle.radius = between(0.1e-3, 0.7e-3);
  scene.needle.youngs_modulus = between(40e9, 220e9);
  scene.needle.support = needle::all_supports[random() % needle::all_supports.size()];
  scene.needle.imperfection = between(0.0, 0.5e-3);
  scene.tissue.tetrahedra = 700;
  scene.tissue.youngs_modulus = between(5e3, 100e3);
  scene.tissue.poisson_ratio = between(0.0, 0.49);
  scene.tissue.element = random() % 2 ? Element::linear : Element::nodal_pressure;
  scene.contact.rupture_force = between(0.05, 2.0);
  scene.contact.fracture_toughness = between(0.0, 300.0);
  scene.contact.crack = random() % 2 ? Crack::ring : Crack::slit;
  scene.contact.friction = between(0.0, 100.0);
  scene.contact.coupling = random() % 2 ? Coupling::embedded : Coupling::nearest_node;
  scene.tissue.relaxation_share = random() % 3 ? 0.0 : between(0.0, 0.8);
  scene.tissue.relaxation_time = between(0.01, 1.0);
  scene.hand.grip = random() % 2 ? 0.0 : between(0.0, 0.3) * scene.needle.length;
  scene.hand.stiffness = random() % 2 ? 0.0 : between(200.0, 5000.0);
  if (model == NeedleModel::rod) {
    scene.needle.bevel_degrees = random() % 2 ? 0.0 : between(10.0, 80.0);
    scene.needle.bevel_turn_degrees = between(-180.0, 180.0);
    scene.guide.length = random() % 2 ? 0.0 : between(1e-3, 60e-3);
    scene.guide.gap = between(0.0, 30e-3);
    scene.guide.stiffness = std::pow(10.0, between(5.0, 9.0));
    scene.guide.friction = random() % 2 ? 0.0 : between(0.0, 50.0);
  }
  scene.hand.kind = HandKind::path;
  scene.hand.path = {{0.0, 0.0}};
  for (int leg = 0; leg < 4; ++leg)
    scene.hand.path.push_back({scene.hand.path.back().time + between(0.05, 0.15),
                               between(-0.005, 0.45 * std::min(scene.needle.length, 0.1))});
  return scene;
}

class RandomInsertion : public testing::TestWithParam<NeedleModel> {};
INSTANTIATE_TEST_SUITE_P(Of, RandomInsertion, testing::Values(NeedleModel::column, NeedleModel::rod),
                         [](const auto& of) { return of.param == NeedleModel::rod ? "rods" : "columns"; });

// Of each model; ACUS_INSERTIONS asks for more.
int trials() {
  const char* const asked = std::getenv("ACUS_INSERTIONS");
  return asked != nullptr ? std::atoi(asked) : 100;
}

TEST_P(RandomInsertion, stays_finite_closes_the_ledger_and_creates_no_energy) {
  std::mt19937_64 random(20240917);
  for (int trial = 0; trial < trials(); ++trial) {
    const Scene scene = random_scene(random, GetParam());
    // A thin rod on a joint may swing round until it lies on the hand.
    const bool may_fold =
        GetParam() == NeedleModel::rod && scene.needle.support == needle::Support::pinned_pinned;
    SCOPED_TRACE("trial " + std::to_string(trial));
    const Insertion run = insert(scene, {}, may_fold ? Health::needle_folded : Health::good);
    ASSERT_FALSE(run.frames.empty());
    double turnover = 1e-6, cut = 0.0, rubbed = 0.0;  // J
    Frame before;
    for (const Frame& f : run.frames) {
      turnover += std::abs(f.ledger.work_hand - before.ledger.work_hand);
      ASSERT_TRUE(std::isfinite(f.hand_force) && std::isfinite(f.energy_force)) << f.time;
      ASSERT_GE(f.ledger.work_cutting, cut - 1e-15) << f.time;
      ASSERT_GE(f.ledger.work_friction, rubbed - 1e-15) << f.time;
      ASSERT_LT(std::abs(f.energy_residual), 0.01 * turnover) << f.time;
      // What is held at the nearest node changes its energy as it jumps to the next one.
      if (scene.contact.coupling == Coupling::embedded) {
        ASSERT_GT(f.ledger.work_numerical, -0.01 * turnover - 1e-6) << f.time;  // J: a guide closes
      }
      cut = f.ledger.work_cutting;
      rubbed = f.ledger.work_friction;
      before = f;
    }
  }
}

}  // namespace
