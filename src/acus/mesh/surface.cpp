#include "acus/mesh/surface.h"

#include <algorithm>
#include <tuple>

namespace acus::mesh {
namespace {

struct Face {
  Triangle key;  // its nodes, ascending
  int number;    // four times the tetrahedron, plus the corner opposite
  friend bool operator<(const Face& p, const Face& q) {
    return std::tie(p.key, p.number) < std::tie(q.key, q.number);
  }
};

Triangle corners(const TetMesh& mesh, int number) {
  const auto [a, b, c] = tet_faces[static_cast<std::size_t>(number % 4)];
  const Tet& tet = mesh.tets[static_cast<std::size_t>(number / 4)];
  return {tet[a], tet[b], tet[c]};
}

}  // namespace

std::vector<Triangle> boundary_triangles(const TetMesh& mesh) {
  std::vector<Face> faces;
  for (int number = 0; number < 4 * static_cast<int>(mesh.tets.size()); ++number) {
    Triangle key = corners(mesh, number);
    std::sort(key.begin(), key.end());
    faces.push_back({key, number});
  }
  std::sort(faces.begin(), faces.end());
  std::vector<int> single;
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t end = i + 1;
    while (end < faces.size() && faces[end].key == faces[i].key) ++end;
    if (end == i + 1) single.push_back(faces[i].number);
    i = end;
  }
  std::sort(single.begin(), single.end());
  std::vector<Triangle> triangles;
  for (int number : single) triangles.push_back(corners(mesh, number));
  return triangles;
}

bool is_watertight(std::span<const Triangle> triangles) {
  struct Passage {
    int low, high, sense;
  };
  std::vector<Passage> passages;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int from = t[i], to = t[(i + 1) % 3];
      passages.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
    }
  }
  const auto edge = [](const Passage& p) { return std::make_pair(p.low, p.high); };
  std::sort(passages.begin(), passages.end(),
            [&](const auto& p, const auto& q) { return edge(p) < edge(q); });
  int balance = 0;
  for (std::size_t i = 0; i < passages.size(); ++i) {
    balance += passages[i].sense;
    const bool last = i + 1 == passages.size() || edge(passages[i + 1]) != edge(passages[i]);
    if (last && balance != 0) return false;
  }
  return true;
}

}  // namespace acus::mesh
