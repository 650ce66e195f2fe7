// Stresses of the elements, and what they ask of the nodes.
#pragma once

#include <vector>

#include "acus/numeric/node_vector.h"
#include "acus/numeric/pieces.h"
#include "acus/tissue/tissue_model.h"

namespace acus::tissue {

// Of an element: -V sigma, xx yy zz xy xz yz, then its share V tr(e) / 4 of the mean dilations of its nodes;
// where a branch relaxes also the axial vector of the skew part (corotation.cpp).
inline constexpr int stress_numbers = 7, stress_numbers_with_skew = 10;
inline int numbers_of_stress(const TissueModel& m) {
  return m.relaxation.relaxes() ? stress_numbers_with_skew : stress_numbers;
}

// Exactly, or in single precision: rounded to 1e-7 of the stresses.
enum class ForcePrecision { exact, single };

template <class Real>
struct StressesOf {
  std::vector<Real> numbers;             // [groups][numbers_of_stress][as many as fill 64 bytes]
  numeric::NodeVectorOf<Real> pressure;  // [nodes], the fourth number; empty for linear
  numeric::NodeVectorOf<Real> parts;     // [streams][nodes] what they ask of the nodes, zero in between
};
template <class Real>
StressesOf<Real> build_stresses(const TissueModel& model);

// Adds the forces of a range of elements, with their shares of the dilations as fourth numbers. `gradient`
// are the q_i, in groups like the stresses.
void add_forces(double* to, const TissueModel& model, numeric::Range elements,
                const StressesOf<double>& stresses, const std::vector<double>& gradient);
void add_forces(float* to, const TissueModel& model, numeric::Range elements,
                const StressesOf<float>& stresses, const std::vector<float>& gradient);

}  // namespace acus::tissue
