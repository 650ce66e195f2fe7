// The messages of the Haply Inverse Service (docs.haply.co, "Simulation Channel", versions 3.1 to 3.5): JSON,
// one state for each command. Bytes alone; the wire is haply.h.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "acus/base/result.h"
#include "acus/base/vec.h"

namespace acus::haptics::haply {

// How the service names the components of a force: 3.1 to 3.4 `values`, 3.5 `vector`.
enum class Dialect { values, vector };

// What the service has said so far; a message that leaves something out changes nothing of it.
struct Inventory {
  std::string device;                 // the Inverse3's name
  Dialect dialect = Dialect::values;  // `vector` once an inventory had a session_id, which 3.5 sends alone
  bool present = false;               // in the last message
  bool calibrated = false;
  Vec3 position = Vec3::Zero();         // m
  Vec3 velocity = Vec3::Zero();         // m/s
  Mat3 orientation = Mat3::Identity();  // of a VerseGrip, where there is one
  unsigned buttons = 0;                 // of it
};

// Takes a message of the service. Where `known.device` is empty the first Inverse3 of the message is chosen.
// An error says what the message is, and `known` is then as before.
std::optional<Error> read_message(std::string_view json, Inventory& known);

// The message that asks for a force [N, finite], exact as floats. The first one of a session also says who we
// are.
std::string force_message(const Inventory& known, const Vec3& force, bool first);

}  // namespace acus::haptics::haply
