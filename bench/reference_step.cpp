#include "reference_step.h"

#include <algorithm>
#include <cmath>

#include "acus/sim/scene.h"

namespace acus::bench {
namespace {

constexpr double step = 1e-3;          // s
constexpr double load = 1.0;           // N
constexpr double load_radius = 12e-3;  // m, about the centre of the top

// Boxes as close to cubes as the block allows, five tetrahedra each.
std::array<int, 3> cells_for(const Vec3& size, int tetrahedra) {
  const double edge = std::cbrt(5.0 * size.prod() / tetrahedra);
  std::array<int, 3> cells;
  for (int c = 0; c < 3; ++c) cells[c] = std::max(1, static_cast<int>(std::lround(size[c] / edge)));
  return cells;
}

// One tetrahedron in the middle of each box, on every other corner, and one at each corner left over; the
// next box is its mirror image. Corner c lies at the far end along the axes whose bit is set.
mesh::TetMesh even_block(const Vec3& size, const std::array<int, 3>& cells) {
  const int nx = cells[0], ny = cells[1], nz = cells[2];
  mesh::TetMesh mesh;
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        mesh.nodes.emplace_back(size.x() * i / nx - 0.5 * size.x(), size.y() * j / ny - 0.5 * size.y(),
                                size.z() * k / nz);
  const auto add = [&](mesh::Tet tet) {
    if (mesh::signed_volume(mesh, tet) < 0.0) std::swap(tet[2], tet[3]);
    mesh.tets.push_back(tet);
  };
  for (int cell = 0; cell < nx * ny * nz; ++cell) {
    const int i = cell % nx, j = cell / nx % ny, k = cell / (nx * ny);
    const auto node = [&](int c) {
      return i + (c & 1) + (nx + 1) * (j + (c >> 1 & 1) + (ny + 1) * (k + (c >> 2)));
    };
    const int mirrored = (i + j + k) % 2;  // turns the corners round in pairs along x
    for (int c : {0, 3, 5, 6}) {
      const int corner = c ^ mirrored;
      add({node(corner), node(corner ^ 1), node(corner ^ 2), node(corner ^ 4)});
    }
    add({node(1 ^ mirrored), node(2 ^ mirrored), node(4 ^ mirrored), node(7 ^ mirrored)});
  }
  return mesh;
}

Mat3 polar_rotation(const Mat3& F) {
  constexpr int most_steps = 20;
  constexpr double converged = 1e-18;  // sum of squares of the correction
  Mat3 R = F;
  for (int i = 0; i < most_steps; ++i) {
    const Mat3 next = 0.5 * (R + R.inverse().transpose());
    const double change = (next - R).squaredNorm();
    R = next;
    if (change < converged) break;
  }
  return R;
}

}  // namespace

ReferenceStep::ReferenceStep(int tetrahedra)
    : mesh_(even_block(TissueScene{}.size, cells_for(TissueScene{}.size, tetrahedra))) {
  for (const Vec3& x : mesh_.nodes) held_.push_back(x.z() <= 0.0);
  build_elements();
  build_matrix();
  load_top();
  solver_.setMaxIterations(reference_iterations);
  solver_.setTolerance(0.0);
  restart();
}

void ReferenceStep::restart() {
  position_.resize(3 * nodes());
  for (int i = 0; i < nodes(); ++i) position_.segment<3>(3 * i) = mesh_.nodes[i];
  velocity_ = velocity_before_ = right_hand_side_ = Eigen::VectorXd::Zero(3 * nodes());
}

void ReferenceStep::build_elements() {
  const TissueScene tissue;
  const double mu = tissue.youngs_modulus / (2.0 * (1.0 + tissue.poisson_ratio));
  const double lambda = 2.0 * mu * tissue.poisson_ratio / (1.0 - 2.0 * tissue.poisson_ratio);
  mass_ = Eigen::VectorXd::Zero(nodes());
  for (const mesh::Tet& t : mesh_.tets) {
    Element& e = elements_.emplace_back();
    Mat3 edges;
    for (int c = 0; c < 3; ++c) edges.col(c) = mesh_.nodes[t[c + 1]] - mesh_.nodes[t[0]];
    const double volume = edges.determinant() / 6.0;
    e.inverse_edges = edges.inverse();
    Vec3 g[4];  // gradients of the shape functions
    for (int c = 0; c < 3; ++c) g[c + 1] = e.inverse_edges.row(c);
    g[0] = -(g[1] + g[2] + g[3]);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        e.stiffness.block<3, 3>(3 * i, 3 * j) =
            volume * (lambda * g[i] * g[j].transpose() + mu * g[j] * g[i].transpose() +
                      mu * g[i].dot(g[j]) * Mat3::Identity());
    for (int node : t) mass_[node] += tissue.density * volume / 4.0;
  }
}

void ReferenceStep::build_matrix() {
  std::vector<std::vector<int>> neighbours(nodes());
  for (const mesh::Tet& t : mesh_.tets)
    for (int i : t) neighbours[i].insert(neighbours[i].end(), t.begin(), t.end());
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < nodes(); ++i) {
    auto& row = neighbours[i];
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    diagonal_place_.push_back(3 *
                              static_cast<int>(std::lower_bound(row.begin(), row.end(), i) - row.begin()));
    for (int j : row)
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) entries.emplace_back(3 * i + r, 3 * j + c, 0.0);
  }
  matrix_.resize(3 * nodes(), 3 * nodes());
  matrix_.setFromTriplets(entries.begin(), entries.end());
  for (std::size_t e = 0; e < elements_.size(); ++e)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const auto& row = neighbours[mesh_.tets[e][i]];
        const auto at = std::lower_bound(row.begin(), row.end(), mesh_.tets[e][j]);
        elements_[e].place[4 * i + j] = 3 * static_cast<int>(at - row.begin());
      }
}

