// A connection to this machine without any library.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

namespace acus::net {

class RawSocket {
 public:
  explicit RawSocket(unsigned short port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~RawSocket() { ::close(socket_); }
  void write(const std::string& bytes) const { EXPECT_TRUE(sends(bytes)); }
  // False where the other side takes no more.
  bool sends(const std::string& bytes) const {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }
  // Whether the other side closes the connection within so many seconds; what it said before stays unread.
  bool is_closed_within(double seconds) const {
    pollfd asked{socket_, POLLRDHUP, 0};
    return ::poll(&asked, 1, static_cast<int>(1e3 * seconds)) > 0;
  }
  // Until `end` has come, or the other side is done.
  std::string read_to(const std::string& end) const {
    std::string all;
    char byte = 0;
    while (all.find(end) == std::string::npos && ::recv(socket_, &byte, 1, 0) == 1) all += byte;
    return all;
  }

 private:
  int socket_;
};

// What a page asks for at `port` to open its WebSocket.
inline std::string socket_request(unsigned short port, const std::string& token) {
  const std::string host = "127.0.0.1:" + std::to_string(port);
  return "GET /socket?token=" + token + " HTTP/1.1\r\nHost: " + host + "\r\nOrigin: http://" + host +
         "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: "
         "dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n";
}

// Short frames as a client sends them, masked by zeros.
inline std::string frame(char kind, const std::string& text) {
  EXPECT_LT(text.size(), 126U);
  return kind + std::string(1, static_cast<char>(0x80U | text.size())) + std::string(4, '\0') + text;
}
inline std::string text_frame(const std::string& text) { return frame('\x81', text); }
inline std::string ping_frame() { return frame('\x89', ""); }

}  // namespace acus::net
