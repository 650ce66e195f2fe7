// The column between the hub and a rigid stop: a testing machine.
#include <numbers>

#include "insertion.h"

using namespace acus;
using namespace acus::physics;
using needle::Support;

namespace {

Scene bare(Support support, double shortening_ratio) {
  Scene scene;
  scene.needle_model = NeedleModel::column;
  scene.tissue.rigid = true;
  scene.needle.support = support;
  scene.hand.travel = shortening_ratio * scene.needle.length;
  return scene;
}

class BareColumn : public testing::TestWithParam<std::pair<Support, double>> {};
INSTANTIATE_TEST_SUITE_P(FourSupports, BareColumn, testing::ValuesIn(euler_factors));

TEST_P(BareColumn, buckles_at_euler_load) {
  const auto [support, factor] = GetParam();
  const Insertion run = insert(bare(support, 0.05));
  const auto buckling = run.first(EventKind::buckling);
  ASSERT_TRUE(buckling);
  EXPECT_NEAR(buckling->hand_force, factor * pinned_pinned_load, 0.005 * factor * pinned_pinned_load);
}

TEST_P(BareColumn, southwell_plot_gives_euler_load) {
  const auto [support, factor] = GetParam();
  Scene scene = bare(support, 0.002);
  scene.needle.imperfection = 0.2e-3;
  scene.hand.speed = 0.5e-3;
  const Insertion run = insert(scene);
  const double load = southwell_load(run, scene.needle.imperfection, 0.5e-3, 3e-3);
  EXPECT_NEAR(load, factor * pinned_pinned_load, 0.005 * factor * pinned_pinned_load);
}

// Loads and bows of the exact elastica at an end shortening, by shooting (two independent solutions agree to
// 1e-4).
TEST(BareColumn, follows_the_elastica_after_buckling) {
  struct Row {
    double d, pp_load, pp_bow, cp_load, cp_bow;
  };
  for (const Row& row : {Row{0.01, 1.0050, 0.0635, 1.0038, 0.0620}, Row{0.05, 1.0257, 0.1401, 1.0189, 0.1366},
                         Row{0.10, 1.0530, 0.1949, 1.0380, 0.1895}, Row{0.20, 1.1127, 0.2663, 1.0758, 0.2569},
                         Row{0.30, 1.1807, 0.3143, 1.1103, 0.2997}}) {
    for (bool clamped : {false, true}) {
      const Insertion run = insert(bare(clamped ? Support::clamped_pinned : Support::pinned_pinned, row.d));
      const Frame& end = run.frames.back();
      const double euler = (clamped ? 2.04575 : 1.0) * pinned_pinned_load;
      const double load = (clamped ? row.cp_load : row.pp_load) * euler;
      const double bow = (clamped ? row.cp_bow : row.pp_bow) * 0.2;
      EXPECT_NEAR(end.hand_force, load, 0.01 * load) << row.d;
      EXPECT_NEAR(end.deflection, bow, 0.01 * bow) << row.d;
    }
  }
}

TEST(BareColumn, gives_all_its_work_back_when_it_is_let_go) {
  Scene scene = bare(Support::clamped_pinned, 0.1);
  scene.hand.kind = HandKind::path;
  scene.hand.path = {{0.0, 0.0}, {2.0, 20e-3}, {4.0, 0.0}};
  const Insertion run = insert(scene);
  double most = 0.0;
  for (const Frame& f : run.frames) most = std::max(most, f.ledger.work_hand);
  EXPECT_GT(most, 0.01);
  EXPECT_NEAR(run.frames.back().ledger.energy_needle, 0.0, 1e-3 * most);
  EXPECT_NEAR(run.frames.back().hand_force, 0.0, 1e-6);
  EXPECT_LT(run.frames.back().ledger.work_numerical, 1e-3 * most);
}

}  // namespace
