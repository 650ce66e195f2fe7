// CRC-32C (Castagnoli, as in iSCSI, RFC 3720 12.1): finds any damage of up to 32 bits in a row, and others
// but for one in four thousand million.
#pragma once

#include <cstdint>
#include <string_view>

namespace acus {

// Continues the checksum `so_far` of earlier bytes over `bytes`.
std::uint32_t crc32c(std::string_view bytes, std::uint32_t so_far = 0);

}  // namespace acus
