// Who may speak to a server on this machine. Listening on 127.0.0.1 alone keeps out other machines, but every
// page in the browser of this one can reach it; so whoever comes must name us as the host (no other name that
// was bent to this address), come from a page of ours, and know a secret that only the printed address holds.
#pragma once

#include <string>

#include "acus/net/web_socket.h"

namespace acus::net {

// 32 random bytes as 64 hexadecimal digits. Aborts where the system has no randomness.
std::string new_token();

// Whether the host is 127.0.0.1, [::1] or localhost, with this port.
bool names_us(const WebRequest& request, unsigned short port);

// Whether a WebSocket may be opened: the host as above, the origin that very host, and `token=...` in the
// target. Takes as long for a wrong token as for the right one.
bool may_lead(const WebRequest& request, unsigned short port, const std::string& token);

}  // namespace acus::net
