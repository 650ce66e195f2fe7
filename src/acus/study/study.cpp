#include "acus/study/study.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "acus/io/scene_toml.h"
#include "acus/io/text_file.h"
#include "acus/io/toml_document.h"
#include "acus/sim/names.h"
#include "acus/sim/scene_keys.h"
#include "acus/study/markup.h"
#include "acus/study/run_record.h"
#include "acus/study/toml_reading.h"
#include "acus/study/toml_values.h"

namespace acus::study {
namespace {

constexpr std::size_t longest_study_file = 1 << 20;  // bytes
constexpr int deepest_include = 4;
// Letters; a file system takes 255, and the pictures of a study are named for it and their panel.
constexpr std::size_t longest_study_name = 100, longest_run_name = 200;

struct ExhibitName {
  const char* word;
  Exhibit exhibit;
};
constexpr ExhibitName exhibit_names[] = {
    {"force", Exhibit::force},         {"energy", Exhibit::energy},     {"stages", Exhibit::stages},
    {"mesh", Exhibit::mesh},           {"loads", Exhibit::loads},       {"column", Exhibit::column},
    {"shapes", Exhibit::shapes},       {"coupling", Exhibit::coupling}, {"convergence", Exhibit::convergence},
    {"exactness", Exhibit::exactness}, {"felt", Exhibit::felt},         {"map", Exhibit::map},
    {"track", Exhibit::track},         {"depth", Exhibit::depth}};

// Reads one study file.
class Reader : private TomlReading {
 public:
  Reader(std::string file, std::vector<std::string> settings)
      : TomlReading(std::move(file)), settings_(std::move(settings)) {}

  Result<Study> read(int depth);

 private:
  void check_name(const toml::table& root, const std::string& name);

  void read_includes(const toml::table& root, int depth, Study& study);
  Group read_group(const toml::table& root);
  std::string ending_event(const toml::table& root);
  std::optional<Scene> base_scene(const toml::table& root);
  std::vector<Case> named_runs(const toml::table& root);
  std::vector<Axis> axes(const toml::table& root);
  std::vector<Case> sample(const toml::table& root);
  std::vector<Choice> choices(const toml::table& table, const char* but);
  void keep_place(const Choice& choice, const toml::node& node);
  ReportWish report(const toml::table& root);
  Error placed(const Error& error) const;

