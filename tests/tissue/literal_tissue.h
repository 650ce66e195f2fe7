// The paper's tissue, equation by equation as it is printed, in dense matrices: slow, and written apart from
// the code under test.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "acus/mesh/tet_mesh.h"
#include "acus/tissue/element_kind.h"
#include "acus/tissue/material.h"

namespace acus::tissue {

class LiteralTissue {
 public:
  LiteralTissue(const mesh::TetMesh& mesh, const std::vector<Material>& materials, ElementKind kind);

  // f = -R K (R^-1 x - x_0) (Eq. 5) summed over the elements, and the assembled R K R^-1.
  struct Response {
    Eigen::VectorXd force;
    Eigen::MatrixXd stiffness;
  };
  Response at(const std::vector<Vec3>& position) const;

  // A quarter of each tetrahedron's mass at each corner, three times over.
  Eigen::VectorXd lumped_mass() const;

 private:
  using Vector12 = Eigen::Matrix<double, 12, 1>;
  using Matrix12 = Eigen::Matrix<double, 12, 12>;
  using Matrix6x12 = Eigen::Matrix<double, 6, 12>;

  const Vec3& rest(std::size_t e, int corner) const { return mesh_.nodes[mesh_.tets[e][corner]]; }
  double volume(std::size_t e) const;
  Eigen::Matrix<double, 3, 4> gradients(std::size_t e) const;
  Matrix6x12 strain_matrix(std::size_t e) const;
  Eigen::Matrix<double, 6, 6> hooke(const Material& m) const;
  Mat3 rotation(std::size_t e, const std::vector<Vec3>& position) const;
  Vector12 corners(std::size_t e, const std::vector<Vec3>& x) const;
  void scatter(std::size_t e, const Vector12& f, Eigen::VectorXd& out) const;

  mesh::TetMesh mesh_;
  std::vector<Material> materials_;
  ElementKind kind_;
  std::vector<double> node_volume_, node_bulk_;
};

}  // namespace acus::tissue
