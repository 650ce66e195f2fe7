// Drawings of the tissue cut through the needle: the paper's Fig. 6 and Fig. 8.
#pragma once

#include <string>
#include <vector>

#include "acus/study/snapshot.h"
#include "acus/study/svg.h"

namespace acus::study {

// One column a snapshot, side by side: the whole needle above, the entry close up below, the tissue shaded by
// displacement, the needle to true thickness, the hand's force as an arrow, a scale bar.
Svg stage_drawing(const std::vector<Snapshot>& shots, const std::string& title,
                  const std::string& description);

// The undeformed mesh in section, refined along the path.
Svg mesh_drawing(const Snapshot& rest, int tetrahedra, const std::string& title);

}  // namespace acus::study
