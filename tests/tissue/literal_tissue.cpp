#include "tests/tissue/literal_tissue.h"

#include <Eigen/LU>

#include "tests/oracles/dense.h"

namespace acus::tissue {
namespace {

Eigen::Matrix<double, 12, 12> four_times(const Mat3& R) {
  Eigen::Matrix<double, 12, 12> all = Eigen::Matrix<double, 12, 12>::Zero();
  for (int i = 0; i < 4; ++i) all.block<3, 3>(3 * i, 3 * i) = R;
  return all;
}

}  // namespace

LiteralTissue::LiteralTissue(const mesh::TetMesh& mesh, const std::vector<Material>& materials,
                             ElementKind kind)
    : mesh_(mesh),
      materials_(materials),
      kind_(kind),
      node_volume_(mesh.nodes.size(), 0.0),
      node_bulk_(mesh.nodes.size(), 0.0) {
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    for (int node : mesh.tets[e]) {
      const Material& m = materials[e];
      node_volume_[node] += volume(e) / 4.0;
      node_bulk_[node] += m.youngs_modulus / (3.0 - 6.0 * m.poisson_ratio) * volume(e) / 4.0;
    }
}

LiteralTissue::Response LiteralTissue::at(const std::vector<Vec3>& position) const {
  const Eigen::Index size = 3 * static_cast<Eigen::Index>(mesh_.nodes.size());
  Response r{Eigen::VectorXd::Zero(size), Eigen::MatrixXd::Zero(size, size)};
  const bool averaged = kind_ == ElementKind::nodal_pressure;
  Eigen::MatrixXd mean_divergence = Eigen::MatrixXd::Zero(averaged ? size / 3 : 0, size);
  Eigen::VectorXd mean_dilation = Eigen::VectorXd::Zero(averaged ? size / 3 : 0);
  for (std::size_t e = 0; e < mesh_.tets.size(); ++e) {
    const Matrix6x12 B = strain_matrix(e);
    const Matrix12 K = volume(e) * B.transpose() * hooke(materials_[e]) * B;  // Eq. 4
    const Vector12 x = corners(e, position), x0 = corners(e, mesh_.nodes);
    const Matrix12 R = four_times(rotation(e, position));
    const Vector12 u = R.transpose() * x - x0;
    scatter(e, -R * K * u, r.force);
    const Matrix12 turned = R * K * R.transpose();
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        r.stiffness.block<3, 3>(3 * mesh_.tets[e][i], 3 * mesh_.tets[e][j]) +=
            turned.block<3, 3>(3 * i, 3 * j);
    if (!averaged) continue;
    Eigen::Matrix<double, 1, 6> trace;
    trace << 1, 1, 1, 0, 0, 0;
    for (int node : mesh_.tets[e]) {
      const double share = volume(e) / (4.0 * node_volume_[node]);
      mean_dilation[node] += share * (trace * B * u).value();
      const Vector12 row = share * (trace * B * R.transpose()).transpose();
      for (int i = 0; i < 4; ++i)
        mean_divergence.block<1, 3>(node, 3 * mesh_.tets[e][i]) += row.segment<3>(3 * i).transpose();
    }
  }
  for (Eigen::Index a = 0; a < mean_dilation.size(); ++a) {
    const double weight = node_bulk_[a] / node_volume_[a] * node_volume_[a];  // kappa_a V_a
    r.force -= weight * mean_dilation[a] * mean_divergence.row(a).transpose();
    r.stiffness += weight * mean_divergence.row(a).transpose() * mean_divergence.row(a);
  }
  return r;
}

Eigen::VectorXd LiteralTissue::lumped_mass() const {
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(mesh_.nodes.size()));
  for (std::size_t e = 0; e < mesh_.tets.size(); ++e)
    for (int node : mesh_.tets[e])
      mass.segment<3>(3 * node).array() += materials_[e].density * volume(e) / 4.0;
  return mass;
}

double LiteralTissue::volume(std::size_t e) const {
  return (rest(e, 1) - rest(e, 0)).cross(rest(e, 2) - rest(e, 0)).dot(rest(e, 3) - rest(e, 0)) / 6.0;
}

// N_i = a_i + b_i x + c_i y + d_i z with N_i = 1 at corner i and 0 at the others (Eq. 1): rows 1-3 of the
// inverse of the matrix of corners hold (b, c, d).
Eigen::Matrix<double, 3, 4> LiteralTissue::gradients(std::size_t e) const {
  Eigen::Matrix4d corner_rows;
  for (int i = 0; i < 4; ++i) corner_rows.row(i) << 1.0, rest(e, i).transpose();
  return corner_rows.inverse().bottomRows<3>();
}

// Eq. 2: strain (xx, yy, zz, xy, yz, zx) with engineering shears.
LiteralTissue::Matrix6x12 LiteralTissue::strain_matrix(std::size_t e) const {
  const auto gradient = gradients(e);
  Matrix6x12 B;
  for (int i = 0; i < 4; ++i) {
    const double b = gradient(0, i), c = gradient(1, i), d = gradient(2, i);
    B.middleCols<3>(3 * i) << b, 0, 0, 0, c, 0, 0, 0, d, c, b, 0, 0, d, c, d, 0, b;
  }
  return B;
}

// Hooke's law (Eq. 3). Averaged pressure leaves to the element what changes its shape only.
Eigen::Matrix<double, 6, 6> LiteralTissue::hooke(const Material& m) const {
  const double E = m.youngs_modulus, nu = m.poisson_ratio, G = E / (2.0 + 2.0 * nu);
  Eigen::Matrix<double, 6, 6> D = Eigen::Matrix<double, 6, 6>::Zero();
  D.topLeftCorner<3, 3>().setConstant(nu);
  D.topLeftCorner<3, 3>().diagonal().setConstant(1.0 - nu);
  D.topLeftCorner<3, 3>() *= E / ((1.0 + nu) * (1.0 - 2.0 * nu));
  if (kind_ == ElementKind::nodal_pressure)
    D.topLeftCorner<3, 3>() = 2.0 * G * (Mat3::Identity() - Mat3::Constant(1.0 / 3.0));
  D.bottomRightCorner<3, 3>() = G * Mat3::Identity();
  return D;
}

Mat3 LiteralTissue::rotation(std::size_t e, const std::vector<Vec3>& position) const {
  Eigen::Matrix<double, 3, 4> x;
  for (int i = 0; i < 4; ++i) x.col(i) = position[mesh_.tets[e][i]];
  const Mat3 F = x * gradients(e).transpose();
  return testing::nearest_rotation(F);
}

LiteralTissue::Vector12 LiteralTissue::corners(std::size_t e, const std::vector<Vec3>& x) const {
  Vector12 all;
  for (int i = 0; i < 4; ++i) all.segment<3>(3 * i) = x[mesh_.tets[e][i]];
  return all;
}
void LiteralTissue::scatter(std::size_t e, const Vector12& f, Eigen::VectorXd& out) const {
  for (int i = 0; i < 4; ++i) out.segment<3>(3 * mesh_.tets[e][i]) += f.segment<3>(3 * i);
}

}  // namespace acus::tissue
