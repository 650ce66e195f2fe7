#include "acus/coupling/punch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "acus/coupling/attachment.h"

namespace acus::coupling {
namespace {

double volume(const mesh::Tet& t, std::span<const Vec3> x) {
  return std::abs((x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).dot(x[t[3]] - x[t[0]])) / 6.0;
}

double mean_edge_under(const mesh::TetMesh& mesh, const mesh::Locator& locator, const Vec3& centre,
                       const Vec3& axis, double radius, int rings) {
  double sum = 0.0;
  int inside = 0;
  visit_disc(centre, axis, radius, rings, [&](const Vec3& point) {
    const auto held = locator.locate(point, radius);
    if (!held) return;
    sum += cube_edge(mesh.tets[held->tet], mesh.nodes);
    ++inside;
  });
  return inside > 0 ? sum / inside : 0.0;
}

}  // namespace

double cube_edge(const mesh::Tet& tet, std::span<const Vec3> nodes) {
  constexpr double of_kuhn = 10.0;  // squares of its edges: 1, 1, 1, 2, 2 and 3
  double sum = 0.0;
  for (std::size_t i = 1; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) sum += (nodes[tet[i]] - nodes[tet[j]]).squaredNorm();
  return std::sqrt(sum / of_kuhn);
}

double missing_share(const mesh::TetMesh& mesh, const mesh::Locator& locator, const Vec3& centre,
                     const Vec3& axis, double radius, int rings) {
  constexpr double pi = std::numbers::pi;
  const double under = mean_edge_under(mesh, locator, centre, axis, radius, rings);
  double sum = 0.0;
  for (const mesh::Tet& tet : mesh.tets) {
    Vec3 middle = Vec3::Zero();
    for (const int node : tet) middle += 0.25 * mesh.nodes[node];
    const double rho_squared = radius * radius + (middle - centre).squaredNorm();
    const auto missing = [&](double h) { return h * h / (rho_squared + h * h); };
    sum += volume(tet, mesh.nodes) / (rho_squared * rho_squared) *
           (missing(cube_edge(tet, mesh.nodes)) - missing(under));
  }
  const double as_under_the_disc = 1.0 - 2.0 * radius / (radius + std::sqrt(radius * radius + under * under));
  return std::clamp(as_under_the_disc + 2.0 * radius / (pi * pi) * sum, 0.0, 1.0);
}

}  // namespace acus::coupling
