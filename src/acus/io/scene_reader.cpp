// Reading: TOML -> Scene. A visitor per kind of field takes the value; places in the text are kept for
// errors.
#include <cmath>
#include <filesystem>
#include <map>

#include "acus/base/decimal.h"
#include "acus/io/scene_toml.h"
#include "acus/io/spelling.h"
#include "acus/io/text_file.h"
#include "acus/io/toml_document.h"
#include "acus/sim/scene_keys.h"

namespace acus::io {
namespace {

constexpr std::size_t longest_scene_file = 1 << 20;  // bytes; a scene is a page of text

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

// What stands there, in the words of someone who does not know TOML.
std::string described(const toml::node& node) {
  if (const auto text = node.value<std::string_view>(); node.is_string())
    return "the text " + quoted(std::string(*text));
  if (node.is_floating_point()) return decimal_text(**node.as_floating_point());
  if (node.is_integer()) return std::to_string(**node.as_integer());
  if (node.is_boolean()) return **node.as_boolean() ? "true" : "false";
  if (node.is_array()) return "a list of " + std::to_string(node.as_array()->size());
  if (node.is_table()) return "a table";
  return "a date or time";
}

bool is_number(const toml::node& node) { return node.is_integer() || node.is_floating_point(); }
double number(const toml::node& node) {
  return node.is_integer() ? static_cast<double>(**node.as_integer()) : **node.as_floating_point();
}

// Puts one value into the scene; returns what is wrong, to be put behind the name of the key.
struct FieldReader {
  Scene& scene;
  const toml::node& node;
  std::filesystem::path folder;  // relative file names start here

  std::string operator()(const NumberField& field) const {
    if (!is_number(node)) return "must be a number " + in_words(field.range) + ", but is " + described(node);
    if (auto said = complaint(field.range, number(node)); !said.empty()) return said;
    field.of(scene) = times_power_of_ten(number(node), field.power);
    return {};
  }

  std::string operator()(const IntegerField& field) const {
    if (!is_number(node) || number(node) != std::floor(number(node)))
      return "must be a whole number " + in_words(field.range) + ", but is " + described(node);
    if (auto said = complaint(field.range, number(node)); !said.empty()) return said;
    field.of(scene) = static_cast<int>(number(node));
    return {};
  }

  std::string operator()(const SwitchField& field) const {
    if (!node.is_boolean()) return "must be true or false, but is " + described(node);
    field.of(scene) = **node.as_boolean();
    return {};
  }

  std::string operator()(const ChoiceField& field) const {
    const std::string word = node.value_or(std::string());
    for (std::size_t i = 0; i < field.names.size(); ++i)
      if (node.is_string() && word == field.names[i])
        return field.set(scene, static_cast<int>(i)), std::string();
    std::string allowed;
    for (const std::string& name : field.names) allowed += (allowed.empty() ? "" : ", ") + quoted(name);
    const std::string said = (field.names.size() == 1 ? "must be " : "must be one of ") + allowed +
                             (field.names.size() == 1 ? " in this version" : "") + ", but is " +
                             described(node);
    const std::string near = node.is_string() ? nearest_word(word, field.names) : "";
    return near.empty() ? said : said + "; did you mean " + quoted(near) + "?";
  }

  std::string operator()(const FileField& field) const {
    if (!node.is_string()) return "must be the name of a file in quotes, but is " + described(node);
    const std::string name = **node.as_string();
    field.of(scene) = name.empty() ? name : (folder / name).lexically_normal().string();
    return {};
  }

  std::string operator()(const VectorField& field) const {
    const toml::array* list = node.as_array();
    const std::string wanted = "must be a list of 3 numbers, each " + in_words(field.range);
    if (list == nullptr || list->size() != 3) return wanted + ", but is " + described(node);
    Vec3 value;
    for (std::size_t i = 0; i < 3; ++i) {
      const toml::node& item = (*list)[i];
      if (!is_number(item)) return wanted + ", but holds " + described(item);
      if (auto said = complaint(field.range, number(item)); !said.empty())
        return "has a component that " + said;
      value[static_cast<int>(i)] = times_power_of_ten(number(item), field.power);
    }
    field.of(scene) = value;
    return {};
  }

  std::string operator()(const HandPathField& field) const {
    const std::string wanted = "must be a list of [time in s, travel in mm], as in [[0, 0], [5, 50]]";
    const toml::array* list = node.as_array();
    if (list == nullptr) return wanted + ", but is " + described(node);
    std::vector<HandPoint> path;
    for (const toml::node& item : *list) {
      const toml::array* pair = item.as_array();
      if (pair == nullptr || pair->size() != 2 || !is_number((*pair)[0]) || !is_number((*pair)[1]))
        return wanted + ", but its point " + std::to_string(path.size() + 1) + " is " + described(item);
      const double time = number((*pair)[0]), travel = number((*pair)[1]);
      if (auto said = complaint(field.time, time); !said.empty()) return "has a time in s that " + said;
      if (auto said = complaint(field.travel, travel); !said.empty())
        return "has a travel in mm that " + said;
      path.push_back({time, times_power_of_ten(travel, field.travel_power)});
    }
    field.of(scene) = std::move(path);
    return {};
  }
};

// What could stand where `name` stands: tables at the top, keys below.
std::vector<std::string> names_in_place_of(const std::string& name) {
  std::vector<std::string> names;
  for (const SceneKey& key : scene_keys()) {
    const bool at_top = name.find('.') == std::string::npos;
    names.push_back(at_top ? key.name.substr(0, key.name.find('.')) : key.name);
  }
  return names;
}

bool is_table_name(const std::string& name) {
  for (const SceneKey& key : scene_keys())
    if (key.name.compare(0, name.size() + 1, name + ".") == 0) return true;
  return false;
}

std::string unknown_key(const std::string& name) {
  const std::string near = nearest_word(name, names_in_place_of(name));
  return name + " is not a key of a scene; " +
         (near.empty() ? "`acus check --keys` lists them all" : "did you mean " + near + "?");
}

// A scene under construction, and where in the text each key was given.
class Reading {
 public:
  explicit Reading(Scene scene) : scene_(std::move(scene)) {}

