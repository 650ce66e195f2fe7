#include "acus/mesh/order.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <span>

namespace acus::mesh {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Neighbours of each node, in rows: those of node n are node[begin[n]] to node[begin[n + 1]].
struct Neighbours {
  std::vector<int> begin, node;
  std::span<const int> of(int n) const {
    return std::span(node).subspan(at(begin[at(n)]), at(begin[at(n) + 1] - begin[at(n)]));
  }
};

Neighbours neighbours(const TetMesh& mesh) {
  std::vector<std::pair<int, int>> pairs;
  for (const Tet& t : mesh.tets) {
    for (const auto& [i, j] : tet_edges) {
      pairs.emplace_back(t[i], t[j]);
      pairs.emplace_back(t[j], t[i]);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  Neighbours rows;
  rows.begin.assign(mesh.nodes.size() + 1, 0);
  for (const auto& [from, to] : pairs) {
    ++rows.begin[at(from) + 1];
    rows.node.push_back(to);
  }
  std::partial_sum(rows.begin.begin(), rows.begin.end(), rows.begin.begin());
  return rows;
}

// Breadth first from `start`, each node's neighbours by their number of neighbours; appends to `order` and
// marks.
void walk(const Neighbours& graph, int start, std::vector<int>& order, std::vector<char>& seen) {
  const auto degree = [&](int n) { return graph.of(n).size(); };
  std::size_t next = order.size();
  order.push_back(start);
  seen[at(start)] = 1;
  while (next < order.size()) {
    const auto first_new = static_cast<std::ptrdiff_t>(order.size());
    for (int neighbour : graph.of(order[next])) {
      if (seen[at(neighbour)]) continue;
      seen[at(neighbour)] = 1;
      order.push_back(neighbour);
    }
    std::stable_sort(order.begin() + first_new, order.end(),
                     [&](int p, int q) { return degree(p) < degree(q); });
    ++next;
  }
}

// A node at an end of the mesh: the last one met from the last one met. Long and thin levels make a narrow
// band.
int far_node(const Neighbours& graph, int start) {
  constexpr int rounds = 3;
  for (int i = 0; i < rounds; ++i) {
    std::vector<int> order;
    std::vector<char> seen(graph.begin.size() - 1, 0);
    walk(graph, start, order, seen);
    start = order.back();
  }
  return start;
}

std::vector<int> reverse_cuthill_mckee(const TetMesh& mesh) {
  const Neighbours graph = neighbours(mesh);
  std::vector<int> order;
  std::vector<char> seen(mesh.nodes.size(), 0);
  for (int n = 0; n < static_cast<int>(mesh.nodes.size()); ++n) {
    if (!seen[at(n)]) walk(graph, far_node(graph, n), order, seen);
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace

TetMesh ordered_for_locality(const TetMesh& mesh) {
  const std::vector<int> order = reverse_cuthill_mckee(mesh);
  TetMesh ordered;
  std::vector<int> new_number(order.size());
  for (int old : order) {
    new_number[at(old)] = static_cast<int>(ordered.nodes.size());
    ordered.nodes.push_back(mesh.nodes[at(old)]);
  }
  struct Row {
    Tet lowest_first, tet;
    int region;
  };
  std::vector<Row> rows;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    Tet tet;
    std::transform(mesh.tets[t].begin(), mesh.tets[t].end(), tet.begin(),
                   [&](int n) { return new_number[at(n)]; });
    Tet sorted = tet;
    std::sort(sorted.begin(), sorted.end());
    rows.push_back({sorted, tet, mesh.region[t]});
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& p, const Row& q) { return p.lowest_first < q.lowest_first; });
  for (const Row& row : rows) {
    ordered.tets.push_back(row.tet);
    ordered.region.push_back(row.region);
  }
  return ordered;
}

NodeSpread node_spread(const TetMesh& mesh) {
  NodeSpread spread;
  double sum = 0.0;
  for (const Tet& t : mesh.tets) {
    for (const auto& [i, j] : tet_edges) {
      const int difference = std::abs(t[i] - t[j]);
      spread.largest = std::max(spread.largest, difference);
      sum += difference;
    }
  }
  spread.mean = sum / static_cast<double>(std::max<std::size_t>(1, tet_edges.size() * mesh.tets.size()));
  return spread;
}

}  // namespace acus::mesh
