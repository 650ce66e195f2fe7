// Where in a mesh a point lies, and which node is nearest.
#pragma once

#include <optional>
#include <span>

#include "acus/mesh/tet_mesh.h"

namespace acus::mesh {

// A point as the weighted mean of the corners of one tetrahedron. Weights are at least 0 and sum to 1.
struct Embedding {
  int tet = -1;
  std::array<int, 4> nodes{};
  std::array<double, 4> weights{};
};

// sum of weights[i] * values[nodes[i]]: a field given at the nodes, at the embedded point.
Vec3 interpolate(const Embedding& at, std::span<const Vec3> values);

// A tree of boxes over the tetrahedra of one mesh, of which it keeps a copy. Queries do not allocate; the
// tree is balanced, so they take of the order of the logarithm of the mesh.
class Locator {
 public:
  // Expects at least one tetrahedron, all of positive volume.
  explicit Locator(const TetMesh& mesh);

  // The tetrahedron that holds `point`; the lowest index among equals, as on a shared face. A point outside
  // the mesh, but no farther than `snap` [m], is moved to the nearest point of the surface; farther ones (and
  // points that are not finite) have none.
  std::optional<Embedding> locate(const Vec3& point, double snap) const;
  // As above with a snap of 1e-6 of the mesh's diagonal: forgives rounding and nothing else.
  std::optional<Embedding> locate(const Vec3& point) const { return locate(point, rounding_); }
  // As the first, but tries tetrahedron `first` before all others: a point that moves little stays where it
  // is.
  std::optional<Embedding> locate(const Vec3& point, double snap, int first) const;
  // Index of the node of a tetrahedron nearest to `point`; the lowest index among equals. `point` finite.
  int nearest_node(const Vec3& point) const;

 private:
  struct Box {
    Eigen::AlignedBox3d bounds;
    int begin = 0, end = 0;  // of order_, for a leaf
    int left = -1;           // child boxes left and left + 1, or -1 for a leaf
  };
  void build(int box, int begin, int end, std::vector<Vec3>& centres);
  // Visits the tetrahedra in boxes nearer than `reach` squared, nearer boxes first; `visit` may shorten the
  // reach.
  template <class Visit>
  void search(const Vec3& point, double reach_squared, Visit visit) const;

  std::vector<Vec3> nodes_;
  std::vector<Tet> tets_;
  std::vector<int> order_;
  std::vector<Box> boxes_;
  double rounding_ = 0.0;  // m
};

}  // namespace acus::mesh
