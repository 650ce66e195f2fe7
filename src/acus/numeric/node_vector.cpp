#include "acus/numeric/node_vector.h"

#include <algorithm>
#include <cassert>

#include "acus/numeric/pieces.h"
#include "acus/numeric/simd.h"

namespace acus::numeric {
namespace {

// As many numbers as fill a vector of doubles, as doubles.
template <class Lane>
ACUS_INLINE Lane load_wide(const double* p) {
  return load_lanes<Lane>(p);
}
template <class Lane>
ACUS_INLINE Lane load_wide(const float* p) {
  return __builtin_convertvector(load_lanes<LaneOf<float, sizeof(Lane) / 2>>(p), Lane);
}

// Eight at a time, and four such sums side by side, so that an addition need not wait for the one before; the
// last few numbers come one by one.
template <class Lane, class Real>
ACUS_INLINE double sum_of_products(std::span<const Real> a, std::span<const Real> b) {
  assert(a.size() == b.size());
  const Real* pa = a.data();
  const Real* pb = b.data();
  constexpr std::size_t width = 8, unrolled = 4, lane = sizeof(Lane) / sizeof(double), parts = width / lane;
  Lane sums[unrolled][parts] = {};
  std::size_t i = 0;
  for (; i + width * unrolled <= a.size(); i += width * unrolled) {
    ACUS_UNROLL
    for (std::size_t k = 0; k < unrolled; ++k) ACUS_UNROLL
    for (std::size_t p = 0; p < parts; ++p)
      sums[k][p] +=
          load_wide<Lane>(pa + i + width * k + lane * p) * load_wide<Lane>(pb + i + width * k + lane * p);
  }
  double rest = 0.0;
  for (; i < a.size(); ++i) rest += static_cast<double>(pa[i]) * static_cast<double>(pb[i]);
  Lane all[parts];
  for (std::size_t p = 0; p < parts; ++p) all[p] = (sums[0][p] + sums[1][p]) + (sums[2][p] + sums[3][p]);
  return sum(all) + rest;
}

template <class Y, class X>
ACUS_INLINE void add_scaled(std::span<Y> y, double factor, std::span<const X> x) {
  Y* py = y.data();
  const X* px = x.data();
  const Y f = static_cast<Y>(factor);
  for (std::size_t i = 0; i < y.size(); ++i) py[i] += f * static_cast<Y>(px[i]);
}

template <class Real>
ACUS_INLINE void scale_and_add(std::span<Real> y, double factor, std::span<const Real> x) {
  Real* py = y.data();
  const Real* px = x.data();
  const Real f = static_cast<Real>(factor);
  for (std::size_t i = 0; i < y.size(); ++i) py[i] = px[i] + f * py[i];
}

template <class Lane, class Real>
ACUS_INLINE double advance_both(std::span<Real> x, std::span<Real> residual, double step,
                                std::span<const Real> direction, std::span<const Real> product) {
  add_scaled(x, step, direction);
  add_scaled(residual, -step, product);
  return sum_of_products<Lane>(std::span<const Real>(residual), std::span<const Real>(residual));
}

template <class Lane, class Real>
ACUS_INLINE double approach_both(std::span<Real> x, std::span<Real> residual, double share,
                                 std::span<const Real> other, std::span<const Real> other_residual) {
  const Real f = static_cast<Real>(share);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += f * (other[i] - x[i]);
  for (std::size_t i = 0; i < x.size(); ++i) residual[i] += f * (other_residual[i] - residual[i]);
  return sum_of_products<Lane>(std::span<const Real>(residual), std::span<const Real>(residual));
}

// Compiled for each instruction set: what is handed to a team is not.
namespace piece {

template <class Real>
double dot(std::span<const Real> a, std::span<const Real> b) {
  double sum = 0.0;
  run_kernel([&](auto bytes) ACUS_INLINED { sum = sum_of_products<LaneOf<double, bytes>>(a, b); });
  return sum;
}

ACUS_KERNEL void add_scaled_into(std::span<double> y, double factor, std::span<const double> x) {
  add_scaled(y, factor, x);
}
ACUS_KERNEL void add_scaled_into(std::span<float> y, double factor, std::span<const float> x) {
  add_scaled(y, factor, x);
}
ACUS_KERNEL void add_scaled_into(std::span<double> y, double factor, std::span<const float> x) {
  add_scaled(y, factor, x);
}

ACUS_KERNEL void scale_and_add_into(std::span<double> y, double factor, std::span<const double> x) {
  scale_and_add(y, factor, x);
}
ACUS_KERNEL void scale_and_add_into(std::span<float> y, double factor, std::span<const float> x) {
  scale_and_add(y, factor, x);
}

ACUS_KERNEL void scale_into(std::span<float> y, double factor, std::span<const double> x) {
  float* py = y.data();
  const double* px = x.data();
  for (std::size_t i = 0; i < y.size(); ++i) py[i] = static_cast<float>(factor * px[i]);
}
ACUS_KERNEL void scale_into(std::span<double> y, double factor, std::span<const float> x) {
  double* py = y.data();
  const float* px = x.data();
  for (std::size_t i = 0; i < y.size(); ++i) py[i] = factor * static_cast<double>(px[i]);
}

ACUS_KERNEL void multiply_blocks_into(std::span<float> y, std::span<const float> block,
                                      std::span<const float> x) {
  float* py = y.data();
  const float* px = x.data();
  const float* pb = block.data();
  for (std::size_t i = 0; i < x.size(); i += node_stride) {
    const float* b = pb + 3 * i;
    store4(py + i,
           px[i] * load4(b) + px[i + 1] * load4(b + node_stride) + px[i + 2] * load4(b + 2 * node_stride));
  }
}

template <class Real>
double advance_into(std::span<Real> x, std::span<Real> residual, double step, std::span<const Real> direction,
                    std::span<const Real> product) {
  double sum = 0.0;
  run_kernel([&](auto bytes) ACUS_INLINED {
    sum = advance_both<LaneOf<double, bytes>>(x, residual, step, direction, product);
  });
  return sum;
}
template <class Real>
double approach_into(std::span<Real> x, std::span<Real> residual, double share, std::span<const Real> other,
                     std::span<const Real> other_residual) {
  double sum = 0.0;
  run_kernel([&](auto bytes) ACUS_INLINED {
    sum = approach_both<LaneOf<double, bytes>>(x, residual, share, other, other_residual);
  });
  return sum;
}

}  // namespace piece

template <class Real>
void copy(std::span<Real> y, std::span<const Real> x) {
  std::copy(x.begin(), x.end(), y.begin());
}

template <class Real>
std::span<Real> cut(std::span<Real> v, Range r) {
  return v.subspan(r.first, r.size());
}

}  // namespace

double dot(std::span<const double> a, std::span<const double> b, const Team& team) {
  return sum_of_pieces(a.size(), team, [&](Range r) { return piece::dot(cut(a, r), cut(b, r)); });
}
double dot(std::span<const float> a, std::span<const float> b, const Team& team) {
  return sum_of_pieces(a.size(), team, [&](Range r) { return piece::dot(cut(a, r), cut(b, r)); });
}

void copy_into(std::span<double> y, std::span<const double> x, const Team& team) {
  each_piece(y.size(), team, [&](Range r) { copy(cut(y, r), cut(x, r)); });
}
void copy_into(std::span<float> y, std::span<const float> x, const Team& team) {
  each_piece(y.size(), team, [&](Range r) { copy(cut(y, r), cut(x, r)); });
}

void add_scaled_into(std::span<double> y, double factor, std::span<const double> x, const Team& team) {
  each_piece(y.size(), team, [&](Range r) { piece::add_scaled_into(cut(y, r), factor, cut(x, r)); });
}
void add_scaled_into(std::span<float> y, double factor, std::span<const float> x, const Team& team) {
  each_piece(y.size(), team, [&](Range r) { piece::add_scaled_into(cut(y, r), factor, cut(x, r)); });
}
void add_scaled_into(std::span<double> y, double factor, std::span<const float> x, const Team& team) {
  each_piece(y.size(), team, [&](Range r) { piece::add_scaled_into(cut(y, r), factor, cut(x, r)); });
}

void scale_and_add_into(std::span<double> y, double factor, std::span<const double> x, const Team& team) {
  each_piece(y.size(), team, [&](Range r) { piece::scale_and_add_into(cut(y, r), factor, cut(x, r)); });
}
void scale_and_add_into(std::span<float> y, double factor, std::span<const float> x, const Team& team) {
  each_piece(y.size(), team, [&](Range r) { piece::scale_and_add_into(cut(y, r), factor, cut(x, r)); });
}

void scale_into(std::span<float> y, double factor, std::span<const double> x, const Team& team) {
  each_piece(y.size(), team, [&](Range r) { piece::scale_into(cut(y, r), factor, cut(x, r)); });
}
void scale_into(std::span<double> y, double factor, std::span<const float> x, const Team& team) {
  each_piece(y.size(), team, [&](Range r) { piece::scale_into(cut(y, r), factor, cut(x, r)); });
}

void multiply_blocks_into(std::span<float> y, std::span<const float> block, std::span<const float> x,
                          const Team& team) {
  each_piece(x.size(), team, [&](Range r) {
    piece::multiply_blocks_into(cut(y, r), cut(block, {3 * r.first, 3 * r.last}), cut(x, r));
  });
}

double advance_into(std::span<double> x, std::span<double> residual, double step,
                    std::span<const double> direction, std::span<const double> product, const Team& team) {
  return sum_of_pieces(x.size(), team, [&](Range r) {
    return piece::advance_into(cut(x, r), cut(residual, r), step, cut(direction, r), cut(product, r));
  });
}
double advance_into(std::span<float> x, std::span<float> residual, double step,
                    std::span<const float> direction, std::span<const float> product, const Team& team) {
  return sum_of_pieces(x.size(), team, [&](Range r) {
    return piece::advance_into(cut(x, r), cut(residual, r), step, cut(direction, r), cut(product, r));
  });
}

double approach_into(std::span<double> x, std::span<double> residual, double share,
                     std::span<const double> other, std::span<const double> other_residual,
                     const Team& team) {
  return sum_of_pieces(x.size(), team, [&](Range r) {
    return piece::approach_into(cut(x, r), cut(residual, r), share, cut(other, r), cut(other_residual, r));
  });
}
double approach_into(std::span<float> x, std::span<float> residual, double share,
                     std::span<const float> other, std::span<const float> other_residual, const Team& team) {
  return sum_of_pieces(x.size(), team, [&](Range r) {
    return piece::approach_into(cut(x, r), cut(residual, r), share, cut(other, r), cut(other_residual, r));
  });
}

}  // namespace acus::numeric
