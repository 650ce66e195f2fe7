#include "acus/view/command.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "acus/base/decimal.h"

namespace acus::view {
namespace {

using Json = nlohmann::json;

// Counted before parsing, so that no text can make the parser build a deep tree.
bool too_deep(std::string_view text) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string && c == '\\')
      ++i;
    else if (c == '"')
      in_string = !in_string;
    else if (!in_string && (c == '{' || c == '['))
      if (++depth > deepest_command) return true;
    if (!in_string && (c == '}' || c == ']')) --depth;
  }
  return false;
}

// Members of one command; the first that is wrong is kept as a sentence.
class Members {
 public:
  Members(const Json& json, std::string type) : json_(json), type_(std::move(type)) {}

  double number(const char* name, double least, double most) {
    const auto at = json_.find(name);
    const double value = at != json_.end() && at->is_number() ? at->get<double>() : NAN;
    if (!(value >= least && value <= most))
      complain(name, "must be a number from " + decimal_text(least) + " to " + decimal_text(most));
    return value;
  }

  int whole(const char* name, int least, int most) {
    const double value = number(name, least, most);
    if (value != std::floor(value)) complain(name, "must be a whole number");
    return wrong_.empty() ? static_cast<int>(value) : least;
  }

  SceneChoice scene() {
    SceneChoice choice;
    if (const auto at = json_.find("scene"); at != json_.end() && at->is_string())
      choice.toml = at->get<std::string>();
    else
      complain("scene", "must be the TOML text of a scene");
    const auto settings = json_.find("settings");
    if (settings == json_.end() || settings->is_null()) return choice;
    if (!settings->is_array()) complain("settings", list_of_settings);
    for (const Json& setting : *settings)
      if (setting.is_string())
        choice.settings.push_back(setting.get<std::string>());
      else
        complain("settings", list_of_settings);
    return choice;
  }

  Result<Command> finished(Command command) const {
    if (!wrong_.empty()) return Error{wrong_};
    return command;
  }

 private:
  static constexpr const char* list_of_settings = "must be a list of texts, as in [\"needle.length_mm=150\"]";

  void complain(const std::string& name, const std::string& what) {
    if (wrong_.empty()) wrong_ = "the member \"" + name + "\" of the command \"" + type_ + "\" " + what;
  }

  const Json& json_;
  std::string type_;
  std::string wrong_;
};

Result<Command> command_of(const std::string& type, Members members) {
  constexpr double farthest = 10.0;  // m and m/s: beyond every needle and every hand
  constexpr int most_steps = 100000;
  constexpr double slowest = 1e-4;
  if (type == "start") return members.finished(Start{members.scene()});
  if (type == "check") return members.finished(Check{members.scene()});
  if (type == "push") return members.finished(Push{members.number("travel_m", -farthest, farthest)});
  if (type == "steady") return members.finished(Steady{members.number("speed_m_s", -farthest, farthest)});
  if (type == "pause") return Command(Pause{});
  if (type == "resume") return Command(Resume{});
  if (type == "step") return members.finished(Step{members.whole("steps", 1, most_steps)});
  if (type == "rate") return members.finished(Rate{members.number("factor", slowest, 1.0)});
  if (type == "arm") return Command(Arm{});
  if (type == "disarm") return Command(Disarm{});
  if (type == "hold") return Command(Hold{});
  constexpr std::size_t worth_quoting = 40;
  return Error{"there is no command \"" + type.substr(0, worth_quoting) +
               "\"; there are start, check, push, steady, pause, resume, step, rate, arm, disarm and hold"};
}

}  // namespace

Result<Command> parse_command(std::string_view text) {
  if (text.size() > longest_command)
    return Error{"the command is longer than the " + std::to_string(longest_command) + " bytes it may have"};
  if (too_deep(text))
    return Error{"the command has more than " + std::to_string(deepest_command) +
                 " levels of brackets, and needs no more than two"};
  const Json json = Json::parse(text.begin(), text.end(), nullptr, /*allow_exceptions=*/false);
  if (json.is_discarded()) return Error{"the command is not JSON"};
  const auto type = json.is_object() ? json.find("type") : json.end();
  if (!json.is_object() || type == json.end() || !type->is_string())
    return Error{"a command is a JSON object with a \"type\", as in {\"type\": \"pause\"}"};
  const std::string name = type->get<std::string>();
  return command_of(name, Members(json, name));
}

}  // namespace acus::view
