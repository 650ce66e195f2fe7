// Reading: TOML -> Scene. A visitor per kind of field takes the value; places in the text are kept for
// errors.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "acus/base/decimal.h"
#include "acus/io/scene_toml.h"
#include "acus/io/spelling.h"
#include "acus/io/text_file.h"
#include "acus/io/toml_document.h"
#include "acus/sim/scene_keys.h"
#include "acus/sim/shorthands.h"

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

// Which of `words` stands there; if none, why not, to be put behind the name of the key.
Result<std::size_t> chosen_word(const toml::node& node, const std::vector<std::string>& words) {
  const std::string word = node.value_or(std::string());
  const auto found = std::find(words.begin(), words.end(), word);
  if (node.is_string() && found != words.end()) return static_cast<std::size_t>(found - words.begin());
  std::string allowed;
  for (const std::string& one : words) allowed += (allowed.empty() ? "" : ", ") + quoted(one);
  const std::string said = (words.size() == 1 ? "must be " : "must be one of ") + allowed +
                           (words.size() == 1 ? " in this version" : "") + ", but is " + described(node);
  const std::string near = node.is_string() ? nearest_word(word, words) : "";
  return Error{near.empty() ? said : said + "; did you mean " + quoted(near) + "?"};
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
    const Result<std::size_t> word = chosen_word(node, field.names);
    if (!word) return word.error().sentence;
    field.set(scene, static_cast<int>(*word));
    return {};
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
  for (const Shorthand& shorthand : shorthands()) names.push_back(shorthand.name);
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

bool is_known(const std::string& name) {
  return find_scene_key(name) != nullptr || find_shorthand(name) != nullptr;
}

// A scene under construction, and where in the text each key was given. What is laid over a scene goes before
// it; within one text nothing may be said twice.
class Reading {
 public:
  explicit Reading(Scene scene) : scene_(std::move(scene)) {}

  // Takes every key below `table`; an Error at the first that is wrong.
  std::optional<Error> take(const toml::table& table, const std::string& prefix, const std::string& file) {
    for (const auto& [key, node] : table) {
      const std::string name = prefix + std::string(key.str());
      const auto place = node.source().begin.line != 0 ? node.source().begin : key.source().begin;
      const std::string where = file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
      if (is_known(name)) {
        if (auto wrong = put(name, node, std::filesystem::path(file).parent_path(), where)) return wrong;
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

  // What comes from now on is laid over what came so far.
  void begin_layer() { set_by_.clear(); }

  // The value of a key, or of a shorthand for several.
  std::optional<Error> put(const std::string& name, const toml::node& node,
                           const std::filesystem::path& folder, const std::string& where) {
    if (const Shorthand* shorthand = find_shorthand(name)) {
      const Result<std::size_t> word = chosen_word(node, shorthand->words);
      if (!word) return Error{where + ": " + name + " " + word.error().sentence};
      shorthand->set(scene_, *word);
      for (const std::string& key : shorthand->keys)
        if (auto twice = note(key, name, where)) return twice;
      return std::nullopt;
    }
    const SceneKey& key = *find_scene_key(name);
    const std::string said = std::visit(FieldReader{scene_, node, folder}, key.field);
    if (!said.empty()) return Error{where + ": " + name + " " + said};
    return note(name, name, where);
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
  // That `key` was set, through the name `by`.
  std::optional<Error> note(const std::string& key, const std::string& by, const std::string& where) {
    places_[key] = where;
    const std::string& first = set_by_.emplace(key, by).first->second;
    if (first == by) return std::nullopt;
    const std::string& shorthand = first == key ? by : first;
    return Error{where + ": " + shorthand + " sets " + key + ", which is given too; remove one of the two"};
  }

  Scene scene_;
  std::map<std::string, std::string> places_;
  std::map<std::string, std::string> set_by_;  // key -> itself or its shorthand, in this layer
};

// "key=value": the value as in TOML, and for words and file names also without quotes.
std::optional<Error> lay_over(Reading& reading, const std::string& setting, const std::string& folder) {
  const std::string where = "--set " + setting;
  const auto equals = setting.find('=');
  if (equals == std::string::npos || equals == 0)
    return Error{where + ": must be key=value, as in --set needle.length_mm=150"};
  const std::string name = setting.substr(0, equals), text = setting.substr(equals + 1);
  if (!is_known(name)) return Error{where + ": " + unknown_key(name)};
  const SceneKey* key = find_scene_key(name);
  const bool word = key == nullptr || std::holds_alternative<ChoiceField>(key->field) ||
                    std::holds_alternative<FileField>(key->field);
  if (word && (text.empty() || (text.front() != '"' && text.front() != '\'')))
    return reading.put(name, toml::value<std::string>(text), folder, where);
  const std::string document = "value = " + text;
  const Result<toml::table> parsed = parse_toml(document, where);
  if (!parsed || parsed->size() != 1 || parsed->get("value") == nullptr)
    return Error{where + ": " + quoted(text) +
                 " cannot be read as a value; write a number, true, \"text\" or [a, b, c]"};
  return reading.put(name, *parsed->get("value"), folder, where);
}

Result<Scene> finished(Reading reading, const std::vector<std::string>& settings, const std::string& name,
                       const std::string& folder = "") {
  reading.begin_layer();
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
