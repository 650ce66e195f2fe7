#include "acus/haptics/vrpn_address.h"

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>

namespace acus::haptics {
namespace {

bool made_of(const std::string& text, const char* characters) {
  return !text.empty() && text.find_first_not_of(characters) == std::string::npos;
}

// 0 when somebody listens there; else what the system says, as errno has it.
int knock(const addrinfo& at, double patience) {
  const int knocking = socket(at.ai_family, at.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, at.ai_protocol);
  if (knocking < 0) return errno;
  int wrong = connect(knocking, at.ai_addr, at.ai_addrlen) == 0 ? 0 : errno;
  if (wrong == EINPROGRESS) {
    pollfd waiting{knocking, POLLOUT, 0};
    socklen_t size = sizeof wrong;
    if (poll(&waiting, 1, static_cast<int>(1e3 * patience)) <= 0)
      wrong = ETIMEDOUT;
    else if (getsockopt(knocking, SOL_SOCKET, SO_ERROR, &wrong, &size) != 0)
      wrong = errno;
  }
  close(knocking);
  return wrong;
}

}  // namespace

Result<VrpnAddress> parse_vrpn_address(const std::string& text) {
  constexpr const char* digits = "0123456789";
  constexpr const char* of_a_host = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-";
  constexpr int largest_port = 65535;
  const Error refusal{"'" + text +
                      "' names no VRPN device: say vrpn:NAME@HOST, like vrpn:Phantom0@localhost"};
  const std::size_t at = text.rfind('@');
  if (at == std::string::npos || at == 0) return refusal;
  VrpnAddress address;
  address.name = text.substr(0, at);
  const std::size_t colon = text.find(':', at);
  address.host = text.substr(at + 1, colon == std::string::npos ? colon : colon - at - 1);
  if (!made_of(address.host, of_a_host)) return refusal;
  if (colon == std::string::npos) return address;
  const std::string port = text.substr(colon + 1);
  if (!made_of(port, digits) || port.size() > 5) return refusal;
  address.port = std::stoi(port);
  if (address.port < 1 || address.port > largest_port) return refusal;
  return address;
}

std::string server_of(const VrpnAddress& address) {
  return address.host + ":" + std::to_string(address.port);
}

std::optional<Error> unreachable(const VrpnAddress& address, double patience) {
  addrinfo hints{};
  hints.ai_family = AF_INET;  // VRPN knows no other
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int unknown = getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &hints, &found);
  if (unknown != 0)
    return Error{"there is no machine '" + address.host + "' (" + gai_strerror(unknown) + ")"};
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> at(found, freeaddrinfo);
  const int wrong = knock(*at, patience);
  if (wrong == 0) return std::nullopt;
  return Error{"no VRPN server answers at " + server_of(address) + " (" + std::strerror(wrong) +
               "): is it running there?"};
}

}  // namespace acus::haptics
