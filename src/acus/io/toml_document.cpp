#include "acus/io/toml_document.h"

#include <algorithm>

namespace acus::io {
namespace {

constexpr int most_parts = 16;  // of a dotted key; scenes have two

// The end of the string that begins at `at`: the place behind its closing quotes, or the end of the text.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool long_string = text.substr(at, 3) == std::string(3, quote);
  const std::string closing(long_string ? 3 : 1, quote);
  for (std::size_t i = at + closing.size(); i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\')
      ++i;
    else if (text.substr(i, closing.size()) == closing)
      return i + closing.size();
    else if (!long_string && text[i] == '\n')
      return i;
  }
  return text.size();
}

// Whether a key has too many parts, and at which line: counts the dots between what separates keys.
long line_of_deep_key(std::string_view text) {
  int dots = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i = end_of_string(text, i);
      continue;
    }
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    if (c == '.' && ++dots >= most_parts)
      return 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\n');
    if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') dots = 0;
    ++i;
  }
  return 0;
}

}  // namespace

Result<toml::table> parse_toml(std::string_view text, const std::string& name) {
  if (const long line = line_of_deep_key(text))
    return Error{name + ":" + std::to_string(line) + ": a key has more than " + std::to_string(most_parts) +
                 " parts; keys are written as in needle.length_mm"};
  toml::parse_result parsed = toml::parse(text);
  if (parsed) return std::move(parsed).table();
  const toml::source_position place = parsed.error().source().begin;
  return Error{name + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) +
               ": is not TOML: " + std::string(parsed.error().description())};
}

}  // namespace acus::io
