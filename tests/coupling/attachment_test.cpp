// The weights that carry motion from the tissue to the needle and force back.
#include "acus/coupling/attachment.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numeric>

#include "tests/tissue/irregular_block.h"

namespace acus::coupling {
namespace {

class Attachments : public ::testing::Test {
 protected:
  mesh::TetMesh mesh_ = tissue::irregular_block();  // 30 x 40 x 30 mm
  mesh::Locator locator_{mesh_};
  int nodes_ = static_cast<int>(mesh_.nodes.size());
  std::mt19937 random_{3};
  Attachment at_;

  Vec3 random_point() {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    return {0.014 * unit(random_), 0.019 * unit(random_), 0.015 + 0.014 * unit(random_)};
  }
  Vec3 random_axis() {
    std::normal_distribution<double> normal;
    return Vec3(normal(random_), normal(random_), normal(random_)).normalized();
  }
  double sum() const { return std::accumulate(at_.weight.begin(), at_.weight.end(), 0.0); }
  Vec3 mean_of(const std::function<Vec3(const Vec3&)>& field) const {
    Vec3 mean = Vec3::Zero();
    for (std::size_t i = 0; i < at_.node.size(); ++i) mean += at_.weight[i] * field(mesh_.nodes[at_.node[i]]);
    return mean;
  }
  numeric::NodeVector nothing() const {
    return numeric::NodeVector(static_cast<std::size_t>(numeric::node_stride) * nodes_, 0.0);
  }
};

TEST_F(Attachments, of_a_point_are_positive_sum_to_one_and_give_linear_fields_exactly) {
  for (int i = 0; i < 200; ++i) {
    const Vec3 point = random_point();
    embed_point_into(at_, locator_, point, 0.0, nodes_);
    ASSERT_LE(at_.node.size(), 4U);
    for (double w : at_.weight) EXPECT_GE(w, 0.0);
    EXPECT_NEAR(sum(), 1.0, 1e-14);
    EXPECT_LT((mean_of([](const Vec3& x) { return x; }) - point).norm(), 1e-15);
  }
}

TEST_F(Attachments, of_a_disc_that_has_moved_are_those_of_a_new_one) {
  for (int i = 0; i < 100; ++i) {
    const Vec3 axis = random_axis(), centre = 0.9 * random_point();
    Attachment moved;
    embed_disc_into(moved, locator_, centre + 1e-3 * random_axis(), axis, 3e-3, nodes_);
    embed_disc_into(moved, locator_, centre, axis, 3e-3, nodes_);
    Attachment fresh;
    embed_disc_into(fresh, locator_, centre, axis, 3e-3, nodes_);
    EXPECT_EQ(moved.node, fresh.node);
    EXPECT_EQ(moved.weight, fresh.weight);
  }
}

TEST_F(Attachments, carry_rigid_motion_of_a_disc_exactly) {
  const Mat3 turn = Eigen::AngleAxisd(0.8, random_axis()).toRotationMatrix();
  const Vec3 shift(0.02, -0.01, 0.03), centre(0.001, 0.002, 0.015), axis = random_axis();
  const auto moved = [&](const Vec3& x) { return Vec3(turn * x + shift); };
  embed_disc_into(at_, locator_, centre, axis, 4e-3, nodes_);
  EXPECT_NEAR(sum(), 1.0, 1e-14);
  EXPECT_LT((mean_of(moved) - moved(centre)).norm(), 1e-15);
  std::vector<Vec3> now;
  for (const Vec3& x : mesh_.nodes) now.push_back(moved(x));
  EXPECT_NEAR(displacement_along(at_, now, mesh_.nodes, axis), axis.dot(moved(centre) - centre), 1e-15);
}

TEST_F(Attachments, give_back_the_force_and_its_moment) {
  for (bool disc : {false, true}) {
    const Vec3 point = 0.5 * random_point() + Vec3(0.0, 0.0, 0.0075), axis = random_axis();
    if (disc)
      embed_disc_into(at_, locator_, point, axis, 4e-3, nodes_);
    else
      embed_point_into(at_, locator_, point, 0.0, nodes_);
    numeric::NodeVector load = nothing();
    add_along(load, at_, 1.7, axis);
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (int i = 0; i < nodes_; ++i) {
      force += numeric::at(load, i);
      moment += mesh_.nodes[i].cross(Vec3(numeric::at(load, i)));
    }
    EXPECT_LT((force - 1.7 * axis).norm(), 1e-14);
    EXPECT_LT((moment - point.cross(1.7 * axis)).norm(), 1e-15);
  }
}

TEST_F(Attachments, do_the_same_work_on_either_side) {
  embed_disc_into(at_, locator_, Vec3(0.0, 0.0, 0.015), Vec3::UnitZ(), 4e-3, nodes_);
  const Vec3 axis = random_axis();
  numeric::NodeVector load = nothing(), velocity = nothing();
  for (int i = 0; i < nodes_; ++i) numeric::at(velocity, i) = random_axis();
  add_along(load, at_, 2.3, axis);
  EXPECT_NEAR(numeric::dot(load, velocity), 2.3 * along(at_, velocity, axis), 1e-15);
}

// On a mesh much finer than the disc the second moment of its weights about a diameter is that of an even
// load over the circle, a^2 / 4. Each ring stands at the radius that halves its area, which makes the polar
// second moment exact.
TEST(Disc, spreads_a_load_like_even_pressure) {
  const mesh::TetMesh mesh = mesh::build_block(Vec3(0.012, 0.012, 0.001), {48, 48, 1});
  const mesh::Locator locator(mesh);
  const double radius = 5e-3, cell = 0.25e-3;
  Attachment at;
  embed_disc_into(at, locator, Vec3(0.0, 0.0, 0.001), -Vec3::UnitZ(), radius,
                  static_cast<int>(mesh.nodes.size()));
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < at.node.size(); ++i) {
    const Vec3& x = mesh.nodes[at.node[i]];
    xx += at.weight[i] * x.x() * x.x();
    yy += at.weight[i] * x.y() * x.y();
    xy += at.weight[i] * x.x() * x.y();
  }
  // Interpolation between nodes at distance c adds at most c^2 / 4 to a mean square.
  EXPECT_NEAR(xx, radius * radius / 4.0, 0.25 * cell * cell);
  EXPECT_NEAR(yy, radius * radius / 4.0, 0.25 * cell * cell);
  EXPECT_NEAR(xy, 0.0, 0.25 * cell * cell);
}

TEST_F(Attachments, leave_out_held_nodes_and_points_far_outside) {
  embed_disc_into(at_, locator_, Vec3(0.0, 0.0, 0.015), Vec3::UnitZ(), 4e-3, nodes_);
  const Attachment all = at_;
  const int free_nodes = all.node[0];  // at least one of the disc's nodes is held now
  embed_disc_into(at_, locator_, Vec3(0.0, 0.0, 0.015), Vec3::UnitZ(), 4e-3, free_nodes);
  double expected = 0.0;
  for (std::size_t i = 0; i < all.node.size(); ++i)
    if (all.node[i] < free_nodes) expected += all.weight[i];
  EXPECT_NEAR(sum(), expected, 1e-15);
  EXPECT_LT(sum(), 1.0);
  for (int node : at_.node) EXPECT_LT(node, free_nodes);
  embed_point_into(at_, locator_, Vec3(0.0, 0.0, 0.035), 1e-3, nodes_);
  EXPECT_TRUE(at_.empty());
  embed_point_into(at_, locator_, Vec3(0.0, 0.0, 0.0305), 1e-3, nodes_);
  EXPECT_LT((mean_of([](const Vec3& x) { return x; }) - Vec3(0.0, 0.0, 0.03)).norm(), 1e-15);
}

TEST_F(Attachments, of_the_paper_hold_one_node_the_nearest_at_rest) {
  for (int i = 0; i < 50; ++i) {
    const Vec3 point = random_point();
    attach_to_nearest_node_into(at_, locator_, point, nodes_);
    ASSERT_EQ(at_.node.size(), 1U);
    EXPECT_EQ(at_.weight[0], 1.0);
    for (const Vec3& x : mesh_.nodes)
      EXPECT_LE((mesh_.nodes[at_.node[0]] - point).norm(), (x - point).norm());
  }
}

}  // namespace
}  // namespace acus::coupling
