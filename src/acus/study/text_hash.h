// The hash of text: names what stands in a file.
#pragma once

#include <cstdint>
#include <string_view>

#include "acus/base/hash.h"

namespace acus::study {

// Continues hash `so_far` over the bytes of `text` and their number.
std::uint64_t hash_of_text(std::string_view text, std::uint64_t so_far = hash_seed);

}  // namespace acus::study
