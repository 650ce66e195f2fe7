#include "acus/mesh/refine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

namespace acus::mesh {
namespace {

// Of the mesh's diagonal; far above rounding, far below any tissue detail.
constexpr double shortest_edge_fraction = 1e-6;
// Of the tetrahedra allowed: with so many the mesh counts as full.
constexpr double full_fraction = 0.98;

struct Edge {
  double length_squared = 0.0;
  int a = -1, b = -1;  // a < b
  friend bool operator==(const Edge& p, const Edge& q) { return p.a == q.a && p.b == q.b; }
  friend bool operator<(const Edge& p, const Edge& q) {
    return std::tie(p.length_squared, p.a, p.b) < std::tie(q.length_squared, q.a, q.b);
  }
};

struct Wish {
  double need = 0.0;  // longest edge over the wanted one
  int tet = -1;
  friend bool operator<(const Wish& p, const Wish& q) {
    return std::tie(p.need, q.tet) < std::tie(q.need, p.tet);
  }
};

std::size_t at(int i) { return static_cast<std::size_t>(i); }

class Bisection {
 public:
  Bisection(TetMesh mesh, const SizeField& size);
  void run(int most_tets);
  TetMesh take() { return std::move(mesh_); }

 private:
  Edge longest_edge(const Tet& tet) const;
  double need(const Tet& tet) const;
  std::vector<int> equally_needy();
  void wish(int tet);
  void collect_star(const Edge& edge);
  void split(const Edge& edge);
  void halve(const Edge& edge);
  void undo();

