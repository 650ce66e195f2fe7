// What holds for every element on every mesh: patch test, rigid motion, energy and force, stiffness.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/tissue/irregular_block.h"
#include "tests/tissue/tissue_driver.h"

namespace acus::tissue {
namespace {

class Elements : public BothElements {};
ACUS_FOR_BOTH_ELEMENTS(Elements);

bool on_surface(const Vec3& x) {
  constexpr double near = 1e-9;
  return std::abs(x.x()) > 0.015 - near || std::abs(x.y()) > 0.02 - near || x.z() < near ||
         x.z() > 0.03 - near;
}

double norm(const numeric::NodeVector& v) { return std::sqrt(numeric::dot(v, v)); }

numeric::NodeVector random_vector(int nodes, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  numeric::NodeVector v(static_cast<std::size_t>(numeric::node_stride) * nodes, 0.0);
  for (int i = 0; i < nodes; ++i) numeric::at(v, i) = Vec3(normal(random), normal(random), normal(random));
  return v;
}

TEST_P(Elements, reproduce_a_linear_field_on_an_irregular_mesh) {
  const HeldMesh held = held_mesh(irregular_block(), on_surface);
  ASSERT_GT(held.free_nodes, 10);
  BareTissue tissue(held, soft, GetParam());
  Mat3 stretch;  // shears and stretches of some per cent, turned by 40 degrees
  stretch << 0.03, 0.02, -0.01, 0.02, -0.04, 0.015, -0.01, 0.015, 0.012;
  const Mat3 F = Eigen::AngleAxisd(0.7, Vec3(1.0, 0.5, -2.0).normalized()) * (Mat3::Identity() + stretch);
  const auto field = [&](const Vec3& x) { return Vec3(F * x + Vec3(0.01, -0.02, 0.03)); };
  tissue.position = jolted(tissue.rest, 1e-3, 2);  // the free nodes start beside their places
  for (std::size_t i = 0; i < tissue.rest.size(); ++i)
    tissue.position[i] =
        static_cast<int>(i) < held.free_nodes ? field(tissue.position[i]) : field(tissue.rest[i]);
  corotate_into(tissue.corotation, tissue.model, tissue.position);
  const double start = norm(tissue.imbalance());
  for (int newton = 0; newton < 100; ++newton) {
    const auto change = tissue.linear_answer(tissue.imbalance());
    move(tissue.position, change, 1.0);
    corotate_into(tissue.corotation, tissue.model, tissue.position);
  }
  EXPECT_LT(norm(tissue.imbalance()), 1e-12 * start);
  for (int i = 0; i < held.free_nodes; ++i)
    EXPECT_LT((tissue.position[i] - field(tissue.rest[i])).norm(), 1e-10 * 0.03);
}

TEST_P(Elements, feel_no_force_and_no_energy_in_rigid_motion) {
  const HeldMesh held = held_mesh(irregular_block(), nowhere);
  BareTissue tissue(held, mixed_materials(held.mesh.tets.size()), GetParam());
  const double force_scale = soft.youngs_modulus * 0.03 * 0.03;
  for (double angle : {0.1, 1.0, 2.0, 3.1415, 5.0}) {
    const Mat3 turn = Eigen::AngleAxisd(angle, Vec3(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
    for (std::size_t i = 0; i < tissue.rest.size(); ++i)
      tissue.position[i] = turn * tissue.rest[i] + Vec3(0.3, -0.1, 0.2);
    corotate_into(tissue.corotation, tissue.model, tissue.position);
    EXPECT_LT(norm(tissue.corotation.elastic_force), 1e-10 * force_scale);
    EXPECT_LT(std::abs(tissue.corotation.energy), 1e-10 * force_scale * 0.03);
  }
}

// What linear elasticity gets wrong: turned by 60 degrees it sees a shrinking by 1 - cos 60.
TEST_P(Elements, feel_no_ghost_force_where_unrotated_stiffness_would_inflate_them) {
  const HeldMesh held = held_mesh(irregular_block(), nowhere);
  BareTissue tissue(held, soft, GetParam());
  set_factors(tissue.matrix, tissue.model, 0.0, 1.0);  // K at rest
  const Mat3 turn = Eigen::AngleAxisd(std::acos(0.5), Vec3::UnitZ()).toRotationMatrix();
  numeric::NodeVector displacement(tissue.velocity.size(), 0.0);
  for (std::size_t i = 0; i < tissue.rest.size(); ++i) {
    tissue.position[i] = turn * tissue.rest[i];
    numeric::at(displacement, static_cast<int>(i)) = tissue.position[i] - tissue.rest[i];
  }
  corotate_into(tissue.corotation, tissue.model, tissue.position);
  const double ghost = norm(tissue.times_matrix(displacement));
  EXPECT_GT(ghost, 1.0);  // N
  EXPECT_LT(norm(tissue.corotation.elastic_force), 1e-12 * ghost);
}

TEST_P(Elements, push_with_no_net_force_and_no_net_moment) {
  const HeldMesh held = held_mesh(irregular_block(), nowhere);
  BareTissue tissue(held, mixed_materials(held.mesh.tets.size()), GetParam());
  tissue.position = jolted(tissue.rest, 4e-3, 8);
  corotate_into(tissue.corotation, tissue.model, tissue.position);
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  for (int i = 0; i < tissue.model.nodes; ++i) {
    force += numeric::at(tissue.corotation.elastic_force, i);
    moment += tissue.position[i].cross(Vec3(numeric::at(tissue.corotation.elastic_force, i)));
  }
  const double scale = norm(tissue.corotation.elastic_force);
  EXPECT_LT(force.norm(), 1e-13 * scale);
  EXPECT_LT(moment.norm(), 1e-13 * scale * 0.05);
}

TEST_P(Elements, have_a_symmetric_positive_definite_system_matrix) {
  const HeldMesh held = held_mesh(irregular_block(), at_bottom);
  BareTissue tissue(held, mixed_materials(held.mesh.tets.size()), GetParam());
  for (double spread : {0.0, 2e-3, 1e-2}) {
    tissue.position = jolted(tissue.rest, spread, 9);
    corotate_into(tissue.corotation, tissue.model, tissue.position);
    set_factors(tissue.matrix, tissue.model, 0.0, 1.0);
    for (unsigned seed = 0; seed < 20; ++seed) {
      const auto x = random_vector(held.free_nodes, 2 * seed),
                 y = random_vector(held.free_nodes, 2 * seed + 1);
      const auto Ax = tissue.times_matrix(x), Ay = tissue.times_matrix(y);
      EXPECT_LT(std::abs(numeric::dot(x, Ay) - numeric::dot(y, Ax)), 1e-12 * norm(x) * norm(Ay));
      EXPECT_GT(numeric::dot(x, Ax), 0.0);
    }
    // The smallest eigenvalue, of the softest direction, by inverse iteration.
    auto x = random_vector(held.free_nodes, 77);
    for (int i = 0; i < 5; ++i) {
      x = tissue.linear_answer(x);
      const double length = norm(x);
      for (double& component : x) component /= length;
    }
    EXPECT_GT(numeric::dot(x, tissue.times_matrix(x)), 1e-3);  // N/m; E times the size is 750
  }
}

// dW/ds at s = 0 of the energy along x + s d, by central differences with Richardson's extrapolation.
double energy_slope(BareTissue& tissue, const numeric::NodeVector& direction, double reach) {
  const std::vector<Vec3> from = tissue.position;
  const auto energy_at = [&](double s) {
    tissue.position = from;
    move(tissue.position, direction, s);
    corotate_into(tissue.corotation, tissue.model, tissue.position);
    return tissue.corotation.energy;
  };
  const auto central = [&](double s) { return (energy_at(s) - energy_at(-s)) / (2.0 * s); };
  const double slope = (4.0 * central(0.5 * reach) - central(reach)) / 3.0;
  tissue.position = from;
  corotate_into(tissue.corotation, tissue.model, tissue.position);
  return slope;
}

TEST_P(Elements, push_with_the_gradient_of_their_energy) {
  const HeldMesh held = held_mesh(irregular_block(), nowhere);
  BareTissue tissue(held, mixed_materials(held.mesh.tets.size()), GetParam());
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Mat3 F = Mat3::Identity() + 0.4 * Mat3::Random();
    tissue.position = jolted(tissue.rest, 1e-3, seed);
    for (Vec3& x : tissue.position) x = F * x;
    corotate_into(tissue.corotation, tissue.model, tissue.position);
    const numeric::NodeVector force = tissue.corotation.elastic_force;
    const auto direction = random_vector(tissue.model.nodes, 100 + seed);
    const double expected = -numeric::dot(force, direction);
    EXPECT_NEAR(energy_slope(tissue, direction, 1e-6), expected, 1e-6 * norm(force) * norm(direction) * 0.1);
  }
}

// f(x + s d) - f(x) with every element's R as it is at x: -K' d s, since the force is linear in x then. The
// frozen rotation is had by turning the element's own frame: near rest, where R = 1 to first order for any
// displacement without rotation, a symmetric gradient field.
TEST_P(Elements, have_the_stiffness_of_their_force_where_rotations_stay) {
  const HeldMesh held = held_mesh(irregular_block(), nowhere);
  BareTissue tissue(held, mixed_materials(held.mesh.tets.size()), GetParam());
  const Mat3 turn = Eigen::AngleAxisd(1.2, Vec3(0.3, 1.0, -0.4).normalized()).toRotationMatrix();
  for (unsigned seed = 0; seed < 10; ++seed) {
    // x = turn (I + S) X with symmetric S: R is `turn` everywhere, whatever S.
    const auto stretched = [&](const Mat3& S) {
      for (std::size_t i = 0; i < tissue.rest.size(); ++i)
        tissue.position[i] = turn * (tissue.rest[i] + S * tissue.rest[i]);
      corotate_into(tissue.corotation, tissue.model, tissue.position);
      return tissue.corotation.elastic_force;
    };
    const Mat3 random = Mat3::Random();
    const Mat3 S = 0.1 * (random + random.transpose()), dS = 0.1 * Mat3(random * random.transpose());
    const auto force = stretched(S);
    set_factors(tissue.matrix, tissue.model, 0.0, 1.0);
    numeric::NodeVector change(tissue.velocity.size(), 0.0);
    for (std::size_t i = 0; i < tissue.rest.size(); ++i)
      numeric::at(change, static_cast<int>(i)) = turn * dS * tissue.rest[i];
    auto difference = stretched(S + dS);
    numeric::add_scaled_into(difference, -1.0, force);
    const double size = norm(difference);
    numeric::add_scaled_into(difference, 1.0, tissue.times_matrix(change));
    EXPECT_LT(norm(difference), 1e-11 * size);
  }
}

}  // namespace
}  // namespace acus::tissue
