// The system matrix at rest, stored: what a preconditioner is made of.
#pragma once

#include "acus/numeric/lower_blocks.h"
#include "acus/tissue/tissue_model.h"

namespace acus::tissue {

// A = mass_factor M + stiffness_factor K over the free nodes (system_matrix.h). Nodal pressure joins the
// neighbours of neighbours.
numeric::LowerBlocks rest_matrix(const TissueModel& model, double mass_factor, double stiffness_factor);

}  // namespace acus::tissue
