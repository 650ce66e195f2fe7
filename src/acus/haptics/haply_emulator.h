// An emulator of the Haply Inverse Service with an Inverse3 and a hand in it that are not there: a real
// WebSocket with the messages of the service, as its documentation shows them, and its faults on demand. No
// proof about the real one.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "acus/haptics/handle.h"
#include "acus/haptics/haply_protocol.h"

namespace acus::haptics {

enum class HaplyFaultKind {
  late,          // replies come 8 ms late
  dropped,       // every fifth reply does not come
  malformed,     // every fifth reply is cut in half
  uncalibrated,  // the device says that it is not calibrated
  unplugged,     // the device is not among those that are there
  silent,        // no reply comes
};

struct HaplyFault {
  HaplyFaultKind kind = HaplyFaultKind::late;
  double from = 0.0, to = 0.0;  // s, since the first message of a client
};

// "late@3" or "late@3:0.5": from 3 s on, for 0.5 s (1 s where it is not said). Error: one sentence.
Result<HaplyFault> haply_fault(const std::string& text);

// What the emulator was told, and what it was then.
struct HaplyCommand {
  double time = 0.0;             // s, since the first message of a client
  Vec3 force = Vec3::Zero();     // N
  Vec3 position = Vec3::Zero();  // m, true
};

struct HaplyEmulatorSettings {
  unsigned short port = 10001;  // 0: any that is free
  haply::Dialect dialect = haply::Dialect::vector;
  HandModel hand = light_grip;
  // Where the hand wants to be, m along the device's forward direction, at a time in s since the first
  // message.
  std::function<double(double)> plan;
  std::vector<HaplyFault> faults;
};

class HaplyEmulator {
 public:
  // Error: the port is taken.
  static Result<std::unique_ptr<HaplyEmulator>> start(HaplyEmulatorSettings settings);
  ~HaplyEmulator();

  unsigned short port() const;
  // The commands so far, of a quarter of an hour at most; and how many came.
  std::vector<HaplyCommand> commands() const;
  long came() const;
  // The messages of the first client and the answers to them, in order; "< " before what came, "> " before
  // what was sent. The first few hundred.
  std::vector<std::string> transcript() const;

 private:
  class Service;
  explicit HaplyEmulator(std::unique_ptr<Service> service);
  std::unique_ptr<Service> service_;
};

}  // namespace acus::haptics
