#include "acus/net/local_access.h"

#include <sys/random.h>

#include <array>
#include <cstdlib>
#include <string_view>

namespace acus::net {
namespace {

// The value of `token` in the query of a target; empty without one.
std::string_view token_in(std::string_view target) {
  const std::size_t query = target.find('?');
  if (query == std::string_view::npos) return {};
  std::string_view rest = target.substr(query + 1);
  rest = rest.substr(0, rest.find('#'));
  constexpr std::string_view name = "token=";
  while (!rest.empty()) {
    const std::size_t end = rest.find('&');
    const std::string_view part = rest.substr(0, end);
    if (part.starts_with(name)) return part.substr(name.size());
    if (end == std::string_view::npos) break;
    rest.remove_prefix(end + 1);
  }
  return {};
}

bool same_secret(std::string_view given, std::string_view secret) {
  unsigned difference = given.size() == secret.size() ? 0 : 1;
  for (std::size_t i = 0; i < secret.size(); ++i)
    difference |=
        static_cast<unsigned char>(secret[i]) ^ static_cast<unsigned char>(i < given.size() ? given[i] : 0);
  return difference == 0;
}

}  // namespace

std::string new_token() {
  std::array<unsigned char, 32> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) std::abort();
  constexpr const char* digits = "0123456789abcdef";
  std::string token;
  for (const unsigned char byte : bytes) {
    token += digits[byte >> 4U];
    token += digits[byte & 15U];
  }
  return token;
}

bool names_us(const WebRequest& request, unsigned short port) {
  std::string at_port(1, ':');  // (":" + a temporary string sets off a false warning of g++ 12)
  at_port += std::to_string(port);
  for (const char* name : {"127.0.0.1", "[::1]", "localhost"})
    if (request.host == std::string(name).append(at_port)) return true;
  return false;
}

bool may_lead(const WebRequest& request, unsigned short port, const std::string& token) {
  return names_us(request, port) && request.origin == std::string("http://").append(request.host) &&
         !token.empty() && same_secret(token_in(request.target), token);
}

}  // namespace acus::net
