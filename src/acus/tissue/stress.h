// What a picture of the tissue shows.
#pragma once

#include <span>

#include "acus/tissue/tissue_model.h"

namespace acus::tissue {

// Von Mises equivalent of the corotated stress, Pa: sqrt(3/2 s:s) with s = 2 mu dev e. `out` has one number
// per tetrahedron.
void von_mises_into(std::span<double> out, const TissueModel& model, std::span<const Vec3> positions);

}  // namespace acus::tissue
