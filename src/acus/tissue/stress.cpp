#include "acus/tissue/stress.h"

#include <cmath>

#include "acus/numeric/polar.h"
#include "acus/tissue/deformation.h"

namespace acus::tissue {

void von_mises_into(std::span<double> out, const TissueModel& model, std::span<const Vec3> positions) {
  for (int tet = 0; tet < model.tets; ++tet) {
    const Mat3 F = deformation_gradient(model, positions, tet);
    const Mat3 stretch = numeric::rotation_of(F).transpose() * F;
    Mat3 strain = 0.5 * (stretch + stretch.transpose()) - Mat3::Identity();
    strain -= strain.trace() / 3.0 * Mat3::Identity();
    out[tet] = 2.0 * model.shear[model.element[tet]] * std::sqrt(1.5) * strain.norm();
  }
}

}  // namespace acus::tissue
