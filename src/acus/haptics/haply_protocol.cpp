#include "acus/haptics/haply_protocol.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace acus::haptics::haply {
namespace {

using nlohmann::json;

// What the service sends is five deep; deeper parts are left out, so that no message makes us go deep.
constexpr int deepest = 8;

// A message that is none; caught in read_message alone.
struct Malformed {
  std::string what;
};

const json* member(const json& object, const char* name) {
  const auto found = object.find(name);
  return found == object.end() || found->is_null() ? nullptr : &*found;
}

double number(const json& object, const char* name) {
  const json* value = member(object, name);
  if (!value || !value->is_number()) throw Malformed{std::string(name) + " is no number"};
  return value->get<double>();
}

void read_vector(const json& state, const char* name, Vec3& out) {
  if (const json* vector = member(state, name))
    out = {number(*vector, "x"), number(*vector, "y"), number(*vector, "z")};
}

void read_flag(const json& object, const char* name, bool& out) {
  if (const json* flag = member(object, name); flag && flag->is_boolean()) out = flag->get<bool>();
}

void read_orientation(const json& state, Mat3& out) {
  const json* q = member(state, "orientation");
  if (!q) return;
  const Eigen::Quaterniond turn(number(*q, "w"), number(*q, "x"), number(*q, "y"), number(*q, "z"));
  constexpr double hardly = 1e-6;
  if (turn.norm() > hardly) out = turn.normalized().toRotationMatrix();
}

// A VerseGrip has one button, a wireless one three.
void read_buttons(const json& state, unsigned& out) {
  bool down = (out & 1U) != 0;
  read_flag(state, "button", down);
  unsigned buttons = (out & ~1U) | (down ? 1U : 0U);
  if (const json* several = member(state, "buttons")) {
    constexpr std::array names{"a", "b", "c"};
    for (std::size_t i = 0; i < names.size(); ++i) {
      down = (buttons >> i & 1U) != 0;
      read_flag(*several, names[i], down);
      buttons = (buttons & ~(1U << i)) | (down ? 1U << i : 0U);
    }
  }
  out = buttons;
}

// Names go into our own messages as they came, so they must be plain.
bool plain(const std::string& name) {
  constexpr std::size_t longest = 64;
  constexpr std::string_view allowed = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ-_.";
  return !name.empty() && name.size() <= longest && name.find_first_not_of(allowed) == std::string::npos;
}

std::string name_of(const json& device) {
  const json* name = member(device, "device_id");
  if (!name || !name->is_string() || !plain(name->get<std::string>()))
    throw Malformed{"an Inverse3 has no plain device_id"};
  return name->get<std::string>();
}

void read_inverse3(const json& device, Inventory& known) {
  if (const json* state = member(device, "state")) {
    read_vector(*state, "cursor_position", known.position);
    read_vector(*state, "cursor_velocity", known.velocity);
  }
  if (const json* status = member(device, "status")) read_flag(*status, "calibrated", known.calibrated);
}

void read_devices(const json& message, Inventory& known) {
  known.present = false;
  const json* devices = member(message, "inverse3");
  if (devices && devices->is_array())
    for (const json& device : *devices) {
      const std::string name = name_of(device);
      if (known.device.empty()) known.device = name;
      if (name != known.device) continue;
      known.present = true;
      read_inverse3(device, known);
    }
  for (const char* kind : {"verse_grip", "wireless_verse_grip"}) {
    const json* grips = member(message, kind);
    if (!grips || !grips->is_array() || grips->empty()) continue;
    const json* state = member(grips->front(), "state");
    if (!state) continue;
    read_orientation(*state, known.orientation);
    read_buttons(*state, known.buttons);
  }
}

}  // namespace

std::optional<Error> read_message(std::string_view text, Inventory& known) {
  const auto not_too_deep = [](int depth, json::parse_event_t, json&) { return depth <= deepest; };
  const json message = json::parse(text, not_too_deep, false);
  if (!message.is_object()) return Error{"a message of the service is no JSON object"};
  try {
    Inventory next = known;
    read_devices(message, next);
    if (member(message, "session_id")) next.dialect = Dialect::vector;
    known = std::move(next);
  } catch (const Malformed& malformed) {
    return Error{"a message of the service makes no sense: " + malformed.what};
  } catch (const json::exception& wrong) {
    return Error{"a message of the service makes no sense: " + std::string(wrong.what())};
  }
  return std::nullopt;
}

std::string force_message(const Inventory& known, const Vec3& force, bool first) {
  constexpr const char* session = R"("session":{"configure":{"profile":{"name":"acus"}}},)";
  std::array<char, 512> text{};  // the longest name and numbers take 300
  std::snprintf(
      text.data(), text.size(),
      R"({%s"inverse3":[{"device_id":"%s","commands":{"set_cursor_force":{"%s":{"x":%.9g,"y":%.9g,"z":%.9g}}}}]})",
      first ? session : "", known.device.c_str(), known.dialect == Dialect::vector ? "vector" : "values",
      static_cast<float>(force.x()), static_cast<float>(force.y()), static_cast<float>(force.z()));
  return text.data();
}

}  // namespace acus::haptics::haply
