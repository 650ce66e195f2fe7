#include "acus/haptics/backends.h"

#include <vector>

#include "acus/haptics/force_dimension.h"
#include "acus/haptics/haply.h"
#include "acus/haptics/openhaptics.h"
#include "acus/haptics/recorded_device.h"
#include "acus/haptics/simulated_device.h"
#include "acus/haptics/vrpn_device.h"
#include "acus/io/spelling.h"

namespace acus::haptics {

std::span<const Backend> backends() {
  const auto never_missing = [] { return std::string(); };
  static const std::vector<Backend> all = {
      {"simulated", "a device and a hand that are not there", "no hardware to test", never_missing,
       open_simulated},
      {"recorded", "the hand of a recording, as in recorded:hand.acusrec; the force goes nowhere",
       "no hardware to test", never_missing, open_recorded},
      {"haply", "Haply Inverse3, through its Inverse Service", emulator_only, haply_missing, open_haply},
      {"openhaptics", "3D Systems Touch and Phantom, through OpenHaptics", emulator_only, openhaptics_missing,
       open_openhaptics},
      {"force_dimension", "Force Dimension omega and its sisters", emulator_only, force_dimension_missing,
       open_force_dimension},
      {"vrpn", "a device behind a VRPN server, vrpn:NAME@HOST", emulator_only, vrpn_missing, open_vrpn},
  };
  return all;
}

Result<OpenDevice> open_device(const std::string& name) {
  const std::size_t colon = name.find(':');
  const std::string backend = name.substr(0, colon);
  std::vector<std::string> names;
  for (const Backend& known : backends()) {
    if (known.name == backend) {
      Result<std::unique_ptr<Device>> device =
          known.open(colon == std::string::npos ? "" : name.substr(colon + 1));
      if (!device) return device.error();
      return OpenDevice{&known, std::move(*device)};
    }
    names.push_back(known.name);
  }
  const std::string near = io::nearest_word(backend, names);
  return Error{"there is no device '" + backend + "'; " +
               (near.empty() ? "`acus device list` shows what there is" : "did you mean '" + near + "'?")};
}

}  // namespace acus::haptics
