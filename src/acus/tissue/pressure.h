// What nodal pressures ask of the nodes (system_matrix.h), in either precision.
#pragma once

#include "acus/numeric/pieces.h"
#include "acus/tissue/tissue_model.h"

namespace acus::tissue {

// Adds f_i += (V / 4) (sum over the corners of the pressure) q_i. `field` has the pressures as fourth
// numbers; `gradient` are the q_i, in groups as wide as 64 bytes.
void press(double* to, const TissueModel& model, numeric::Range elements, const std::vector<double>& gradient,
           const numeric::NodeVector& field);
void press(float* to, const TissueModel& model, numeric::Range elements, const std::vector<float>& gradient,
           const numeric::NodeVectorOf<float>& field);

}  // namespace acus::tissue
