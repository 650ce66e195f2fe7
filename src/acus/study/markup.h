// Mark-up text: pieces joined, and words made safe to stand in it.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace acus::study {

std::string joined(std::initializer_list<std::string_view> pieces);

// Text with the characters that mark-up uses written as entities; control characters become spaces.
std::string escaped(std::string_view text);

}  // namespace acus::study
