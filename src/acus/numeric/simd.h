// Compiler vectors: the same elementwise arithmetic, hence the same bits, on every width of machine.
#pragma once

#include <cstring>

namespace acus::numeric {

// Four and eight doubles. Lane-wise + - * / only; a sum over lanes is always written out in one fixed order.
using Lane4 = double __attribute__((vector_size(32)));
using Lane8 = double __attribute__((vector_size(64)));

#define ACUS_INLINE inline __attribute__((always_inline))

// Compiles a kernel for several instruction sets and picks one when the program starts. Fused multiply-add is
// never used (-ffp-contract=off), so all give the same bits. Sanitizers do not go together with the
// resolvers, and clang 14 will not pass vectors to an inlined function from a clone.
#if defined(__x86_64__) && defined(__linux__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define ACUS_KERNEL __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ACUS_KERNEL
#endif

ACUS_INLINE Lane4 load4(const double* p) {
  Lane4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
ACUS_INLINE void store4(double* p, Lane4 v) { std::memcpy(p, &v, sizeof v); }
ACUS_INLINE double sum(Lane4 v) { return (v[0] + v[1]) + (v[2] + v[3]); }

}  // namespace acus::numeric
