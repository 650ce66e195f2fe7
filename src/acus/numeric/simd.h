// Compiler vectors: the same elementwise arithmetic, hence the same bits, on every width of machine.
#pragma once

#include <cstring>
#include <type_traits>

namespace acus::numeric {

// Lane-wise + - * / only; a sum over lanes is always written out in one fixed order.
using Lane2 = double __attribute__((vector_size(16)));
using Lane4 = double __attribute__((vector_size(32)));
using Lane8 = double __attribute__((vector_size(64)));
using Lane4f = float __attribute__((vector_size(16)));
using Lane16f = float __attribute__((vector_size(64)));
using Lane16 = double __attribute__((vector_size(128)));

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

// In double, as many numbers as a vector has.
template <class Lane>
struct WideOf {
  using type = Lane;
};
template <>
struct WideOf<Lane4f> {
  using type = Lane4;
};
template <>
struct WideOf<Lane16f> {
  using type = Lane16;
};
template <class Lane>
using Wide = typename WideOf<Lane>::type;

// What a vector is made of; a number alone will do, too.
template <class Lane>
struct NumberOf {
  using type = std::remove_cvref_t<decltype(Lane{}[0])>;
};
template <>
struct NumberOf<double> {
  using type = double;
};
template <class Lane>
using RealOf = typename NumberOf<Lane>::type;

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
template <class Lane>
ACUS_INLINE Wide<Lane> widened(const Lane& v) {
  return __builtin_convertvector(v, Wide<Lane>);
}
// Of eight or sixteen numbers in however many vectors, in one order.
template <class Lane, int parts>
ACUS_INLINE double sum(const Lane (&v)[parts]) {
  constexpr int count = parts * static_cast<int>(sizeof(Lane) / sizeof(v[0][0]));
  static_assert(count == 8 || count == 16);
  double n[count];
  std::memcpy(n, v, sizeof n);
  double total = 0.0;
  for (int i = 0; i < count; i += 8)
    total += ((n[i] + n[i + 4]) + (n[i + 1] + n[i + 5])) + ((n[i + 2] + n[i + 6]) + (n[i + 3] + n[i + 7]));
  return total;
}
ACUS_INLINE double sum(Lane4 v) { return (v[0] + v[1]) + (v[2] + v[3]); }

}  // namespace acus::numeric
