// What a picture of the tissue shows.
#pragma once

#include <span>
#include <vector>

#include "acus/tissue/tissue_model.h"

namespace acus::tissue {

// Von Mises equivalent of the corotated stress, Pa, one per tetrahedron: sqrt(3/2 s:s) with s = 2 mu dev e.
std::vector<double> von_mises(const TissueModel& model, std::span<const Vec3> positions);

}  // namespace acus::tissue
