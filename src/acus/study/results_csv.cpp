#include "acus/study/results_csv.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "acus/base/decimal.h"
#include "acus/study/markup.h"

namespace acus::study {
namespace {

// A cell of comma-separated text (RFC 4180).
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (char c : text) out.append(c == '"' ? 2 : 1, c);
  return out + "\"";
}

std::string value(const nlohmann::json& json, const char* pointer) {
  const nlohmann::json::json_pointer at(pointer);
  if (!json.contains(at)) return {};
  const nlohmann::json& found = json.at(at);
  if (found.is_string()) return found.get<std::string>();
  if (found.is_number_integer()) return std::to_string(found.get<long long>());
  return found.is_number() ? decimal_text(found.get<double>()) : std::string();
}

struct Field {
  const char* name;
  std::string (*of)(const RunRecord&);
};

#define ACUS_SUMMARY(name, pointer)                                     \
  Field {                                                               \
    name, [](const RunRecord& r) { return value(*r.summary, pointer); } \
  }

template <double EventRecord::*member>
std::string of_event(const RunRecord& record, const char* event) {
  const EventRecord* found = find_event(record, event);
  return found == nullptr ? std::string() : decimal_text(found->*member);
}

// The closed form on the free length at the first buckling of that kind.
std::string predicted(const RunRecord& record, const char* event) {
  if (!record.summary->contains("bucklings")) return {};
  for (const auto& buckling : record.summary->at("bucklings")) {
    if (value(buckling, "/event") == event) return value(buckling, "/predicted_load_N");
  }
  return {};
}

const Field fields[] = {
    ACUS_SUMMARY("outcome", "/outcome"),
    ACUS_SUMMARY("health", "/health"),
    {"buckling_load_N", [](const RunRecord& r) { return of_event<&EventRecord::hand_force>(r, "buckling"); }},
    {"buckling_predicted_N", [](const RunRecord& r) { return predicted(r, "buckling"); }},
    {"buckling_travel_m",
     [](const RunRecord& r) { return of_event<&EventRecord::hand_travel>(r, "buckling"); }},
    {"puncture_force_N",
     [](const RunRecord& r) { return of_event<&EventRecord::hand_force>(r, "puncture"); }},
    {"puncture_travel_m",
     [](const RunRecord& r) { return of_event<&EventRecord::hand_travel>(r, "puncture"); }},
    {"second_buckling_load_N",
     [](const RunRecord& r) { return of_event<&EventRecord::hand_force>(r, "second_buckling"); }},
    {"second_buckling_predicted_N", [](const RunRecord& r) { return predicted(r, "second_buckling"); }},
    {"second_buckling_free_length_m",
     [](const RunRecord& r) { return of_event<&EventRecord::free_length>(r, "second_buckling"); }},
    ACUS_SUMMARY("peak_hand_force_N", "/peak_hand_force_N"),
    ACUS_SUMMARY("peak_tip_force_N", "/peak_tip_force_N"),
    ACUS_SUMMARY("peak_deflection_m", "/peak_deflection_m"),
    ACUS_SUMMARY("peak_tip_depth_m", "/peak_tip_depth_m"),
    ACUS_SUMMARY("peak_tip_aside_m", "/peak_tip_aside_m"),
    ACUS_SUMMARY("work_hand_J", "/energy/work_hand_J"),
    ACUS_SUMMARY("relative_energy_residual", "/energy/relative_residual"),
    ACUS_SUMMARY("peak_energy_force_gap_N", "/peak_energy_force_gap_N"),
    ACUS_SUMMARY("tetrahedra", "/mesh/tetrahedra"),
    ACUS_SUMMARY("simulated_time_s", "/simulated_time_s"),
    ACUS_SUMMARY("steps", "/steps"),
    ACUS_SUMMARY("state_hash", "/state_hash"),
};

#undef ACUS_SUMMARY

std::vector<std::string> varied_keys(const std::vector<GroupRecords>& groups) {
  std::vector<std::string> keys;
  for (const GroupRecords& group : groups) {
    for (const std::string& key : group.group->varied) {
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    }
  }
  return keys;
}

}  // namespace

std::string results_csv(const std::vector<GroupRecords>& groups) {
  const std::vector<std::string> keys = varied_keys(groups);
  std::string text = "study,run";
  for (const std::string& key : keys) text += joined({",", cell(key)});
  for (const Field& field : fields) text += joined({",", field.name});
  text += "\n";
  for (const GroupRecords& group : groups) {
    for (const RunRecord& record : group.runs) {
      text += joined({cell(group.group->name), ",", cell(record.chosen.name)});
      for (const std::string& key : keys) text += joined({",", cell(chosen_value(record.chosen, key))});
      for (const Field& field : fields) text += joined({",", cell(field.of(record))});
      text += "\n";
    }
  }
  return text;
}

}  // namespace acus::study
