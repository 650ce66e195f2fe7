// A TOML text as a table: the one place where scenes, studies and settings are parsed.
#pragma once

#include <string>
#include <string_view>

#include "acus/base/result.h"
#include "acus/io/toml.h"

namespace acus::io {

// `name` stands for the file in errors ("name:line:column: ..."). Refuses what is not TOML, and keys of more
// than sixteen parts: toml++ makes a table of each part, and would exhaust the stack over a text that is made
// of dots.
Result<toml::table> parse_toml(std::string_view text, const std::string& name);

}  // namespace acus::io
