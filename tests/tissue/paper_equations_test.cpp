// Eq. 1-7 as they are printed, against the code that computes the same without the 12x12 matrices.
#include <gtest/gtest.h>

#include "tests/oracles/dense.h"
#include "tests/tissue/irregular_block.h"
#include "tests/tissue/literal_tissue.h"
#include "tests/tissue/tissue_driver.h"

namespace acus::tissue {
namespace {

class PaperEquations : public BothElements {};
ACUS_FOR_BOTH_ELEMENTS(PaperEquations);

Eigen::VectorXd unpadded(const numeric::NodeVector& v) {
  Eigen::VectorXd dense(v.size() / numeric::node_stride * 3);
  for (int i = 0; i < dense.size() / 3; ++i) dense.segment<3>(3 * i) = numeric::at(v, i);
  return dense;
}
numeric::NodeVector padded(const Eigen::VectorXd& v) {
  numeric::NodeVector nodes(static_cast<std::size_t>(v.size() / 3 * numeric::node_stride), 0.0);
  for (int i = 0; i < v.size() / 3; ++i) numeric::at(nodes, i) = v.segment<3>(3 * i);
  return nodes;
}

TEST_P(PaperEquations, warped_force_of_eq_5) {
  const HeldMesh held = held_mesh(irregular_block(), at_bottom);
  const auto materials = mixed_materials(held.mesh.tets.size());
  BareTissue tissue(held, materials, GetParam());
  const LiteralTissue literal(held.mesh, materials, GetParam());
  for (double spread : {1e-4, 1e-3, 5e-3, 2e-2}) {  // m; the boxes are 10 mm, so the last is a crumple
    tissue.position = jolted(tissue.rest, spread, 3);
    corotate_into(tissue.corotation, tissue.model, tissue.position);
    const Eigen::VectorXd expected = literal.at(tissue.position).force;
    const Eigen::VectorXd force = unpadded(tissue.corotation.elastic_force);
    EXPECT_LT((force - expected).norm(), 1e-12 * expected.norm()) << "spread " << spread;
  }
}

TEST_P(PaperEquations, assembled_stiffness_of_eq_4_to_6) {
  const HeldMesh held = held_mesh(irregular_block(), at_bottom);
  const auto materials = mixed_materials(held.mesh.tets.size());
  BareTissue tissue(held, materials, GetParam());
  const LiteralTissue literal(held.mesh, materials, GetParam());
  const int size = 3 * held.free_nodes;
  for (double spread : {0.0, 1e-3, 2e-2}) {
    tissue.position = jolted(tissue.rest, spread, 4);
    corotate_into(tissue.corotation, tissue.model, tissue.position);
    set_factors(tissue.matrix, tissue.model, 0.0, 1.0);
    Eigen::MatrixXd columns(size, size);
    for (int j = 0; j < size; ++j)
      columns.col(j) = unpadded(tissue.times_matrix(padded(Eigen::VectorXd::Unit(size, j))));
    const Eigen::MatrixXd expected = literal.at(tissue.position).stiffness.topLeftCorner(size, size);
    EXPECT_LT((columns - expected).norm(), 1e-12 * expected.norm()) << "spread " << spread;
  }
}

TEST_P(PaperEquations, system_matrix_of_eq_7) {
  const HeldMesh held = held_mesh(irregular_block(), at_bottom);
  const auto materials = mixed_materials(held.mesh.tets.size());
  BareTissue tissue(held, materials, GetParam());
  const LiteralTissue literal(held.mesh, materials, GetParam());
  const double h = 1e-3, alpha = 3.0, beta = 2e-3;
  const StepFactors factors = step_factors(h, {alpha, beta});
  tissue.position = jolted(tissue.rest, 3e-3, 5);
  corotate_into(tissue.corotation, tissue.model, tissue.position);
  set_factors(tissue.matrix, tissue.model, factors.mass, factors.stiffness);
  const int size = 3 * held.free_nodes;
  const Eigen::MatrixXd K = literal.at(tissue.position).stiffness.topLeftCorner(size, size);
  const Eigen::MatrixXd M = literal.lumped_mass().head(size).asDiagonal();
  const Eigen::MatrixXd A = M + h * (alpha * M + beta * K) + h * h * K;  // M + h D + h^2 K
  const Eigen::VectorXd x = Eigen::VectorXd::Random(size);
  EXPECT_LT((unpadded(tissue.times_matrix(padded(x))) - A * x).norm(), 1e-12 * (A * x).norm());
}

TEST_P(PaperEquations, stored_matrix_at_rest_is_that_of_eq_7) {
  const HeldMesh held = held_mesh(irregular_block(), at_bottom);
  const auto materials = mixed_materials(held.mesh.tets.size());
  const BareTissue tissue(held, materials, GetParam());
  const LiteralTissue literal(held.mesh, materials, GetParam());
  const StepFactors factors = step_factors(1e-3, {3.0, 2e-3});
  const int size = 3 * held.free_nodes;
  const Eigen::MatrixXd K = literal.at(tissue.position).stiffness.topLeftCorner(size, size);
  const Eigen::MatrixXd M = literal.lumped_mass().head(size).asDiagonal();
  const Eigen::MatrixXd A = factors.mass * M + factors.stiffness * K;
  Eigen::MatrixXd stored = Eigen::MatrixXd::Zero(size, size);
  const numeric::LowerBlocks rest = rest_matrix(tissue.model, factors.mass, factors.stiffness);
  ASSERT_EQ(rest.rows.size(), static_cast<std::size_t>(held.free_nodes));
  for (int i = 0; i < held.free_nodes; ++i)
    for (const auto& e : rest.rows[i]) {
      stored.block<3, 3>(3 * i, 3 * e.column) = e.block;
      stored.block<3, 3>(3 * e.column, 3 * i) = e.block.transpose();
    }
  EXPECT_LT((stored - A).norm(), 1e-12 * A.norm());

  // Jacobi's preconditioner, node by node.
  const std::vector<float> inverse = numeric::inverse_diagonal(rest);
  for (int i = 0; i < held.free_nodes; ++i) {
    Mat3 block;
    for (int c = 0; c < 3; ++c) block.col(c) = numeric::at(inverse, 3 * i + c).cast<double>();
    EXPECT_LT((block * A.block<3, 3>(3 * i, 3 * i) - Mat3::Identity()).norm(), 1e-5)
        << "node " << i;  // floats
  }
}

TEST_P(PaperEquations, steps_of_a_small_block_are_those_of_a_dense_solver) {
  // 300 tetrahedra pressed at the middle of the top, 60 steps; M + h^2 K is factored in each.
  const HeldMesh held = held_mesh(mesh::build_block(Vec3(0.05, 0.05, 0.02), {5, 5, 2}), at_bottom);
  const std::vector<Material> materials(held.mesh.tets.size(), soft);
  BareTissue tissue(held, materials, GetParam());
  const LiteralTissue literal(held.mesh, materials, GetParam());
  const double h = 1e-3;
  const int size = 3 * held.free_nodes;
  const Eigen::VectorXd mass = literal.lumped_mass().head(size);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(size), velocity = Eigen::VectorXd::Zero(size);
  for (int i = 0; i < held.free_nodes; ++i)
    if (held.mesh.nodes[i].z() > 0.019 && held.mesh.nodes[i].head<2>().norm() < 0.01) load[3 * i + 2] = -1.0;
  tissue.load = padded(load);
  std::vector<Vec3> position = held.mesh.nodes;
  double largest = 0.0;
  for (int step = 0; step < 60; ++step) {
    tissue.step(h);
    const auto response = literal.at(position);
    const Eigen::MatrixXd K = response.stiffness.topLeftCorner(size, size);
    Eigen::MatrixXd A = h * h * K;
    A.diagonal() += mass;
    const Eigen::VectorXd force = load + response.force.head(size) - h * K * velocity;
    velocity += testing::solve_positive(A, h * force);
    double worst = 0.0;
    for (int i = 0; i < held.free_nodes; ++i) {
      position[i] += h * velocity.segment<3>(3 * i);
      worst = std::max(worst, (position[i] - tissue.position[i]).norm());
      largest = std::max(largest, (position[i] - held.mesh.nodes[i]).norm());
    }
    ASSERT_LT(worst, 1e-9 * largest) << "step " << step;
  }
  EXPECT_GT(largest, 2e-3);  // m: a large deformation of a layer 20 mm thick
}

}  // namespace
}  // namespace acus::tissue
