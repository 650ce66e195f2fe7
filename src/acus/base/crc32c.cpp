#include "acus/base/crc32c.h"

#include <array>

namespace acus {
namespace {

// The remainder of each byte, its lowest bit first.
constexpr std::array<std::uint32_t, 256> remainders() {
  constexpr std::uint32_t reflected_polynomial = 0x82F63B78U;
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t remainder = byte;
    for (int bit = 0; bit < 8; ++bit)
      remainder = (remainder >> 1U) ^ ((remainder & 1U) != 0 ? reflected_polynomial : 0U);
    table[byte] = remainder;
  }
  return table;
}

}  // namespace

std::uint32_t crc32c(std::string_view bytes, std::uint32_t so_far) {
  static constexpr std::array<std::uint32_t, 256> table = remainders();
  std::uint32_t remainder = ~so_far;
  for (const char byte : bytes)
    remainder = (remainder >> 8U) ^ table[(remainder ^ static_cast<unsigned char>(byte)) & 0xffU];
  return ~remainder;
}

}  // namespace acus
