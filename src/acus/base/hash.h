// FNV-1a over bytes: names a state, so that "the same bits" can be checked and printed.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace acus {

inline constexpr std::uint64_t hash_seed = 0xcbf29ce484222325ULL;

// Continues hash `so_far` over the bytes of `values`; -0.0 and 0.0 hash alike.
std::uint64_t hash_of(std::span<const double> values, std::uint64_t so_far = hash_seed);
std::uint64_t hash_of(std::span<const int> values, std::uint64_t so_far = hash_seed);
// Of bytes as they are, as a file has them.
std::uint64_t hash_of_bytes(std::string_view bytes, std::uint64_t so_far = hash_seed);
// Sixteen lower-case hexadecimal digits.
std::string hex(std::uint64_t hash);

}  // namespace acus
