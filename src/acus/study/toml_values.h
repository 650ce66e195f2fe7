// The values below a TOML table, flat and in the order in which they were written.
#pragma once

#include <string>
#include <vector>

#include "acus/io/toml.h"

namespace acus::study {

// The value as TOML text; empty for what no scene key can be (a table, a date).
std::string value_text(const toml::node& node);

// The words of a value that is a TOML string; any other value as it stands.
std::string plain_text(const std::string& value);

struct KeyedNode {
  std::string key;  // dotted
  const toml::node* node;
};

// Every value below `table` by its dotted key.
std::vector<KeyedNode> leaves(const toml::table& table);

}  // namespace acus::study