void ReferenceStep::load_top() {
  const double top = TissueScene{}.size.z();
  std::vector<int> loaded;
  for (int i = 0; i < nodes(); ++i)
    if (mesh_.nodes[i].z() >= (1.0 - 1e-9) * top && mesh_.nodes[i].head<2>().norm() < load_radius)
      loaded.push_back(i);
  load_ = Eigen::VectorXd::Zero(3 * nodes());
  for (int i : loaded) load_[3 * i + 2] = -load / static_cast<double>(loaded.size());
}

void ReferenceStep::advance() {
  rotate_elements();
  assemble();
  solver_.compute(matrix_);
  velocity_before_ = velocity_;
  velocity_ = solver_.solveWithGuess(right_hand_side_, velocity_before_);
  position_ += step * velocity_;
}

void ReferenceStep::rotate_elements() {
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const mesh::Tet& t = mesh_.tets[e];
    Mat3 edges;
    for (int c = 0; c < 3; ++c)
      edges.col(c) = position_.segment<3>(3 * t[c + 1]) - position_.segment<3>(3 * t[0]);
    elements_[e].rotation = polar_rotation(edges * elements_[e].inverse_edges);
  }
}

void ReferenceStep::assemble() {
  double* value = matrix_.valuePtr();
  const int* row_start = matrix_.outerIndexPtr();
  std::fill(value, value + matrix_.nonZeros(), 0.0);
  right_hand_side_ = step * load_;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const mesh::Tet& t = mesh_.tets[e];
    const Element& element = elements_[e];
    const Mat3& R = element.rotation;
    Eigen::Matrix<double, 12, 1> u;  // displacement, turned back
    for (int i = 0; i < 4; ++i)
      u.segment<3>(3 * i) = R.transpose() * position_.segment<3>(3 * t[i]) - mesh_.nodes[t[i]];
    const Eigen::Matrix<double, 12, 1> force = element.stiffness * u;
    for (int i = 0; i < 4; ++i) {
      right_hand_side_.segment<3>(3 * t[i]) -= step * (R * force.segment<3>(3 * i));
      for (int j = i; j < 4; ++j) {
        if (held_[t[i]] || held_[t[j]]) continue;
        const Mat3 block = step * step * (R * element.stiffness.block<3, 3>(3 * i, 3 * j) * R.transpose());
        for (int r = 0; r < 3; ++r) {
          double* at = value + row_start[3 * t[i] + r] + element.place[4 * i + j];
          for (int c = 0; c < 3; ++c) at[c] += block(r, c);
        }
        if (i == j) continue;
        for (int r = 0; r < 3; ++r) {
          double* at = value + row_start[3 * t[j] + r] + element.place[4 * j + i];
          for (int c = 0; c < 3; ++c) at[c] += block(c, r);
        }
      }
    }
  }
  for (int i = 0; i < nodes(); ++i)
    for (int r = 0; r < 3; ++r) {
      value[row_start[3 * i + r] + diagonal_place_[i] + r] += mass_[i];
      right_hand_side_[3 * i + r] =
          held_[i] ? 0.0 : right_hand_side_[3 * i + r] + mass_[i] * velocity_[3 * i + r];
    }
}

Residual ReferenceStep::residual() const {
  const double left = (right_hand_side_ - matrix_ * velocity_).norm();
  return {left / right_hand_side_.norm(), left / (right_hand_side_ - matrix_ * velocity_before_).norm(),
          left / (step * load)};
}

}  // namespace acus::bench
