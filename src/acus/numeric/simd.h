// Compiler vectors: the same elementwise arithmetic, hence the same bits, on every width of machine.
#pragma once

#include <cstring>

namespace acus::numeric {

// Lane-wise + - * / only; a sum over lanes is always written out in one fixed order.
using Lane2 = double __attribute__((vector_size(16)));
using Lane4 = double __attribute__((vector_size(32)));
using Lane8 = double __attribute__((vector_size(64)));
using Lane4f = float __attribute__((vector_size(16)));
using Lane16f = float __attribute__((vector_size(64)));

// For either precision: four numbers of one node, and one number of as many elements as fill 64 bytes.
template <class Real>
struct LanesOf;
template <>
struct LanesOf<double> {
  using Node = Lane4;
  using Elements = Lane8;
};
template <>
struct LanesOf<float> {
  using Node = Lane4f;
  using Elements = Lane16f;
};
template <class Real>
using NodeLane = typename LanesOf<Real>::Node;
template <class Real>
using ElementLane = typename LanesOf<Real>::Elements;
template <class Real>
inline constexpr int lane_count = sizeof(ElementLane<Real>) / sizeof(Real);

#define ACUS_INLINE inline __attribute__((always_inline))

// Before a short loop over vectors: without it they travel through memory from one round to the next. A
// browser has too few registers to gain, and the engine must be small on its way there.
#ifdef __wasm__
#define ACUS_UNROLL
#elif defined(__clang__)
#define ACUS_UNROLL _Pragma("clang loop unroll(full)")
#else
#define ACUS_UNROLL _Pragma("GCC unroll 16")
#endif

// Compiles a kernel for several instruction sets and picks one when the program starts. Fused multiply-add is
// never used (-ffp-contract=off), so all give the same bits. Sanitizers do not go together with the
// resolvers, and clang 14 will not pass vectors to an inlined function from a clone.
#if defined(__x86_64__) && defined(__linux__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define ACUS_KERNEL __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ACUS_KERNEL
#endif

template <class Real>
ACUS_INLINE NodeLane<Real> load4(const Real* p) {
  NodeLane<Real> v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
// Three numbers and a zero.
ACUS_INLINE Lane4 load3(const double* p) {
  Lane2 xy;
  std::memcpy(&xy, p, sizeof xy);
  return __builtin_shufflevector(xy, Lane2{p[2], 0.0}, 0, 1, 2, 3);
}
ACUS_INLINE void store4(double* p, Lane4 v) { std::memcpy(p, &v, sizeof v); }
ACUS_INLINE void store4(float* p, Lane4f v) { std::memcpy(p, &v, sizeof v); }
template <class Real>
ACUS_INLINE ElementLane<Real> load_lanes(const Real* p) {
  ElementLane<Real> v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
// Of eight numbers in however many vectors, in one order.
template <class Lane, int parts>
ACUS_INLINE double sum(const Lane (&v)[parts]) {
  static_assert(sizeof v == 8 * sizeof(double));
  double n[8];
  std::memcpy(n, v, sizeof n);
  return ((n[0] + n[4]) + (n[1] + n[5])) + ((n[2] + n[6]) + (n[3] + n[7]));
}
template <class Lane, int parts>
ACUS_INLINE double least(const Lane (&v)[parts]) {
  static_assert(sizeof v == 8 * sizeof(double));
  double n[8];
  std::memcpy(n, v, sizeof n);
  double smallest = n[0];
  for (int i = 1; i < 8; ++i) smallest = n[i] < smallest ? n[i] : smallest;
  return smallest;
}
ACUS_INLINE double sum(Lane4 v) { return (v[0] + v[1]) + (v[2] + v[3]); }

}  // namespace acus::numeric
