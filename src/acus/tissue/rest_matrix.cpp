#include "acus/tissue/rest_matrix.h"

#include <algorithm>
#include <utility>

namespace acus::tissue {
namespace {

// Corner i's gradient at rest, 1/m.
Vec3 gradient_at(const TissueModel& m, int element, int corner) {
  Vec3 g = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    if (corner != 0 && corner != i + 1) continue;
    const double sign = corner == 0 ? -1.0 : 1.0;
    for (int c = 0; c < 3; ++c) g[c] += sign * m.exact.gradient[place_of<double>(element, 3 * i + c, 9)];
  }
  return g;
}

// A node that shares elements with another, and what it does to the volume of that other one.
struct Neighbour {
  int node = 0;
  Vec3 dilation = Vec3::Zero();  // m^2, V_a b_a,j of system_matrix.h
};

// A row that is being put together: its blocks by their columns.
class Row {
 public:
  explicit Row(int nodes) : place_(nodes, -1) {}
  numeric::LowerBlocks::Entry& at(int column) {
    if (place_[column] < 0) {
      place_[column] = static_cast<int>(entries_.size());
      entries_.push_back({.column = column});
    }
    return entries_[place_[column]];
  }
  std::vector<numeric::LowerBlocks::Entry> take() {
    for (const auto& e : entries_) place_[e.column] = -1;
    std::sort(entries_.begin(), entries_.end(),
              [](const auto& a, const auto& b) { return a.column < b.column; });
    return std::exchange(entries_, {});
  }

 private:
  std::vector<int> place_;  // [nodes] in `entries_`, -1 for none
  std::vector<numeric::LowerBlocks::Entry> entries_;
};

}  // namespace

numeric::LowerBlocks rest_matrix(const TissueModel& m, double mass_factor, double stiffness_factor) {
  struct Corner {
    int element, corner;
  };
  std::vector<std::vector<Corner>> around(m.nodes);  // the elements that meet at a node
  for (int e : m.element)
    for (int i = 0; i < 4; ++i) around[m.corners[e][i]].push_back({e, i});

  std::vector<std::vector<Neighbour>> neighbours(m.kind == ElementKind::nodal_pressure ? m.nodes : 0);
  for (std::size_t a = 0; a < neighbours.size(); ++a)
    for (const Corner& at : around[a])
      for (int j = 0; j < 4; ++j) {
        const int node = m.corners[at.element][j];
        auto known = std::find_if(neighbours[a].begin(), neighbours[a].end(),
                                  [&](const Neighbour& n) { return n.node == node; });
        if (known == neighbours[a].end()) known = neighbours[a].insert(known, {.node = node});
        known->dilation += m.exact.quarter_volume[at.element] * gradient_at(m, at.element, j);
      }

  numeric::LowerBlocks a;
  Row row(m.nodes);
  for (int i = 0; i < m.free_nodes; ++i) {
    row.at(i).block += mass_factor * m.node_mass[i] * Mat3::Identity();
    for (const Corner& at : around[i]) {
      const Vec3 gi = gradient_at(m, at.element, at.corner);
      const double mu = m.step_shear[at.element], lambda = m.step_lambda[at.element];
      for (int k = 0; k < 4; ++k) {
        const int j = m.corners[at.element][k];
        if (j > i) continue;
        const Vec3 gj = gradient_at(m, at.element, k);
        row.at(j).block +=
            stiffness_factor * m.volume[at.element] *
            (lambda * gi * gj.transpose() + mu * gj * gi.transpose() + mu * gi.dot(gj) * Mat3::Identity());
      }
    }
    if (m.kind == ElementKind::nodal_pressure)
      for (const Neighbour& pressed : neighbours[i]) {
        const int node = pressed.node;  // whose volume both i and j change
        const double weight = stiffness_factor * m.node_bulk_modulus[node] / m.node_volume[node];
        const auto& all = neighbours[node];
        const Vec3 by_i =
            std::find_if(all.begin(), all.end(), [&](const Neighbour& n) { return n.node == i; })->dilation;
        for (const Neighbour& j : all)
          if (j.node <= i) row.at(j.node).block += weight * by_i * j.dilation.transpose();
      }
    a.rows.push_back(row.take());
  }
  return a;
}

}  // namespace acus::tissue