  std::vector<std::string> settings_;
  std::map<std::string, std::string> places_;  // "key=value" -> file:line:column
};

// A complaint about a value of this file is about its place there, not about the --set that it was laid over
// as.
Error Reader::placed(const Error& error) const {
  for (const auto& [setting, where] : places_) {
    const std::string prefix = joined({"--set ", setting, ": "});
    if (error.sentence.starts_with(prefix))
      return Error{joined({where, ": ", std::string_view(error.sentence).substr(prefix.size())})};
  }
  return Error{joined({file(), ": ", error.sentence})};
}

// The name of a study is that of the folder of its runs, which stands beside what the report is made of.
void Reader::check_name(const toml::table& root, const std::string& name) {
  const std::string said = joined({"name = \"", name, "\" "});
  if (name != name_part({"", io::toml_string(name)}) || name.starts_with('.') || name.empty())
    fail(root.get("name"), said + "may hold letters, digits, - _ + and . only, and at least one");
  if (name.size() > longest_study_name)
    fail(root.get("name"),
         joined({said, "is too long; take at most ", std::to_string(longest_study_name), " letters"}));
  for (const char* taken : {"figures", "results.csv", "report.html"}) {
    if (name == taken)
      fail(root.get("name"), said + "is what a part of the report is called; choose another");
  }
}

void Reader::keep_place(const Choice& choice, const toml::node& node) {
  places_[joined({choice.key, "=", choice.value})] = place(node);
}

std::vector<Choice> Reader::choices(const toml::table& table, const char* but) {
  std::vector<Choice> out;
  for (const KeyedNode& leaf : leaves(table)) {
    if (leaf.key == but) continue;
    out.push_back({leaf.key, value_text(*leaf.node)});
    keep_place(out.back(), *leaf.node);
  }
  return out;
}

std::vector<std::string> as_settings(const std::vector<Choice>& choices) {
  std::vector<std::string> settings;
  for (const Choice& choice : choices) settings.push_back(joined({choice.key, "=", choice.value}));
  return settings;
}

std::optional<Scene> Reader::base_scene(const toml::table& root) {
  Scene scene;
  const std::string base = word(root, "base", "");
  if (!base.empty()) {
    const Result<Scene> read = io::read_scene((std::filesystem::path(folder()) / base).string());
    if (!read) return fail(root.get("base"), "base: " + read.error().sentence), std::nullopt;
    scene = *read;
  }
  if (const toml::node* node = root.get("scene")) {
    if (!node->is_table()) return fail(node, "scene must be a table, as in [scene.needle]"), std::nullopt;
    const Result<Scene> laid =
        io::with_settings(scene, as_settings(choices(*node->as_table(), "")), folder());
    if (!laid) return fail(placed(laid.error())), std::nullopt;
    scene = *laid;
  }
  const Result<Scene> set = io::with_settings(scene, settings_);
  if (!set) return fail(set.error()), std::nullopt;
  return *set;
}

std::vector<Case> Reader::named_runs(const toml::table& root) {
  std::vector<Case> cases;
  const toml::node* node = root.get("run");
  if (node == nullptr) return cases;
  const toml::array* list = node->as_array();
  if (list == nullptr || !list->is_homogeneous(toml::node_type::table))
    return fail(node, "run must be a list of tables, each begun with [[run]]"), cases;
  for (const toml::node& item : *list) {
    const toml::table& table = *item.as_table();
    const std::string name = word(table, "name", "");
    if (name.empty()) fail(&item, "a [[run]] needs a name, as in name = \"short\"");
    if (name != name_part({"", io::toml_string(name)}) || name.starts_with('.'))
      fail(&item, joined({"the name \"", name, "\" of a run may hold letters, digits, - _ + and . only"}));
    cases.push_back({name, choices(table, "name")});
  }
  return cases;
}

std::vector<Axis> Reader::axes(const toml::table& root) {
  std::vector<Axis> out;
  const toml::node* node = root.get("axes");
  if (node == nullptr) return out;
  if (!node->is_table()) return fail(node, "axes must be a table of lists, as in [axes]"), out;
  for (const KeyedNode& leaf : leaves(*node->as_table())) {
    const toml::array* list = leaf.node->as_array();
    if (list == nullptr || list->empty()) {
      fail(leaf.node,
           joined({"axes.", leaf.key, " must be a list of at least one value, as in [150, 200, 300]"}));
      return out;
    }
    Axis axis{leaf.key, {}};
    for (const toml::node& item : *list) {
      axis.values.push_back(value_text(item));
      keep_place({leaf.key, axis.values.back()}, item);
    }
    out.push_back(std::move(axis));
  }
  return out;
}

std::vector<Case> Reader::sample(const toml::table& root) {
  const toml::node* node = root.get("sample");
  if (node == nullptr) return {};
  if (!node->is_table()) return fail(node, "sample must be a table, as in [sample]"), std::vector<Case>{};
  const toml::table& table = *node->as_table();
  only_keys(table, "[sample]", {"count", "seed", "range"});
  const auto count = table["count"].value_exact<std::int64_t>(),
             seed = table["seed"].value_exact<std::int64_t>();
  if (!count || *count < 1 || *count > most_runs)
    fail(node, joined({"sample.count must be a whole number from 1 to ", std::to_string(most_runs)}));
  if (!seed) fail(node, "sample.seed must be a whole number: the same seed gives the same runs");
  const toml::node* given = table.get("range");
  if (given == nullptr || !given->is_table() || given->as_table()->empty())
    fail(node, "sample.range must name at least one key and its range, as in needle.radius_mm = [0.2, 0.4]");
  if (failed()) return {};
  std::vector<RandomRange> ranges;
  for (const KeyedNode& leaf : leaves(*given->as_table())) {
    const toml::array* list = leaf.node->as_array();
    const bool pair =
        list != nullptr && list->size() == 2 && (*list)[0].is_number() && (*list)[1].is_number();
    const double low = pair ? (*list)[0].value_or(0.0) : 0.0, high = pair ? (*list)[1].value_or(0.0) : 0.0;
    if (!pair || !(low < high)) {
      fail(leaf.node, joined({"sample.range.", leaf.key, " must be [low, high] with low below high"}));
      return {};
    }
    const SceneKey* key = find_scene_key(leaf.key);
    const bool whole = key != nullptr && std::holds_alternative<IntegerField>(key->field);
    ranges.push_back({leaf.key, low, high, whole});
  }
  const std::vector<Case> cases =
      random_sample(ranges, static_cast<int>(*count), static_cast<std::uint64_t>(*seed));
  for (const Case& one : cases) {
    for (const Choice& choice : one.choices) keep_place(choice, *given);
  }
  return cases;
}

ReportWish Reader::report(const toml::table& root) {
  ReportWish wish;
  const toml::node* node = root.get("report");
  if (node == nullptr) return wish;
  if (!node->is_table()) return fail(node, "report must be a table, as in [report]"), wish;
  const toml::table& table = *node->as_table();
  only_keys(table, "[report]", {"show", "panel", "curve"});
  wish.panel = word(table, "panel", "");
  wish.curve = word(table, "curve", "");
  if (table.get("show") == nullptr) return wish;
  wish.show.clear();
  for (const std::string& name : words(table, "show")) {
    const auto* found = std::find_if(std::begin(exhibit_names), std::end(exhibit_names),
                                     [&](const ExhibitName& one) { return name == one.word; });
    if (found != std::end(exhibit_names)) {
      wish.show.push_back(found->exhibit);
      continue;
    }
    std::string known;
    for (const ExhibitName& one : exhibit_names) known += joined({known.empty() ? "" : ", ", one.word});
    fail(table.get("show"), joined({"report.show does not know \"", name, "\"; it knows ", known}));
  }
  return wish;
}

std::string Reader::ending_event(const toml::table& root) {
  const std::string given = word(root, "until", "");
  std::string known;
  for (const EventKind kind :
       {EventKind::contact, EventKind::buckling, EventKind::straightening, EventKind::puncture,
        EventKind::second_buckling, EventKind::layer, EventKind::exit}) {
    if (given.empty() || given == name_of(kind)) return given;
    known += joined({known.empty() ? "" : ", ", name_of(kind)});
  }
  fail(root.get("until"), joined({"until does not know the event \"", given, "\"; it knows ", known}));
  return {};
}

Group Reader::read_group(const toml::table& root) {
  Group group;
  group.name = word(root, "name", std::filesystem::path(file()).stem().string());
  group.title = word(root, "title", group.name);
  group.text = word(root, "text", "");
  group.report = report(root);
  const std::string until = ending_event(root);
  const std::vector<Axis> grid_axes = axes(root);
  const std::vector<Case> named = named_runs(root), drawn = sample(root);
  if (!grid_axes.empty() && !drawn.empty())
    fail(root.get("sample"), "a study has [axes] or [sample], not both");
  double count = std::max<double>(1.0, static_cast<double>(named.size()));
  for (const Axis& axis : grid_axes) count *= static_cast<double>(axis.values.size());
  count *= std::max<double>(1.0, static_cast<double>(drawn.size()));
  if (count > most_runs)
    fail(root.get(drawn.empty() ? "axes" : "sample"),
         joined({"the study has more than ", std::to_string(most_runs), " runs; take fewer values"}));
  const std::optional<Scene> base = failed() ? std::nullopt : base_scene(root);
  if (!base) return group;

  std::set<std::string> names;
  for (Case& one : combined(named, drawn.empty() ? grid(grid_axes) : drawn)) {
    one.name = one.name.empty() ? "run" : fitted_name(one.name, longest_run_name);
    if (!names.insert(one.name).second)
      fail(nullptr, joined({"two runs are named ", one.name, "; names must differ"}));
    const Result<Scene> scene = io::with_settings(*base, as_settings(one.choices), folder());
    if (!scene) return fail(placed(scene.error())), group;
    if (const std::string said = trace_complaint(*scene); !said.empty())
      return fail(nullptr, joined({"run ", one.name, ": ", said})), group;
    for (const Choice& choice : one.choices) {
      if (std::find(group.varied.begin(), group.varied.end(), choice.key) == group.varied.end())
        group.varied.push_back(choice.key);
    }
    group.runs.push_back({std::move(one), *scene, until});
  }
  for (const std::string* key : {&group.report.panel, &group.report.curve}) {
    if (!key->empty() && std::find(group.varied.begin(), group.varied.end(), *key) == group.varied.end())
      fail(root.get("report"), joined({"report names ", *key, ", which does not vary in this study"}));
  }
  return group;
}

void Reader::read_includes(const toml::table& root, int depth, Study& study) {
  for (const char* key : {"base", "scene", "axes", "run", "sample", "report", "until"}) {
    if (root.get(key) != nullptr)
      fail(root.get(key), joined({"a study with include = [...] has no ", key,
                                  " of its own; put it into a file and include that"}));
  }
  if (depth >= deepest_include)
    fail(root.get("include"), "studies include each other too deeply, or in a circle");
  std::set<std::string> names;
  for (const std::string& name : words(root, "include")) {
    if (failed()) return;
    const std::string path = (std::filesystem::path(folder()) / name).lexically_normal().string();
    Result<Study> part = Reader(path, settings_).read(depth + 1);
    if (!part) return fail(part.error());
    for (Group& group : part->groups) {
      if (!names.insert(group.name).second)
        fail(root.get("include"), joined({"two included studies are named ", group.name}));
      study.groups.push_back(std::move(group));
    }
  }
}

Result<Study> Reader::read(int depth) {
  const Result<std::string> text = io::read_text(file(), longest_study_file);
  if (!text) return text.error();
  const Result<toml::table> parsed = io::parse_toml(*text, file());
  if (!parsed) return parsed.error();
  const toml::table& root = *parsed;
  only_keys(root, "a study",
            {"name", "title", "text", "include", "base", "scene", "axes", "run", "sample", "report", "until",
             "contradictions"});
  Study study;
  study.name = word(root, "name", std::filesystem::path(file()).stem().string());
  study.title = word(root, "title", study.name);
  study.text = word(root, "text", "");
  check_name(root, study.name);
  if (const toml::node* node = root.get("contradictions"); node != nullptr && !node->is_boolean())
    fail(node, "contradictions must be true or false");
  study.contradictions = root["contradictions"].value_or(false);
  if (root.get("include") != nullptr) {
    read_includes(root, depth, study);
  } else if (!failed()) {
    study.groups.push_back(read_group(root));
  }
  if (failed()) return error();
  return study;
}

bool every_run_chooses(const Study& study, const std::string& key) {
  for (const Group& group : study.groups)
    for (const Run& run : group.runs)
      if (std::none_of(run.chosen.choices.begin(), run.chosen.choices.end(),
                       [&](const Choice& choice) { return choice.key == key; }))
        return false;
  return true;
}

}  // namespace

Result<Study> read_study(const std::string& path, const std::vector<std::string>& settings) {
  Result<Study> study = Reader(path, settings).read(0);
  if (!study) return study;
  for (const std::string& setting : settings) {
    const std::string key = setting.substr(0, setting.find('='));
    if (every_run_chooses(*study, key))
      return Error{joined(
          {"--set ", setting, ": every run of this study has its own ", key, "; change it in ", path})};
  }
  return study;
}

std::string chosen_value(const Case& chosen, const std::string& key) {
  for (const Choice& choice : chosen.choices) {
    if (choice.key == key) return plain_text(choice.value);
  }
  return {};
}

}  // namespace acus::study
