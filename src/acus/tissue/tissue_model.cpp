#include "acus/tissue/tissue_model.h"

#include <cmath>
#include <string>

#include "acus/numeric/node_vector.h"
#include "acus/tissue/shape.h"

namespace acus::tissue {
namespace {

Error element_error(int tet, const std::string& what) {
  return Error{"tetrahedron " + std::to_string(tet) + ": " + what};
}

template <class Real>
void resize(ElementsAtRest<Real>& all, std::size_t elements) {
  all.gradient.assign(9 * elements, Real{});
  all.moduli.assign(element_moduli * elements, Real{});
  all.quarter_volume.assign(elements, Real{});
}

template <class Real>
void put_at_rest(ElementsAtRest<Real>& all, const TissueModel& m, int e, const Shape& shape) {
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c)
      all.gradient[place_of<Real>(e, 3 * i + c, 9)] = static_cast<Real>(shape.gradient[i + 1][c]);
  all.moduli[place_of<Real>(e, 0, element_moduli)] = static_cast<Real>(m.volume[e] * m.shear[e]);
  all.moduli[place_of<Real>(e, 1, element_moduli)] = static_cast<Real>(m.volume[e] * m.local_lambda[e]);
  all.quarter_volume[e] =
      m.kind == ElementKind::nodal_pressure ? static_cast<Real>(0.25 * m.volume[e]) : Real{};
}

void place_element(TissueModel& m, int e, const Shape& shape, const Material& material, double volume) {
  m.volume[e] = volume;
  m.shear[e] = shear_modulus(material);
  // mu |dev e|^2 = mu |e|^2 - (mu / 3) (tr e)^2: with the bulk part at the nodes only this remains here.
  m.local_lambda[e] =
      m.kind == ElementKind::linear ? lame_lambda(material) : -2.0 / 3.0 * shear_modulus(material);
  const double stiffening = m.relaxation.stiffening() * m.shear[e];
  m.step_shear[e] = m.shear[e] + stiffening;
  m.step_lambda[e] = m.local_lambda[e] - 2.0 / 3.0 * stiffening;
  put_at_rest(m.exact, m, e, shape);
  put_at_rest(m.single, m, e, shape);
}

}  // namespace

Result<TissueModel> build_tissue_model(const mesh::TetMesh& mesh, std::span<const Material> materials,
                                       ElementKind kind, int free_nodes, const RelaxationStep& relaxation) {
  TissueModel m;
  m.relaxation = relaxation;
  m.kind = kind;
  m.nodes = static_cast<int>(mesh.nodes.size());
  m.rest = mesh.nodes;
  m.free_nodes = free_nodes;
  m.tets = static_cast<int>(mesh.tets.size());
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
    for (int node : t) {
      m.node_mass[node] += material.density * shape.volume / 4.0;
      m.node_volume[node] += shape.volume / 4.0;
      bulk[node] += bulk_modulus(material) * shape.volume / 4.0;
    }
  }

  Pairing pairing = pair_up(mesh.tets);
  m.element = std::move(pairing.element);
  m.corners = std::move(pairing.corners);
  const std::size_t elements = m.corners.size();
  m.volume.assign(elements, 0.0);
  m.shear = m.local_lambda = m.step_shear = m.step_lambda = m.volume;
  resize(m.exact, elements);
  resize(m.single, elements);
  for (int e = 0; e < static_cast<int>(elements); ++e) {
    const mesh::Tet& t = m.corners[e];
    const int tet = pairing.tet[e];
    const Shape shape = shape_of(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]], mesh.nodes[t[3]]);
    place_element(m, e, shape, materials[tet], m.element[tet] == e ? shape.volume : 0.0);
  }
  m.streams = build_streams(m.corners, mesh.nodes.size());
  for (std::size_t pair = 0; pair < elements / 2; ++pair) {
    const mesh::Tet &one = m.corners[element_of_pair(pair, 0)], &other = m.corners[element_of_pair(pair, 1)];
    Offsets& of = m.offsets.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) of[i] = static_cast<std::uint32_t>(numeric::node_stride * one[i]);
    of[4] = static_cast<std::uint32_t>(numeric::node_stride * other[3]);
  }

  if (kind == ElementKind::nodal_pressure) {
    m.node_bulk_modulus.resize(mesh.nodes.size());
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) m.node_bulk_modulus[a] = bulk[a] / m.node_volume[a];
  }
  return m;
}

MaxwellBranch build_branch(const TissueModel& m) {
  MaxwellBranch branch;
  if (!m.relaxation.relaxes()) return branch;
  branch.spring.assign(strain_numbers * m.corners.size(), 0.0);
  branch.strain = branch.spring;
  return branch;
}

}  // namespace acus::tissue
