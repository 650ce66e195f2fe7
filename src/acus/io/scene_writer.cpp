// Writing: Scene -> TOML, JSON and the reference of keys.
#include <cmath>
#include <nlohmann/json.hpp>

#include "acus/base/decimal.h"
#include "acus/io/scene_toml.h"
#include "acus/needle/gauges.h"
#include "acus/sim/scene_keys.h"
#include "acus/sim/shorthands.h"

namespace acus::io {
namespace {

using Json = nlohmann::ordered_json;

// The number to write for an SI value: one that reads back as the very same double.
double as_written(double si, int power) {
  const double nearest = times_power_of_ten(si, -power);
  const double below = std::nextafter(nearest, -INFINITY), above = std::nextafter(nearest, INFINITY);
  for (double candidate : {nearest, below, above})
    if (times_power_of_ten(candidate, power) == si) return candidate;
  return nearest;  // `si` lies between the values this key can express
}

struct FieldWriter {
  Scene scene;  // a copy: fields hand out references

  Json operator()(const NumberField& f) { return as_written(f.of(scene), f.power); }
  Json operator()(const IntegerField& f) { return f.of(scene); }
  Json operator()(const SwitchField& f) { return f.of(scene); }
  Json operator()(const ChoiceField& f) { return f.names.at(static_cast<std::size_t>(f.get(scene))); }
  Json operator()(const FileField& f) { return f.of(scene); }
  Json operator()(const VectorField& f) {
    const Vec3& v = f.of(scene);
    return {as_written(v.x(), f.power), as_written(v.y(), f.power), as_written(v.z(), f.power)};
  }
  Json operator()(const HandPathField& f) {
    Json points = Json::array();
    for (const HandPoint& point : f.of(scene))
      points.push_back({point.time, as_written(point.travel, f.travel_power)});
    return points;
  }
};

std::string toml_value(const Json& value) {
  if (value.is_string()) return toml_string(value.get<std::string>());
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (!value.is_array()) return decimal_text(value.get<double>());
  std::string out = "[";
  for (const Json& item : value) out += (out.size() > 1 ? ", " : "") + toml_value(item);
  return out + "]";
}

std::string table_of(const std::string& key) { return key.substr(0, key.find('.')); }
std::string name_in_table(const std::string& key) { return key.substr(key.find('.') + 1); }

struct AllowedInWords {
  std::string operator()(const NumberField& f) const { return in_words(f.range); }
  std::string operator()(const IntegerField& f) const { return "whole, " + in_words(f.range); }
  std::string operator()(const SwitchField&) const { return "`true`, `false`"; }
  std::string operator()(const ChoiceField& f) const {
    std::string all;
    for (const std::string& name : f.names) all += (all.empty() ? "`\"" : ", `\"") + name + "\"`";
    return all;
  }
  std::string operator()(const FileField&) const { return "file name"; }
  std::string operator()(const VectorField& f) const { return "3 numbers, each " + in_words(f.range); }
  std::string operator()(const HandPathField& f) const {
    return "times rising from 0 s; travel " + in_words(f.travel) + " mm, below the needle's length";
  }
};

std::string row(const std::vector<std::string>& cells) {
  std::string out = "|";
  for (const std::string& cell : cells) out += " " + cell + " |";
  return out + "\n";
}

std::string in_mm(double metres) { return decimal_text(as_written(metres, -3)); }

// The part of the reference that is about words for several keys, and what they stand for.
std::string shorthands_in_words() {
  std::string out = R"(
## One word for several keys

A scene is written with the numbers that such a word stands for. Within one file, or one list of `--set`, either the word is
given or the key; what is laid over a scene goes before what the scene has.

| word | sets | allowed |
|---|---|---|
)";
  for (const Shorthand& one : shorthands()) {
    std::string keys;
    for (const std::string& key : one.keys) keys += (keys.empty() ? "`" : ", `") + key + "`";
    out += row({"`" + one.name + "`", keys, one.help});
  }
  out += R"(
Gauges of hypodermic tube, nominal, regular wall, after the needle gauge comparison chart; ISO 9626 rounds them to metric
sizes.

| `needle.gauge` | outer diameter, mm | bore, mm |
|---|---|---|
)";
  for (const needle::Gauge& gauge : needle::gauges())
    out += row(
        {"`\"" + std::string(gauge.name) + "\"`", in_mm(gauge.outer_diameter), in_mm(gauge.inner_diameter)});
  out += R"(
| `needle.material` | Young's modulus, GPa | density, kg/m^3 | source |
|---|---|---|---|
)";
  for (const needle::Material& one : needle::materials())
    out += row({"`\"" + std::string(one.name) + "\"`", decimal_text(as_written(one.youngs_modulus, 9)),
                decimal_text(one.density), one.source});
  return out;
}

}  // namespace

std::string toml_string(const std::string& text) {
  std::string out = "\"";
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') out += '\\';
    if (byte >= 0x20 && byte != 0x7f) {
      out += c;
      continue;
    }
    constexpr const char* digits = "0123456789ABCDEF";
    out += std::string("\\u00") + digits[byte >> 4U] + digits[byte & 0xfU];
  }
  return out + "\"";
}

Json scene_json(const Scene& scene) {
  Json tables = Json::object();
  FieldWriter writer{scene};
  for (const SceneKey& key : scene_keys())
    tables[table_of(key.name)][name_in_table(key.name)] = std::visit(writer, key.field);
  return tables;
}

std::string scene_toml(const Scene& scene) {
  const Json tables = scene_json(scene);
  std::string out;
  for (const auto& [table, keys] : tables.items()) {
    out += (out.empty() ? "[" : "\n[") + table + "]\n";
    for (const auto& [key, value] : keys.items()) out += key + " = " + toml_value(value) + "\n";
  }
  return out;
}

std::string needles_json() {
  Json gauges = Json::array(), materials = Json::array();
  for (const needle::Gauge& gauge : needle::gauges())
    gauges.push_back({{"name", gauge.name},
                      {"outer_diameter_mm", as_written(gauge.outer_diameter, -3)},
                      {"inner_diameter_mm", as_written(gauge.inner_diameter, -3)}});
  for (const needle::Material& material : needle::materials())
    materials.push_back({{"name", material.name},
                         {"words", material.words},
                         {"youngs_modulus_GPa", as_written(material.youngs_modulus, 9)},
                         {"density_kg_m3", material.density},
                         {"source", material.source}});
  return Json{{"gauges", gauges}, {"materials", materials}}.dump(1) + "\n";
}

std::string scene_keys_page() {
  std::string page =
      "# Scene keys\n\nEvery key of a scene, with its default. The unit is the end of the name. This page is "
      "printed by "
      "`acus check --keys`.\n\n| key | default | allowed | meaning |\n|---|---|---|---|\n";
  FieldWriter defaults{Scene{}};
  for (const SceneKey& key : scene_keys())
    page += "| `" + key.name + "` | `" + toml_value(std::visit(defaults, key.field)) + "` | " +
            std::visit(AllowedInWords{}, key.field) + " | " + key.help + " |\n";
  return page + shorthands_in_words();
}

}  // namespace acus::io
