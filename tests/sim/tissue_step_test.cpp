// What a step chooses for its solve.
#include "acus/sim/tissue_step.h"

#include <gtest/gtest.h>

namespace acus {
namespace {

// Changes of a velocity of one number, one after the other.
double persistence_over(const std::vector<double>& changes) {
  double persistence = 0.0;
  for (std::size_t i = 1; i < changes.size(); ++i)
    persistence =
        persistence_after(persistence, changes[i] * changes[i - 1], changes[i - 1] * changes[i - 1]);
  return persistence;
}

TEST(Persistence, of_a_smooth_motion_becomes_one) {
  EXPECT_NEAR(persistence_over(std::vector<double>(200, 0.3)), 1.0, 1e-6);
  std::vector<double> faster;
  for (int i = 0; i < 200; ++i) faster.push_back(0.1 + 0.01 * i);
  EXPECT_NEAR(persistence_over(faster), 1.0, 1e-6);
}

TEST(Persistence, of_changes_that_come_and_go_becomes_nothing) {
  std::vector<double> changes;
  for (int i = 0; i < 200; ++i) changes.push_back(i % 2 == 0 ? 1.0 : -1.0);
  EXPECT_NEAR(persistence_over(changes), 0.0, 1e-6);
}

TEST(Persistence, of_a_decay_is_its_rate) {
  std::vector<double> changes{1.0};
  for (int i = 0; i < 200; ++i) changes.push_back(0.7 * changes.back());
  EXPECT_NEAR(persistence_over(changes), 0.7, 1e-6);
}

TEST(Persistence, of_rest_is_nothing) { EXPECT_EQ(persistence_over(std::vector<double>(20, 0.0)), 0.0); }

TEST(SinglePrecision, is_chosen_where_the_tolerance_allows) {
  Scene scene;
  const auto chosen = [&scene](double tolerance, double poisson_ratio, Precision precision) {
    scene.tissue.tetrahedra = 200;
    scene.tissue.poisson_ratio = poisson_ratio;
    scene.run.solver_tolerance = tolerance;
    scene.run.solver_precision = precision;
    const auto model = build_model(scene, nullptr);
    EXPECT_TRUE(model.ok());
    const Scratch scratch = build_scratch(*model);
    EXPECT_NE(scratch.corotation.single.turn.empty(), scratch.corotation.exact.turn.empty());
    return scratch.corotation.is_single();
  };
  EXPECT_TRUE(chosen(5e-5, 0.48, Precision::single_));
  EXPECT_TRUE(chosen(1e-6, 0.48, Precision::single_));
  EXPECT_FALSE(chosen(0.9e-6, 0.48, Precision::single_));
  EXPECT_FALSE(chosen(5e-5, 0.48, Precision::double_));
  EXPECT_FALSE(chosen(1e-6, 0.4999, Precision::single_));
  EXPECT_FALSE(chosen(5e-5, 0.4999, Precision::single_));
  EXPECT_TRUE(chosen(5e-5, 0.499, Precision::single_));
  // A column whose contact spring magnifies what is left is solved more exactly; a rod need not be.
  scene.contact.near_field = false;
  scene.contact.stiffness = 1e8;
  EXPECT_TRUE(chosen(5e-5, 0.48, Precision::single_));
  scene.needle_model = NeedleModel::column;
  EXPECT_FALSE(chosen(5e-5, 0.48, Precision::single_));
}

}  // namespace
}  // namespace acus
