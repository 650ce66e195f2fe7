#include "acus/numeric/node_vector.h"

#include <cassert>

#include "acus/numeric/simd.h"

namespace acus::numeric {

ACUS_KERNEL double dot(std::span<const double> a, std::span<const double> b) {
  assert(a.size() == b.size());
  const double* pa = a.data();
  const double* pb = b.data();
  const std::size_t n = a.size() / 4;
  Lane4 s0{}, s1{};
  std::size_t i = 0;
  for (; i + 1 < n; i += 2) {
    s0 += load4(pa + 4 * i) * load4(pb + 4 * i);
    s1 += load4(pa + 4 * i + 4) * load4(pb + 4 * i + 4);
  }
  if (i < n) s0 += load4(pa + 4 * i) * load4(pb + 4 * i);
  return sum(s0 + s1);
}

ACUS_KERNEL void add_scaled_into(NodeVector& y, double factor, const NodeVector& x) {
  double* py = y.data();
  const double* px = x.data();
  for (std::size_t i = 0; i < y.size(); i += 4) store4(py + i, load4(py + i) + factor * load4(px + i));
}

ACUS_KERNEL void scale_and_add_into(NodeVector& y, double factor, const NodeVector& x) {
  double* py = y.data();
  const double* px = x.data();
  for (std::size_t i = 0; i < y.size(); i += 4) store4(py + i, load4(px + i) + factor * load4(py + i));
}

}  // namespace acus::numeric
