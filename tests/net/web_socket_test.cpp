// Both ends over real sockets, and the server against the bytes of RFC 6455.
#include "acus/net/web_socket.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <new>
#include <thread>

#include "raw_socket.h"

namespace acus::net {
namespace {

using Received = WebSocket::Received;
constexpr double long_enough = 20.0;  // s, on a machine that does much else

// Sends back what it gets; "leave" makes it go.
WebService echo() {
  WebService service;
  service.answer = [](const WebRequest& request) {
    return request.target == "/there" ? WebAnswer{200, "application/json", R"({"is":true})"} : WebAnswer{};
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

TEST(WebServer, loses_only_the_client_for_whom_there_is_no_memory) {
  WebService service = echo();
  service.serve = [serve = service.serve](WebSocket& client, const std::function<bool()>& stopping) {
    std::string message;
    if (client.receive(message, long_enough) == Received::message && message == "much")
      throw std::bad_alloc();
    serve(client, stopping);
  };
  const auto server = start(std::move(service));
  const auto greedy = connect_to(*server), modest = connect_to(*server);
  std::string message;
  ASSERT_TRUE(greedy->send("much", long_enough));
  EXPECT_EQ(greedy->receive(message, long_enough), Received::closed);
  ASSERT_TRUE(modest->send("little", long_enough));
  ASSERT_TRUE(modest->send("and more", long_enough));
  ASSERT_EQ(modest->receive(message, long_enough), Received::message);
  EXPECT_EQ(message, "and more");
}

// Whatever clients do without end, the server's side of it ends.
TEST(WebServer, is_not_kept_by_clients_that_go_on_shouting) {
  constexpr int clients = 8;  // so that there is always more to hear
  for (const std::string& shout : {text_frame("leave"), text_frame("shout"), ping_frame()}) {
    auto server = start(echo());
    std::vector<std::thread> shouting;
    for (int i = 0; i < clients; ++i)
      shouting.emplace_back([&shout, port = server->port()] {
        const RawSocket raw(port);
        raw.write(socket_request(port, ""));
        raw.read_to("\r\n\r\n");
        std::string breath;
        for (int k = 0; k < 10'000; ++k) breath += shout;
        while (raw.sends(breath)) {
        }
      });
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    server.reset();
    for (std::thread& one : shouting) one.join();
  }
}

// Limits, each just kept and just not.
TEST(WebServer, takes_heads_of_sixteen_kilobytes_and_no_more) {
  const auto server = start(echo());
  for (const auto& [size, status] : {std::pair{15'000, "HTTP/1.1 200"}, std::pair{17'000, "HTTP/1.1 400"}}) {
    const RawSocket raw(server->port());
    raw.write("GET /there HTTP/1.1\r\nHost: 127.0.0.1\r\nX: " +
              std::string(static_cast<std::size_t>(size), 'x') + "\r\n\r\n");
    EXPECT_EQ(raw.read_to("\r\n").substr(0, 12), status);
  }
}

TEST(WebServer, serves_sixteen_and_turns_the_next_away) {
  const auto server = start(echo());
  std::vector<std::unique_ptr<WebSocket>> clients;
  for (int i = 0; i < 16; ++i) clients.push_back(connect_to(*server));
  EXPECT_FALSE(WebSocket::connect("127.0.0.1", server->port(), long_enough));
  clients.pop_back();
  bool again = false;  // as soon as it has seen that one has gone
  for (int i = 0; i < 2000 && !again; ++i) {
    again = static_cast<bool>(WebSocket::connect("127.0.0.1", server->port(), long_enough));
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(again);
}

TEST(WebServer, answers_nonsense_and_goes_on) {
  const auto server = start(echo());
  for (const std::string& nonsense :
       {std::string("\x16\x03\x01\x02\n\r\n\r\n"), std::string("GET\r\n\r\n"),
        std::string("\r\n\r\n\r\n\r\n"),
        std::string("POST /there HTTP/1.1\r\nHost: a\r\nContent-Length: 5\r\n\r\nhello")}) {
    const RawSocket raw(server->port());
    raw.write(nonsense);
    EXPECT_EQ(raw.read_to("\r\n").substr(0, 10), "HTTP/1.1 4") << nonsense;
  }
  EXPECT_TRUE(connect_to(*server)->send("still there", long_enough));
}

}  // namespace
}  // namespace acus::net
