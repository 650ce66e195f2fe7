#include "acus/tissue/tissue_model.h"

#include <cmath>
#include <string>

#include "acus/tissue/shape.h"

namespace acus::tissue {
namespace {

Error element_error(int tet, const std::string& what) {
  return Error{"tetrahedron " + std::to_string(tet) + ": " + what};
}

void place_element(TissueModel& m, int tet, const Shape& shape, const Material& material, double volume) {
  const int batch = tet / lanes;
  const int lane = tet % lanes;
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c)
      m.gradient[(static_cast<std::size_t>(batch) * 9 + 3 * i + c) * lanes + lane] = shape.gradient[i + 1][c];
  const std::size_t at = static_cast<std::size_t>(batch) * lanes + lane;
  m.volume[at] = volume;
  m.shear[at] = shear_modulus(material);
  // mu |dev e|^2 = mu |e|^2 - (mu / 3) (tr e)^2: with the bulk part at the nodes only this remains here.
  m.local_lambda[at] =
      m.kind == ElementKind::linear ? lame_lambda(material) : -2.0 / 3.0 * shear_modulus(material);
}

}  // namespace

Result<TissueModel> build_tissue_model(const mesh::TetMesh& mesh, std::span<const Material> materials,
                                       ElementKind kind, int free_nodes) {
  TissueModel m;
  m.kind = kind;
  m.nodes = static_cast<int>(mesh.nodes.size());
  m.free_nodes = free_nodes;
  m.tets = static_cast<int>(mesh.tets.size());
  m.batches = (m.tets + lanes - 1) / lanes;
  m.corners = mesh.tets;
  const std::size_t padded = static_cast<std::size_t>(m.batches) * lanes;
  m.gradient.assign(9 * padded, 0.0);
  m.volume.assign(padded, 0.0);
  m.shear.assign(padded, 0.0);
  m.local_lambda.assign(padded, 0.0);
  m.node_mass.assign(mesh.nodes.size(), 0.0);
  m.node_volume.assign(mesh.nodes.size(), 0.0);
  std::vector<double> bulk(mesh.nodes.size(), 0.0);

  if (m.tets == 0) return Error{"the tissue has no tetrahedra"};
  for (int e = 0; e < m.tets; ++e) {
    const mesh::Tet& t = mesh.tets[e];
    const Material& material = materials[e];
    const Shape shape = shape_of(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]], mesh.nodes[t[3]]);
    if (!(shape.volume > 0.0) || !shape.gradient[0].allFinite())
      return element_error(e, "its volume is " + std::to_string(shape.volume) + " m^3, it must be positive");
    if (!(material.youngs_modulus > 0.0 && material.density > 0.0 && material.poisson_ratio > -1.0 &&
          material.poisson_ratio < 0.5))
      return element_error(
          e, "its material needs a positive modulus and density and a Poisson ratio in (-1, 0.5)");
    place_element(m, e, shape, material, shape.volume);
    for (int node : t) {
      m.node_mass[node] += material.density * shape.volume / 4.0;
      m.node_volume[node] += shape.volume / 4.0;
      bulk[node] += bulk_modulus(material) * shape.volume / 4.0;
    }
  }
  // Padding lanes repeat the last element with no volume, so that kernels need no special case.
  const mesh::Tet& last = mesh.tets.back();
  const Shape shape =
      shape_of(mesh.nodes[last[0]], mesh.nodes[last[1]], mesh.nodes[last[2]], mesh.nodes[last[3]]);
  for (int e = m.tets; e < static_cast<int>(padded); ++e) place_element(m, e, shape, materials.back(), 0.0);

  if (kind == ElementKind::nodal_pressure) {
    m.node_bulk_modulus.resize(mesh.nodes.size());
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) m.node_bulk_modulus[a] = bulk[a] / m.node_volume[a];
  }

  m.pattern = numeric::build_pattern(mesh.tets, m.nodes, free_nodes);
  m.slot.resize(mesh.tets.size());
  for (int e = 0; e < m.tets; ++e)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) m.slot[e][4 * i + j] = m.pattern.find(mesh.tets[e][i], mesh.tets[e][j]);
  return m;
}

}  // namespace acus::tissue
