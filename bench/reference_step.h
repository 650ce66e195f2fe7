// The reference that a step of acus is measured against: co-rotational tetrahedra with plain Eigen, as the
// textbook says it, one implicit Euler step at a time.
//
//   (M + h^2 K') v1 = M v0 + h (f_el(x0) + f_ext),   x1 = x0 + h v1,   K' = sum_e R_e K_e R_e^T (paper Eq.
//   4-7)
//
// Dense 12x12 element stiffness, polar rotations by Higham's iteration, one scalar compressed-row matrix,
// Eigen's conjugate gradients with its diagonal preconditioner, a fixed number of iterations. No needle.
// Starting them from v0 gives the iterates that the equation for the change of velocity gives from nothing.
#pragma once

#include <Eigen/Sparse>
#include <array>
#include <vector>

#include "acus/mesh/tet_mesh.h"
#include "residual.h"

namespace acus::bench {

inline constexpr int reference_iterations = 25;  // of conjugate gradients, every step

class ReferenceStep {
 public:
  // A block of the default tissue, its bottom held, 1 N pressing on the centre of its top; about
  // `tetrahedra`, five to a cube.
  explicit ReferenceStep(int tetrahedra);

  void restart();  // from rest
  void advance();

  Residual residual() const;  // of the last step, not part of its cost
  int tetrahedra() const { return static_cast<int>(mesh_.tets.size()); }
  int nodes() const { return static_cast<int>(mesh_.nodes.size()); }

 private:
  using ElementMatrix = Eigen::Matrix<double, 12, 12>;
  struct Element {
    Mat3 inverse_edges;       // 1/m
    ElementMatrix stiffness;  // N/m
    Mat3 rotation = Mat3::Identity();
    std::array<int, 16> place;  // of corner pair (i, j)'s first entry within the matrix row of node i
  };

  void build_elements();
  void build_matrix();
  void load_top();
  void rotate_elements();
  void assemble();

  mesh::TetMesh mesh_;
  std::vector<bool> held_;  // [nodes]
  std::vector<Element> elements_;
  std::vector<int> diagonal_place_;  // [nodes] of a node's own first entry within its matrix rows
  Eigen::VectorXd mass_;             // kg, [nodes]
  Eigen::VectorXd load_;             // N, [3 nodes]
  Eigen::VectorXd position_, velocity_, velocity_before_, right_hand_side_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix_;
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double, Eigen::RowMajor>, Eigen::Lower | Eigen::Upper> solver_;
};

}  // namespace acus::bench