  TetMesh mesh_;
  const SizeField& size_;
  double shortest_ = 0.0;
  std::vector<std::vector<int>> tets_at_;  // of each node
  std::priority_queue<Wish> wishes_;
  std::vector<int> star_;
  std::vector<Edge> path_;
  // Since the last group of equals began: what each divided tetrahedron was, and how many nodes there were.
  std::vector<std::pair<int, Tet>> changed_;
  std::size_t nodes_before_ = 0;
};

Bisection::Bisection(TetMesh mesh, const SizeField& size) : mesh_(std::move(mesh)), size_(size) {
  shortest_ = shortest_edge_fraction * bounds(mesh_).diagonal().norm();
  tets_at_.resize(mesh_.nodes.size());
  for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
    for (int node : mesh_.tets[t]) tets_at_[at(node)].push_back(static_cast<int>(t));
  }
  for (std::size_t t = 0; t < mesh_.tets.size(); ++t) wish(static_cast<int>(t));
}

Edge Bisection::longest_edge(const Tet& tet) const {
  Edge longest;
  for (const auto& [i, j] : tet_edges) {
    const auto [a, b] = std::minmax(tet[i], tet[j]);
    longest = std::max(longest, Edge{(mesh_.nodes[at(a)] - mesh_.nodes[at(b)]).squaredNorm(), a, b});
  }
  return longest;
}

double Bisection::need(const Tet& tet) const {
  const double length = std::sqrt(longest_edge(tet).length_squared);
  if (length < 2.0 * shortest_) return 0.0;
  double wanted = std::numeric_limits<double>::infinity();
  for (int node : tet) wanted = std::min(wanted, size_(mesh_.nodes[at(node)]));
  return length / wanted;
}

void Bisection::wish(int tet) {
  const double n = need(mesh_.tets[at(tet)]);
  if (n > 1.0) wishes_.push({n, tet});
}

// The tetrahedra of the greatest need, all of them: mirror images are divided together or not at all.
std::vector<int> Bisection::equally_needy() {
  std::vector<int> group;
  const double greatest = wishes_.top().need;
  for (; !wishes_.empty() && wishes_.top().need == greatest; wishes_.pop())
    group.push_back(wishes_.top().tet);
  // A wish is void when its tetrahedron was divided since (it has wished again) or taken back.
  std::erase_if(group, [&](int t) { return at(t) >= mesh_.tets.size(); });
  return group;
}

void Bisection::run(int most_tets) {
  const double enough = full_fraction * most_tets;
  while (!wishes_.empty() && static_cast<double>(mesh_.tets.size()) < enough) {
    changed_.clear();
    nodes_before_ = mesh_.nodes.size();
    const double greatest = wishes_.top().need;
    for (int tet : equally_needy()) {
      // One that is divided already was on the path of an equal.
      const Tet before = mesh_.tets[at(tet)];
      if (need(before) == greatest) split(longest_edge(before));
    }
    // A group that does not fit is left as it is; the next ones may be smaller.
    if (mesh_.tets.size() > at(most_tets)) undo();
  }
}

void Bisection::collect_star(const Edge& edge) {
  star_.clear();
  for (int t : tets_at_[at(edge.a)]) {
    const Tet& tet = mesh_.tets[at(t)];
    if (std::find(tet.begin(), tet.end(), edge.b) != tet.end()) star_.push_back(t);
  }
}

void Bisection::split(const Edge& edge) {
  path_.assign(1, edge);
  while (!path_.empty()) {
    const Edge current = path_.back();
    collect_star(current);
    Edge longer = current;
    for (int t : star_) longer = std::max(longer, longest_edge(mesh_.tets[at(t)]));
    if (longer == current) {
      halve(current);
      path_.pop_back();
    } else {
      path_.push_back(longer);
    }
  }
}

// Expects the star of `edge` in star_.
void Bisection::halve(const Edge& edge) {
  const int middle = static_cast<int>(mesh_.nodes.size());
  mesh_.nodes.push_back(0.5 * (mesh_.nodes[at(edge.a)] + mesh_.nodes[at(edge.b)]));
  tets_at_.emplace_back();
  std::vector<int>& at_b = tets_at_[at(edge.b)];
  std::erase_if(at_b, [&](int t) { return std::find(star_.begin(), star_.end(), t) != star_.end(); });
  for (int t : star_) {
    const int twin = static_cast<int>(mesh_.tets.size());
    const Tet before = mesh_.tets[at(t)];
    Tet with_b = before;
    std::replace(with_b.begin(), with_b.end(), edge.a, middle);
    std::replace(mesh_.tets[at(t)].begin(), mesh_.tets[at(t)].end(), edge.b, middle);
    mesh_.tets.push_back(with_b);
    mesh_.region.push_back(mesh_.region[at(t)]);
    for (int node : with_b) tets_at_[at(node)].push_back(twin);
    tets_at_[at(middle)].push_back(t);
    changed_.emplace_back(t, before);
    wish(t);
    wish(twin);
  }
}

// Takes back the halvings since the last group of equals began, last first.
void Bisection::undo() {
  for (; !changed_.empty(); changed_.pop_back()) {
    const auto& [t, before] = changed_.back();
    const Tet& twin = mesh_.tets.back();
    for (int node : twin) std::erase(tets_at_[at(node)], static_cast<int>(mesh_.tets.size()) - 1);
    for (int node : mesh_.tets[at(t)]) std::erase(tets_at_[at(node)], t);
    for (int node : before) tets_at_[at(node)].push_back(t);
    mesh_.tets[at(t)] = before;
    mesh_.tets.pop_back();
    mesh_.region.pop_back();
  }
  mesh_.nodes.resize(nodes_before_);
  tets_at_.resize(nodes_before_);
}

}  // namespace

TetMesh refined(TetMesh mesh, const SizeField& size, int most_tets) {
  Bisection bisection(std::move(mesh), size);
  bisection.run(most_tets);
  return bisection.take();
}

double distance_to_segment(const Vec3& point, const Vec3& from, const Vec3& to) {
  const Vec3 along = to - from;
  const double squared = along.squaredNorm();
  const double s = squared > 0.0 ? std::clamp((point - from).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (point - from - s * along).norm();
}

TetMesh refined_along_path(TetMesh mesh, const Vec3& from, const Vec3& to, double near, double grading,
                           int most_tets) {
  return refined(
      std::move(mesh), [&](const Vec3& x) { return near + grading * distance_to_segment(x, from, to); },
      most_tets);
}

}  // namespace acus::mesh
