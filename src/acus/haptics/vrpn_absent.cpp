// Stands in the place of vrpn_device.cpp where VRPN was not found.
#include "acus/haptics/vrpn_device.h"

namespace acus::haptics {

std::string vrpn_missing() {
  return "not built in: acus was built without VRPN; install vrpn (github.com/vrpn/vrpn) and build again "
         "with "
         "`VRPN_ROOT=FOLDER ./dev build`";
}

Result<std::unique_ptr<Device>> open_vrpn(const std::string&) { return Error{vrpn_missing()}; }

}  // namespace acus::haptics