  // Takes every key below `table`; an Error at the first that is wrong.
  std::optional<Error> take(const toml::table& table, const std::string& prefix, const std::string& file) {
    for (const auto& [key, node] : table) {
      const std::string name = prefix + std::string(key.str());
      const auto place = node.source().begin.line != 0 ? node.source().begin : key.source().begin;
      const std::string where = file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
      if (const SceneKey* known = find_scene_key(name)) {
        if (auto wrong = put(*known, node, std::filesystem::path(file).parent_path(), where)) return wrong;
      } else if (!is_table_name(name)) {
        return Error{where + ": " + unknown_key(name)};
      } else if (!node.is_table()) {
        return Error{where + ": " + name + " must be a table, as in [" + name + "], but is " +
                     described(node)};
      } else if (auto wrong = take(*node.as_table(), name + ".", file)) {
        return wrong;
      }
    }
    return std::nullopt;
  }

  std::optional<Error> put(const SceneKey& key, const toml::node& node, const std::filesystem::path& folder,
                           const std::string& where) {
    const std::string said = std::visit(FieldReader{scene_, node, folder}, key.field);
    if (!said.empty()) return Error{where + ": " + key.name + " " + said};
    places_[key.name] = where;
    return std::nullopt;
  }

  // The scene, checked as a whole; the place of the key that a complaint begins with goes before it.
  Result<Scene> finished(const std::string& name) && {
    Result<Scene> checked = validated(std::move(scene_));
    if (checked) return checked;
    const std::string& sentence = checked.error().sentence;
    const auto place = places_.find(sentence.substr(0, sentence.find(' ')));
    const std::string where = place != places_.end() ? place->second : name;
    return Error{where.empty() ? sentence : where + ": " + sentence};
  }

 private:
  Scene scene_;
  std::map<std::string, std::string> places_;
};

// "key=value": the value as in TOML, and for words and file names also without quotes.
std::optional<Error> lay_over(Reading& reading, const std::string& setting, const std::string& folder) {
  const std::string where = "--set " + setting;
  const auto equals = setting.find('=');
  if (equals == std::string::npos || equals == 0)
    return Error{where + ": must be key=value, as in --set needle.length_mm=150"};
  const std::string name = setting.substr(0, equals), text = setting.substr(equals + 1);
  const SceneKey* key = find_scene_key(name);
  if (key == nullptr) return Error{where + ": " + unknown_key(name)};
  const bool word =
      std::holds_alternative<ChoiceField>(key->field) || std::holds_alternative<FileField>(key->field);
  if (word && (text.empty() || (text.front() != '"' && text.front() != '\'')))
    return reading.put(*key, toml::value<std::string>(text), folder, where);
  const std::string document = "value = " + text;
  const Result<toml::table> parsed = parse_toml(document, where);
  if (!parsed || parsed->size() != 1 || parsed->get("value") == nullptr)
    return Error{where + ": " + quoted(text) +
                 " cannot be read as a value; write a number, true, \"text\" or [a, b, c]"};
  return reading.put(*key, *parsed->get("value"), folder, where);
}

Result<Scene> finished(Reading reading, const std::vector<std::string>& settings, const std::string& name,
                       const std::string& folder = "") {
  for (const std::string& setting : settings)
    if (auto wrong = lay_over(reading, setting, folder)) return *wrong;
  return std::move(reading).finished(name);
}

}  // namespace

Result<Scene> parse_scene(std::string_view text, const std::string& name,
                          const std::vector<std::string>& settings) {
  const Result<toml::table> parsed = parse_toml(text, name);
  if (!parsed) return parsed.error();
  Reading reading{Scene{}};
  if (auto wrong = reading.take(*parsed, "", name)) return *wrong;
  return finished(std::move(reading), settings, name);
}

Result<Scene> read_scene(const std::string& path, const std::vector<std::string>& settings) {
  const Result<std::string> text = read_text(path, longest_scene_file);
  if (!text) return text.error();
  return parse_scene(*text, path, settings);
}

Result<Scene> with_settings(Scene scene, const std::vector<std::string>& settings,
                            const std::string& folder) {
  return finished(Reading(std::move(scene)), settings, "", folder);
}

}  // namespace acus::io
