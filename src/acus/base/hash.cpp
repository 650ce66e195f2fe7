#include "acus/base/hash.h"

#include "acus/base/bits.h"

namespace acus {
namespace {

std::uint64_t absorb(std::uint64_t word, int bytes, std::uint64_t hash) {
  constexpr std::uint64_t prime = 0x100000001b3ULL;
  for (int i = 0; i < bytes; ++i) hash = (hash ^ ((word >> (8 * i)) & 0xffU)) * prime;
  return hash;
}

}  // namespace

std::uint64_t hash_of(std::span<const double> values, std::uint64_t so_far) {
  for (double v : values) so_far = absorb(bits_as<std::uint64_t>(v == 0.0 ? 0.0 : v), 8, so_far);
  return so_far;
}

std::uint64_t hash_of(std::span<const int> values, std::uint64_t so_far) {
  for (int v : values) so_far = absorb(static_cast<std::uint32_t>(v), 4, so_far);
  return so_far;
}

std::uint64_t hash_of_bytes(std::string_view bytes, std::uint64_t so_far) {
  for (const char byte : bytes) so_far = absorb(static_cast<unsigned char>(byte), 1, so_far);
  return so_far;
}

std::string hex(std::uint64_t hash) {
  std::string digits(16, '0');
  for (int i = 15; i >= 0; --i, hash >>= 4)
    digits[static_cast<std::size_t>(i)] = "0123456789abcdef"[hash & 0xfU];
  return digits;
}

}  // namespace acus
