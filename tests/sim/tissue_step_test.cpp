// What a step chooses for its solve.
#include "acus/sim/tissue_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

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

// A step's velocity is what `motion` says of it; returns what each step began its solve with, less that.
std::vector<double> missed(const std::function<double(int)>& motion) {
  Scene scene;
  scene.tissue.tetrahedra = 200;
  const Model model = build_model(scene, nullptr).value();
  State state = initial_state(model);
  Scratch scratch = build_scratch(model);
  const auto velocity = [&](int step) {
    numeric::NodeVector v = state.velocity;
    for (std::size_t i = 0; i < v.size(); ++i)
      v[i] = i % numeric::node_stride < 3 ? 1e-9 * motion(step) * static_cast<double>(i % 7) : 0.0;
    return v;
  };
  std::vector<double> all;
  for (int step = 0; step < 60; ++step) {
    form_momentum(model, state, scratch);
    begin_tissue(model, state, scratch);
    numeric::NodeVector v = velocity(step);
    const double scale = std::sqrt(numeric::dot(v, v));
    numeric::scale_and_add_into(state.velocity, -1.0, v);
    all.push_back(std::sqrt(numeric::dot(state.velocity, state.velocity)) / scale);
    state.velocity = v;
    TissueBefore before;
    move_tissue(model, state, scratch, before, {});
  }
  return all;
}

TEST(StartOfASolve, goes_on_along_a_line_and_a_parabola) {
  const auto line = missed([](int i) { return 1.0 + 0.3 * i; });
  const auto parabola = missed([](int i) { return 1.0 + 0.3 * i - 0.02 * i * i; });
  EXPECT_LT(line.back(), 1e-9);
  EXPECT_LT(parabola.back(), 1e-9);
}

// A bend that comes and goes is nothing to go on by: the start stays on the line.
TEST(StartOfASolve, does_not_follow_a_bend_that_does_not_come_again) {
  const auto shaken = missed([](int i) { return 10.0 + i + (i % 2 == 0 ? 0.1 : -0.1); });
  for (int i = 20; i < 60; ++i) EXPECT_LT(shaken[i], 0.6 / (10.0 + i)) << i;  // 0.8 by a parabola
}

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
