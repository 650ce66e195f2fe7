// Both ends over real sockets, and the server against the bytes of RFC 6455.
#include "acus/net/web_socket.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace acus::net {
namespace {

using Received = WebSocket::Received;
constexpr double long_enough = 20.0;  // s, on a machine that does much else

// Sends back what it gets; "leave" makes it go.
WebService echo() {
  WebService service;
  service.get = [](const std::string& target) {
    return target == "/there" ? R"({"is":true})" : std::string();
  };
  service.serve = [](WebSocket& client, const std::function<bool()>& stopping) {
    std::string message;
    while (!stopping()) {
      const Received received = client.receive(message, 0.01);
      if (received == Received::closed || (received == Received::message && message == "leave")) return;
      if (received == Received::message) client.send(message, long_enough);
    }
  };
  return service;
}

// A connection without any library.
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
  void write(const std::string& bytes) const {
    EXPECT_EQ(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
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

std::unique_ptr<WebServer> start(WebService service) {
  Result<std::unique_ptr<WebServer>> server = WebServer::start(0, std::move(service));
  EXPECT_TRUE(server) << (server ? "" : server.error().sentence);
  return std::move(*server);
}

std::unique_ptr<WebSocket> connect_to(const WebServer& server) {
  Result<std::unique_ptr<WebSocket>> socket = WebSocket::connect("127.0.0.1", server.port(), long_enough);
  EXPECT_TRUE(socket) << (socket ? "" : socket.error().sentence);
  return std::move(*socket);
}

TEST(WebSocket, carries_messages_both_ways) {
  const auto server = start(echo());
  const auto socket = connect_to(*server);
  std::string message;
  for (const std::string& text : {std::string("{}"), std::string(), std::string(500'000, 'x')}) {
    ASSERT_TRUE(socket->send(text, long_enough));
    ASSERT_EQ(socket->receive(message, long_enough), Received::message);
    EXPECT_EQ(message, text);
  }
}

TEST(WebSocket, keeps_what_came_until_it_is_asked_for) {
  const auto server = start(echo());
  const auto socket = connect_to(*server);
  std::string message;
  for (const char* text : {"one", "two", "three"}) ASSERT_TRUE(socket->send(text, long_enough));
  for (const char* text : {"one", "two", "three"}) {
    ASSERT_EQ(socket->receive(message, long_enough), Received::message);
    EXPECT_EQ(message, text);
  }
  EXPECT_EQ(socket->receive(message, 0.0), Received::nothing);
}

TEST(WebSocket, takes_what_is_there_without_patience) {
  const auto server = start(echo());
  const auto socket = connect_to(*server);
  ASSERT_TRUE(socket->send("now", long_enough));
  std::string message;
  Received received = Received::nothing;
  for (int i = 0; i < 20'000 && received == Received::nothing; ++i) {
    received = socket->receive(message, 0.0);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(received, Received::message);
}

TEST(WebSocket, knows_when_the_other_side_has_gone) {
  const auto server = start(echo());
  const auto socket = connect_to(*server);
  ASSERT_TRUE(socket->send("leave", long_enough));
  std::string message;
  EXPECT_EQ(socket->receive(message, long_enough), Received::closed);
  EXPECT_EQ(socket->receive(message, long_enough), Received::closed);
  EXPECT_FALSE(socket->send("still there?", long_enough));
}

TEST(WebSocket, takes_no_message_beyond_a_megabyte) {
  const auto server = start(echo());
  const auto socket = connect_to(*server);
  std::string message;
  socket->send(std::string((1U << 20U) + 1, 'x'), long_enough);
  EXPECT_EQ(socket->receive(message, long_enough), Received::closed);
  EXPECT_EQ(connect_to(*server)->receive(message, 0.01), Received::nothing);  // others are served on
}

TEST(WebSocket, says_in_a_sentence_that_nobody_answers) {
  unsigned short free_port = 0;
  { free_port = start(echo())->port(); }
  const auto nobody = WebSocket::connect("127.0.0.1", free_port, long_enough);
  ASSERT_FALSE(nobody);
  EXPECT_NE(nobody.error().sentence.find("nobody answers at 127.0.0.1:" + std::to_string(free_port)),
            std::string::npos);
  EXPECT_FALSE(WebSocket::connect("no address", 1, long_enough));
}

TEST(WebServer, refuses_a_port_that_is_taken) {
  const auto server = start(echo());
  const auto second = WebServer::start(server->port(), echo());
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().sentence.find(std::to_string(server->port())), std::string::npos);
}

TEST(WebServer, serves_several_and_ends_while_they_are_there) {
  auto server = start(echo());
  const auto one = connect_to(*server), two = connect_to(*server);
  std::string message;
  ASSERT_TRUE(two->send("2", long_enough));
  ASSERT_TRUE(one->send("1", long_enough));
  ASSERT_EQ(one->receive(message, long_enough), Received::message);
  EXPECT_EQ(message, "1");
  ASSERT_EQ(two->receive(message, long_enough), Received::message);
  EXPECT_EQ(message, "2");
  server.reset();
  EXPECT_EQ(one->receive(message, long_enough), Received::closed);
}

// The example of RFC 6455, 1.3, and a masked "Hello" of its 5.7.
TEST(WebServer, answers_the_handshake_of_the_standard) {
  const auto server = start(echo());
  const RawSocket raw(server->port());
  raw.write(
      "GET /chat HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n");
  const std::string head = raw.read_to("\r\n\r\n");
  EXPECT_NE(head.find("101"), std::string::npos) << head;
  EXPECT_NE(head.find("s3pPLMBiTxaQ9kYGzzhZRbK+xOo="), std::string::npos) << head;
  raw.write("\x81\x85\x37\xfa\x21\x3d\x7f\x9f\x4d\x51\x58");
  EXPECT_EQ(raw.read_to("Hello"), "\x81\x05Hello");
}

TEST(WebServer, answers_a_get) {
  const auto server = start(echo());
  const RawSocket there(server->port()), not_there(server->port());
  there.write("GET /there HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
  const std::string found = there.read_to("}");
  EXPECT_EQ(found.substr(0, 15), "HTTP/1.1 200 OK");
  EXPECT_NE(found.find("\r\n\r\n{\"is\":true}"), std::string::npos) << found;
  not_there.write("GET /elsewhere HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
  EXPECT_NE(not_there.read_to("\r\n\r\n").find("404"), std::string::npos);
}

}  // namespace
}  // namespace acus::net
