// The elastica after buckling by shooting on the exact equation EI theta'' + P sin theta = 0, two independent
// programs that agree to 1e-4. What our column is held against in reports.
#pragma once

#include <array>

#include "acus/needle/needle_spec.h"

namespace acus::study {

struct ElasticaRow {
  double shortening_ratio;  // end shortening / length
  double load_ratio;        // load / critical load
  double bow_ratio;         // largest deflection / length
};

inline constexpr std::array<ElasticaRow, 6> pinned_pinned_elastica = {{{0.001, 1.0005, 0.0201},
                                                                       {0.01, 1.0050, 0.0635},
                                                                       {0.05, 1.0257, 0.1401},
                                                                       {0.10, 1.0530, 0.1949},
                                                                       {0.20, 1.1127, 0.2663},
                                                                       {0.30, 1.1807, 0.3143}}};
inline constexpr std::array<ElasticaRow, 6> clamped_pinned_elastica = {{{0.001, 1.0004, 0.0197},
                                                                        {0.01, 1.0038, 0.0620},
                                                                        {0.05, 1.0189, 0.1366},
                                                                        {0.10, 1.0380, 0.1895},
                                                                        {0.20, 1.0758, 0.2569},
                                                                        {0.30, 1.1103, 0.2997}}};

// By symmetry the pinned-pinned table serves two more supports: a clamped-clamped column is two half waves of
// half its length and bows as much; a clamped-free one is half of a wave of twice its length, so its tip
// moves twice as far.
inline std::array<ElasticaRow, 6> elastica_table(needle::Support support) {
  if (support == needle::Support::clamped_pinned) return clamped_pinned_elastica;
  std::array<ElasticaRow, 6> rows = pinned_pinned_elastica;
  if (support == needle::Support::clamped_free) {
    for (ElasticaRow& row : rows) row.bow_ratio *= 2.0;
  }
  return rows;
}

}  // namespace acus::study
