#include "acus/study/toml_reading.h"

#include <algorithm>
#include <filesystem>

#include "acus/io/spelling.h"
#include "acus/study/markup.h"

namespace acus::study {

std::string TomlReading::folder() const { return std::filesystem::path(file_).parent_path().string(); }

void TomlReading::fail(const Error& error) {
  if (!failed()) error_ = error;
}

std::string TomlReading::place(const toml::node& node) const {
  const auto& at = node.source().begin;
  return joined({file_, ":", std::to_string(at.line), ":", std::to_string(at.column)});
}

void TomlReading::fail(const toml::node* node, const std::string& sentence) {
  fail(Error{joined({node != nullptr ? place(*node) : file_, ": ", sentence})});
}

void TomlReading::only_keys(const toml::table& table, const char* where,
                            std::initializer_list<const char*> known) {
  const std::vector<std::string> names(known.begin(), known.end());
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    const std::string near = io::nearest_word(name, names);
    std::string list;
    for (const std::string& one : names) list += joined({list.empty() ? "" : ", ", one});
    fail(&node, joined({name, " is not a key of ", where, "; ",
                        near.empty() ? joined({"it knows ", list}) : joined({"did you mean ", near, "?"})}));
  }
}

std::string TomlReading::word(const toml::table& table, const char* key, const std::string& otherwise) {
  const toml::node* node = table.get(key);
  if (node == nullptr) return otherwise;
  if (!node->is_string()) fail(node, joined({key, " must be text in quotes"}));
  return node->value_or(otherwise);
}

std::vector<std::string> TomlReading::words(const toml::table& table, const char* key) {
  std::vector<std::string> out;
  const toml::node* node = table.get(key);
  if (node == nullptr) return out;
  const toml::array* list = node->as_array();
  if (list == nullptr || list->empty()) {
    fail(node, joined({key, " must be a list of texts in quotes, with at least one"}));
    return out;
  }
  for (const toml::node& item : *list) {
    if (!item.is_string()) fail(&item, joined({key, " must hold texts in quotes only"}));
    out.push_back(item.value_or(std::string()));
  }
  return out;
}

}  // namespace acus::study
