#include "acus/study/text_hash.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>

namespace acus::study {

std::uint64_t hash_of_text(std::string_view text, std::uint64_t so_far) {
  std::array<int, 1024> words{};  // a program or a mesh may have many millions of bytes: piece by piece
  const auto bytes = static_cast<std::uint64_t>(text.size());
  const std::array<int, 2> length{static_cast<int>(bytes & 0xffffffffU), static_cast<int>(bytes >> 32U)};
  while (!text.empty()) {
    const std::size_t part = std::min(text.size(), sizeof words), used = (part + 3) / 4;
    words[used - 1] = 0;
    std::memcpy(words.data(), text.data(), part);
    so_far = hash_of(std::span<const int>(words.data(), used), so_far);
    text.remove_prefix(part);
  }
  return hash_of(length, so_far);
}

}  // namespace acus::study
