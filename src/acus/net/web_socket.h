// WebSockets (RFC 6455) with text messages, as programs on one machine speak to each other: at most one
// message a time is awaited, and nothing is awaited for longer than is said.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "acus/base/result.h"

namespace acus::net {

// One end of a connection; for one thread.
class WebSocket {
 public:
  // To a server; `origin` as a browser names the page that asks, none where it is empty. `patience` [s] is
  // for the whole of it. An error says in one sentence who does not answer.
  static Result<std::unique_ptr<WebSocket>> connect(const std::string& host, unsigned short port,
                                                    double patience, const std::string& target = "/",
                                                    const std::string& origin = "");
  ~WebSocket();  // says goodbye, without waiting for an answer

  // False when the message is not on its way after `patience` [s], or the connection is over: then for good.
  bool send(std::string_view message, double patience);
  // The same for a message that is no text.
  bool send_bytes(std::string_view message, double patience);

  enum class Received { message, nothing, closed };
  // Waits for a message, for `patience` [s] at most; one that is there already is taken at once.
  Received receive(std::string& message, double patience);
  // How many messages, pings and pongs have come so far.
  long heard() const;

  WebSocket(const WebSocket&) = delete;
  WebSocket& operator=(const WebSocket&) = delete;

 private:
  friend class WebServer;
  struct Connection;
  explicit WebSocket(std::unique_ptr<Connection> connection);
  std::unique_ptr<Connection> connection_;
};

struct WebRequest {
  std::string method, target;  // "GET", "/index.html?token=1"
  std::string host, origin;    // as the client says; empty where it does not
};

struct WebAnswer {
  unsigned status = 404;
  std::string type = "text/plain; charset=utf-8", body;
};

// What a WebServer does with those who come; called on a thread for each of them, so several may run at once.
struct WebService {
  // To whatever asks for no WebSocket.
  std::function<WebAnswer(const WebRequest& request)> answer;
  // Whether a WebSocket may be opened; without it, to anybody.
  std::function<bool(const WebRequest& request)> admits;
  // A client for as long as it lasts; returns when it is closed, or soon after `stopping()` has become true.
  std::function<void(WebSocket& client, const std::function<bool()>& stopping)> serve;
  // Whether its threads leave the processors to whatever else needs them.
  bool gives_way = false;
};

// Listens on this machine alone (127.0.0.1). At most 16 clients at a time: a further one is turned away. A
// request may have heads of 16 KB, no body, and 5 s; a message of a client may have 1 MB.
class WebServer {
 public:
  // At port 0 any that is free. Error: the port is taken.
  static Result<std::unique_ptr<WebServer>> start(unsigned short port, WebService service);
  ~WebServer();  // waits until all clients are gone

  unsigned short port() const;

  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

 private:
  struct Listener;
  explicit WebServer(std::unique_ptr<Listener> listener);
  std::unique_ptr<Listener> listener_;
};

}  // namespace acus::net
