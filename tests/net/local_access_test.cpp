// Who comes in and who does not, first as a function and then over a socket.
#include "acus/net/local_access.h"

#include <gtest/gtest.h>

#include <set>

#include "raw_socket.h"

namespace acus::net {
namespace {

const std::string token("000000000000000000000000000000000000000000000000000000000000beef");

struct Case {
  const char* what;
  std::string host, origin, target;
  bool enters = false;
};

// For a server at `port`.
std::vector<Case> cases(const std::string& port) {
  const std::string here = "127.0.0.1:" + port, name = "localhost:" + port, six = "[::1]:" + port;
  const std::string right = "/socket?token=" + token;
  return {
      {"the page itself", here, "http://" + here, right, true},
      {"the page by name", name, "http://" + name, right, true},
      {"the page by its address of version 6", six, "http://" + six, right, true},
      {"other things in the query", here, "http://" + here, "/socket?a=1&token=" + token + "&b=2", true},
      // The host.
      {"no host", "", "http://" + here, right},
      {"another name that was bent to us", "evil.example:" + port, "http://evil.example:" + port, right},
      {"another name, our origin", "evil.example:" + port, "http://" + here, right},
      {"another port", "127.0.0.1:1", "http://127.0.0.1:1", right},
      {"no port", "127.0.0.1", "http://127.0.0.1", right},
      {"all interfaces", "0.0.0.0:" + port, "http://0.0.0.0:" + port, right},
      {"another address of the loop", "127.0.0.2:" + port, "http://127.0.0.2:" + port, right},
      {"an address as a number", "2130706433:" + port, "http://2130706433:" + port, right},
      {"an address cut short", "127.1:" + port, "http://127.1:" + port, right},
      {"a name that begins like ours", "localhost.evil.example:" + port,
       "http://localhost.evil.example:" + port, right},
      {"a name that ends like ours", "evil-localhost:" + port, "http://evil-localhost:" + port, right},
      {"a dot at the end", "localhost.:" + port, "http://localhost.:" + port, right},
      {"capitals", "LOCALHOST:" + port, "http://LOCALHOST:" + port, right},
      {"spaces", here + " ", "http://" + here + " ", right + "x"},
      {"a user in the host", "a@" + here, "http://a@" + here, right},
      {"two hosts", here + "," + name, "http://" + here, right},
      {"a port with zeros", "127.0.0.1:0" + port, "http://127.0.0.1:0" + port, right},
      // The origin.
      {"no origin", here, "", right},
      {"a page from a file", here, "null", right},
      {"a page on another port", here, "http://127.0.0.1:8000", right},
      {"a page with our name, not our address", here, "http://" + name, right},
      {"a page with our address, not our name", name, "http://" + here, right},
      {"a page of another site", here, "http://evil.example", right},
      {"a secure page", here, "https://" + here, right},
      {"a socket for an origin", here, "ws://" + here, right},
      {"an origin without its scheme", here, here, right},
      {"an origin with a path", here, "http://" + here + "/", right},
      {"an origin that begins like ours", here, "http://" + here + ".evil.example", right},
      {"an origin that ends like ours", here, "http://evil.example#http://" + here, right},
      {"an extension", here, "chrome-extension://abcdefgh", right},
      {"two origins", here, "http://" + here + " http://evil.example", right},
      // The token.
      {"no token", here, "http://" + here, "/socket"},
      {"an empty token", here, "http://" + here, "/socket?token="},
      {"a part of the token", here, "http://" + here, std::string("/socket?token=").append(token, 0, 63)},
      {"more than the token", here, "http://" + here, right + "0"},
      {"a wrong token", here, "http://" + here, std::string("/socket?token=").append(64, '0')},
      {"the token in capitals", here, "http://" + here,
       std::string("/socket?token=").append(60, '0').append("BEEF")},
      {"another name for it", here, "http://" + here, "/socket?mytoken=" + token},
      {"the token as a path", here, "http://" + here, "/token=" + token},
      {"the token behind a hash", here, "http://" + here, "/socket?x=1#token=" + token},
      {"a wrong token before the right one", here, "http://" + here, "/socket?token=1&token=" + token},
      {"escapes for the token", here, "http://" + here, std::string("/socket?token=%30").append(token, 1)},
  };
}

TEST(LocalAccess, lets_in_who_names_us_comes_from_us_and_knows_the_token) {
  ASSERT_GE(cases("7").size(), 40U);
  for (const Case& one : cases("8765"))
    EXPECT_EQ(may_lead({"GET", one.target, one.host, one.origin}, 8765, token), one.enters) << one.what;
  EXPECT_FALSE(may_lead({"GET", "/socket?token=", "localhost:1", "http://localhost:1"}, 1, ""));
}

TEST(LocalAccess, is_what_a_server_goes_by) {
  std::string port;
  WebService service;
  service.answer = [](const WebRequest&) { return WebAnswer(); };
  service.admits = [&port](const WebRequest& request) {
    return may_lead(request, static_cast<unsigned short>(std::stoi(port)), token);
  };
  service.serve = [](WebSocket&, const auto&) {};
  const auto server = WebServer::start(0, std::move(service)).value();
  port = std::to_string(server->port());
  for (const Case& one : cases(port)) {
    const RawSocket raw(server->port());
    raw.write("GET " + one.target + " HTTP/1.1\r\n" + (one.host.empty() ? "" : "Host: " + one.host + "\r\n") +
              (one.origin.empty() ? "" : "Origin: " + one.origin + "\r\n") +
              "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
              "Sec-WebSocket-Version: 13\r\n\r\n");
    EXPECT_EQ(raw.read_to("\r\n").substr(0, 12), one.enters ? "HTTP/1.1 101" : "HTTP/1.1 403") << one.what;
  }
}

TEST(LocalAccess, never_gives_the_same_token_twice) {
  std::set<std::string> tokens;
  for (int i = 0; i < 1000; ++i) {
    const std::string one = new_token();
    EXPECT_EQ(one.size(), 64U);
    EXPECT_EQ(one.find_first_not_of("0123456789abcdef"), std::string::npos);
    tokens.insert(one);
  }
  EXPECT_EQ(tokens.size(), 1000U);
}

}  // namespace
}  // namespace acus::net
