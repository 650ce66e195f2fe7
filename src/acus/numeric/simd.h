// Compiler vectors: the same elementwise arithmetic, hence the same bits, on every width of machine.
#pragma once

#include <cstring>
#include <type_traits>

namespace acus::numeric {

// Lane-wise + - * / only; a sum over lanes is always written out in one fixed order.
using Lane2 = double __attribute__((vector_size(16)));
using Lane4 = double __attribute__((vector_size(32)));
using Lane8 = double __attribute__((vector_size(64)));
using Lane2f = float __attribute__((vector_size(8)));
using Lane4f = float __attribute__((vector_size(16)));
using Lane8f = float __attribute__((vector_size(32)));
using Lane16f = float __attribute__((vector_size(64)));
using Lane16 = double __attribute__((vector_size(128)));

// Numbers that fill so many bytes.
template <class Real, int bytes>
struct VectorOf;
template <>
struct VectorOf<double, 16> {
  using type = Lane2;
};
template <>
struct VectorOf<double, 32> {
  using type = Lane4;
};
template <>
struct VectorOf<double, 64> {
  using type = Lane8;
};
template <>
struct VectorOf<float, 8> {
  using type = Lane2f;
};
template <>
struct VectorOf<float, 16> {
  using type = Lane4f;
};
template <>
struct VectorOf<float, 32> {
  using type = Lane8f;
};
template <>
struct VectorOf<float, 64> {
  using type = Lane16f;
};
template <class Real, int bytes>
using LaneOf = typename VectorOf<Real, bytes>::type;
// Four numbers of one node.
template <class Real>
using NodeLane = LaneOf<Real, 4 * sizeof(Real)>;

// Numbers are laid out and added up by so many, whatever the width of a machine's registers: the same bits.
template <class Real>
inline constexpr int lane_count = 64 / sizeof(Real);

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
struct WideOf<Lane8f> {
  using type = Lane8;
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

// Kernels are compiled for several instruction sets, one of which is picked when the program starts. Fused
// multiply-add is never used (-ffp-contract=off), so all give the same bits. Sanitizers do not go together
// with the resolvers, and clang 14 will not pass vectors to an inlined function from a clone.
#if defined(__x86_64__) && defined(__linux__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && !defined(ACUS_PLAIN_KERNELS)
// Before a function of plain loops, which the compiler turns into vectors.
#define ACUS_KERNEL __attribute__((target_clones("avx512f", "avx2", "default")))

namespace kernels {
inline int widest_registers() {
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx512f") ? 64 : __builtin_cpu_supports("avx2") ? 32 : 16;
}
inline int register_bytes = widest_registers();  // a test may ask for less than this machine has
template <class Kernel>
__attribute__((target("avx512f"), noinline)) void run_by_64(const Kernel& kernel) {
  kernel(std::integral_constant<int, 64>{});
}
template <class Kernel>
__attribute__((target("avx2"), noinline)) void run_by_32(const Kernel& kernel) {
  kernel(std::integral_constant<int, 32>{});
}
template <class Kernel>
__attribute__((noinline)) void run_by_16(const Kernel& kernel) {
  kernel(std::integral_constant<int, 16>{});
}
}  // namespace kernels

// Calls kernel(bytes) with the width of this machine's registers: for kernels written with vectors, which
// wider ones than it has would send through memory. The kernel and all it calls are ACUS_INLINE.
template <class Kernel>
void run_kernel(const Kernel& kernel) {
  switch (kernels::register_bytes) {
    case 64:
      return kernels::run_by_64(kernel);
    case 32:
      return kernels::run_by_32(kernel);
    default:
      return kernels::run_by_16(kernel);
  }
}
#else
#define ACUS_KERNEL
namespace kernels {
inline int register_bytes = 16;
}
template <class Kernel>
void run_kernel(const Kernel& kernel) {
  kernel(std::integral_constant<int, 16>{});
}
#endif
#define ACUS_INLINED __attribute__((always_inline))  // of a lambda

template <class Real>
ACUS_INLINE NodeLane<Real> load4(const Real* p) {
  NodeLane<Real> v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
ACUS_INLINE void store4(double* p, Lane4 v) { std::memcpy(p, &v, sizeof v); }
ACUS_INLINE void store4(float* p, Lane4f v) { std::memcpy(p, &v, sizeof v); }
template <class Lane, class Real>
ACUS_INLINE Lane load_lanes(const Real* p) {
  static_assert(std::is_same_v<RealOf<Lane>, Real>);
  Lane lane;
  std::memcpy(&lane, p, sizeof lane);
  return lane;
}
template <class Lane>
ACUS_INLINE Wide<Lane> widened(const Lane& v) {
  return __builtin_convertvector(v, Wide<Lane>);
}
// In single precision, of two vectors one.
ACUS_INLINE Lane4f narrowed(const Lane2& a, const Lane2& b) {
  return __builtin_shufflevector(__builtin_convertvector(a, Lane2f), __builtin_convertvector(b, Lane2f), 0, 1,
                                 2, 3);
}
ACUS_INLINE Lane8f narrowed(const Lane4& a, const Lane4& b) {
  return __builtin_shufflevector(__builtin_convertvector(a, Lane4f), __builtin_convertvector(b, Lane4f), 0, 1,
                                 2, 3, 4, 5, 6, 7);
}
ACUS_INLINE Lane16f narrowed(const Lane8& a, const Lane8& b) {
  return __builtin_shufflevector(__builtin_convertvector(a, Lane8f), __builtin_convertvector(b, Lane8f), 0, 1,
                                 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
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
