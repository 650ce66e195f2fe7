#include "acus/study/toml_values.h"

#include <algorithm>

#include "acus/base/decimal.h"
#include "acus/io/scene_toml.h"
#include "acus/io/toml_document.h"
#include "acus/study/markup.h"

namespace acus::study {
namespace {

void collect(const toml::table& table, const std::string& prefix, std::vector<KeyedNode>& out) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    if (const toml::table* inner = node.as_table()) {
      collect(*inner, name + ".", out);
    } else {
      out.push_back({name, &node});
    }
  }
}

}  // namespace

std::string value_text(const toml::node& node) {
  if (node.is_integer()) return std::to_string(**node.as_integer());
  if (node.is_floating_point()) return decimal_text(**node.as_floating_point());
  if (node.is_boolean()) return **node.as_boolean() ? "true" : "false";
  if (node.is_string()) return io::toml_string(**node.as_string());
  if (!node.is_array()) return {};
  std::string list;
  for (const toml::node& item : *node.as_array())
    list += joined({list.empty() ? "[" : ", ", value_text(item)});
  return list.empty() ? "[]" : list + "]";
}

std::string plain_text(const std::string& value) {
  const Result<toml::table> parsed = io::parse_toml(joined({"value = ", value}), "value");
  const toml::node* node = parsed ? parsed->get("value") : nullptr;
  return node != nullptr && node->is_string() ? **node->as_string() : value;
}

std::vector<KeyedNode> leaves(const toml::table& table) {
  std::vector<KeyedNode> all;
  collect(table, "", all);
  std::stable_sort(all.begin(), all.end(), [](const KeyedNode& a, const KeyedNode& b) {
    const auto &p = a.node->source().begin, &q = b.node->source().begin;
    return p.line != q.line ? p.line < q.line : p.column < q.column;
  });
  return all;
}

}  // namespace acus::study
