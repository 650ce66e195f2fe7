// The deformation gradient F = dx/dX of one tetrahedron (Eq. 5's frame is its rotation).
#pragma once

#include <span>

#include "acus/tissue/tissue_model.h"

namespace acus::tissue {

// The same of an element of the model (pairs.h), fillers included.
inline Mat3 deformation_of_element(const TissueModel& model, std::span<const Vec3> positions,
                                   std::size_t element) {
  const mesh::Tet& t = model.corners[element];
  Mat3 F = Mat3::Zero();
  for (int i = 0; i < 3; ++i) {
    Vec3 gradient;
    for (int c = 0; c < 3; ++c) gradient[c] = model.exact.gradient[place_of<double>(element, 3 * i + c, 9)];
    F += (positions[t[i + 1]] - positions[t[0]]) * gradient.transpose();
  }
  return F;
}

inline Mat3 deformation_gradient(const TissueModel& model, std::span<const Vec3> positions, int tet) {
  return deformation_of_element(model, positions, model.element[tet]);
}

}  // namespace acus::tissue
