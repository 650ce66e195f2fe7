// Which device on which VRPN server is meant, and whether anybody listens there.
#pragma once

#include <optional>
#include <string>

#include "acus/base/result.h"

namespace acus::haptics {

struct VrpnAddress {
  std::string name;  // of the device
  std::string host;  // a name or an IPv4 number
  int port = 3883;   // VRPN's own
};

// From "NAME@HOST" or "NAME@HOST:PORT". VRPN's other forms of a host (files to play back, programs to start
// on far machines, connections without order) are refused.
Result<VrpnAddress> parse_vrpn_address(const std::string& text);

// "HOST:PORT"
std::string server_of(const VrpnAddress& address);

// Says why a connection cannot be made within `patience` [s], if it cannot. VRPN itself would wait for
// minutes.
std::optional<Error> unreachable(const VrpnAddress& address, double patience);

}  // namespace acus::haptics
