// Tissue on its own: stepped under nodal loads, or brought to rest under them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "acus/mesh/block.h"
#include "acus/numeric/conjugate_gradients.h"
#include "acus/tissue/motion.h"
#include "acus/tissue/rest_matrix.h"

namespace acus::tissue {

// `mesh` with the held nodes last, as the model wants them.
struct HeldMesh {
  mesh::TetMesh mesh;
  int free_nodes = 0;
};

inline HeldMesh held_mesh(const mesh::TetMesh& given, const std::function<bool(const Vec3&)>& held) {
  std::vector<int> order(given.nodes.size());
  std::iota(order.begin(), order.end(), 0);
  const auto middle =
      std::stable_partition(order.begin(), order.end(), [&](int i) { return !held(given.nodes[i]); });
  HeldMesh result{given, static_cast<int>(middle - order.begin())};
  std::vector<int> new_index(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    result.mesh.nodes[i] = given.nodes[order[i]];
    new_index[order[i]] = static_cast<int>(i);
  }
  for (mesh::Tet& t : result.mesh.tets)
    for (int& node : t) node = new_index[node];
  return result;
}

inline bool at_bottom(const Vec3& x) { return x.z() < 1e-9; }
inline bool nowhere(const Vec3&) { return false; }

class BareTissue {
 public:
  TissueModel model;
  std::vector<Vec3> rest, position;
  numeric::NodeVector velocity, load;  // m/s and N, [free nodes]
  Corotation corotation;
  SystemMatrix matrix;
  MaxwellBranch branch;
  double relative_residual = 1e-14;  // of the conjugate gradients
  int iterations = 0;

  BareTissue(const HeldMesh& held, const std::vector<Material>& materials, ElementKind kind,
             const RelaxationStep& relaxation = {})
      : model(build_tissue_model(held.mesh, materials, kind, held.free_nodes, relaxation).value()),
        rest(held.mesh.nodes),
        position(rest),
        velocity(static_cast<std::size_t>(numeric::node_stride) * held.free_nodes, 0.0),
        load(velocity),
        corotation(build_corotation(model)),
        matrix(build_system_matrix(model)),
        branch(build_branch(model)),
        scratch_(model.free_nodes) {
    corotate_into(corotation, model, position);
  }
  BareTissue(const HeldMesh& held, const Material& material, ElementKind kind,
             const RelaxationStep& relaxation = {})
      : BareTissue(held, std::vector<Material>(held.mesh.tets.size(), material), kind, relaxation) {}

  // One step of linearly implicit Euler, as motion.h writes it.
  void step(double h, const Rayleigh& damping = {}) {
    const StepFactors factors = step_factors(h, damping);
    set_factors(factors);
    numeric::NodeVector momentum(velocity.size(), 0.0);
    momentum_into(momentum, model, velocity, corotation.elastic_force, h);
    numeric::add_scaled_into(momentum, h, load);
    solve(velocity, momentum);
    move(position, velocity, h);
    corotate_into(corotation, branch, model, position);
  }

  // The displacement that the stiffness of the present configuration gives under `force`.
  numeric::NodeVector linear_answer(const numeric::NodeVector& force) {
    set_factors({.mass = 0.0, .stiffness = 1.0});
    numeric::NodeVector answer(force.size(), 0.0);
    solve(answer, force);
    return answer;
  }

  // Newton's method with the frozen K', until the forces balance to `tolerance` of the load.
  void settle(double tolerance = 1e-9, int most_iterations = 200) {
    const double target = tolerance * std::sqrt(numeric::dot(load, load));
    for (int i = 0; i < most_iterations; ++i) {
      const numeric::NodeVector force = imbalance();
      const double norm = std::sqrt(numeric::dot(force, force));
      if (norm <= target) return;
      const numeric::NodeVector change = linear_answer(force);
      move(position, change, 1.0);
      corotate_into(corotation, model, position);
    }
    FAIL() << "the tissue has not come to rest";
  }

  // Load and elastic force together, N, over the free nodes.
  numeric::NodeVector imbalance() const {
    numeric::NodeVector force = load;
    for (std::size_t i = 0; i < force.size(); ++i) force[i] += corotation.elastic_force[i];
    return force;
  }

  numeric::NodeVector times_matrix(const numeric::NodeVector& x) const {
    numeric::NodeVector y(x.size(), 0.0);
    multiply_into(y, model, corotation, matrix, x);
    return y;
  }

 private:
  void set_factors(const StepFactors& factors) {
    tissue::set_factors(matrix, model, factors.mass, factors.stiffness);
    if (!inverse_block_.empty() && factors.mass == factors_.mass && factors.stiffness == factors_.stiffness)
      return;
    factors_ = factors;
    inverse_block_ = numeric::inverse_diagonal(rest_matrix(model, factors.mass, factors.stiffness));
  }
  void solve(numeric::NodeVector& x, const numeric::NodeVector& b) {
    const double norm = std::sqrt(numeric::dot(b, b));
    const auto outcome = numeric::solve_into(
        x, b, relative_residual * norm, 20000, scratch_,
        [&](numeric::NodeVector& y, const numeric::NodeVector& p) {
          multiply_into(y, model, corotation, matrix, p);
        },
        [&](numeric::NodeVector& z, const numeric::NodeVector& r) {
          const double size =
              std::sqrt(numeric::dot(r, r));  // so that nothing falls below the smallest float
          numeric::NodeVectorOf<float> single(r.size()), product(r.size());
          numeric::scale_into(single, size > 0.0 ? 1.0 / size : 1.0, r);
          numeric::multiply_blocks_into(product, inverse_block_, single);
          numeric::scale_into(z, size, product);
        });
    iterations = outcome.iterations;
    EXPECT_LE(outcome.residual_norm, relative_residual * norm);
  }
  numeric::SolveScratch<double> scratch_;
  std::vector<float> inverse_block_;  // for the factors below
  StepFactors factors_;
};

// The same test for the paper's element and for the one that does not lock.
class BothElements : public ::testing::TestWithParam<ElementKind> {};
inline std::string element_name(const ::testing::TestParamInfo<ElementKind>& info) {
  return info.param == ElementKind::linear ? "linear" : "nodal_pressure";
}
#define ACUS_FOR_BOTH_ELEMENTS(suite)                                                                    \
  INSTANTIATE_TEST_SUITE_P(, suite, ::testing::Values(ElementKind::linear, ElementKind::nodal_pressure), \
                           element_name)

}  // namespace acus::tissue
