// The rotation in a deformation gradient.
#pragma once

#include "acus/base/vec.h"

namespace acus::numeric {

// The proper rotation R (det R = +1) nearest to F, i.e. the maximiser of tr(R^T F). For det F > 0 it is the
// orthogonal factor of the polar decomposition; for inverted F the axis of least stretch is the one
// reflected; for flat, line-like or zero F, where it is not unique, one maximiser is returned. Finite F in,
// finite R out.
Mat3 rotation_of(const Mat3& F);

}  // namespace acus::numeric
