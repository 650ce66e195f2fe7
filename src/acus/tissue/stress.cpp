#include "acus/tissue/stress.h"

#include <cmath>

#include "acus/numeric/polar.h"

namespace acus::tissue {

void von_mises_into(std::span<double> out, const TissueModel& model, std::span<const Vec3> positions) {
  for (int e = 0; e < model.tets; ++e) {
    const mesh::Tet& t = model.corners[e];
    Mat3 F = Mat3::Zero();
    for (int i = 0; i < 3; ++i) {
      Vec3 gradient;
      for (int c = 0; c < 3; ++c) gradient[c] = model.gradient[lane_place(e, 3 * i + c, 9)];
      F += (positions[t[i + 1]] - positions[t[0]]) * gradient.transpose();
    }
    const Mat3 stretch = numeric::rotation_of(F).transpose() * F;
    Mat3 strain = 0.5 * (stretch + stretch.transpose()) - Mat3::Identity();
    strain -= strain.trace() / 3.0 * Mat3::Identity();
    out[e] = 2.0 * model.shear[e] * std::sqrt(1.5) * strain.norm();
  }
}

}  // namespace acus::tissue
