// The studio on this machine: the page's files, and a socket for each page that is open.
// docs/studio-protocol.md says what is spoken, src/acus/net/local_access.h who may speak.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "acus/net/web_socket.h"
#include "broadcast.h"
#include "engine.h"
#include "lease.h"

namespace acus::app {

class StudioServer {
 public:
  // At port 0 any that is free. `engine` must outlive it. Error: the port is taken, or the engine
  // cannot begin.
  static Result<std::unique_ptr<StudioServer>> start(unsigned short port, Engine& engine);

  // What a person opens; with the token, so it is for the terminal and nothing else.
  std::string address() const;

  // Runs the engine until `stop` is true, on this thread.
  std::optional<Error> run(const std::atomic<bool>& stop);

 private:
  explicit StudioServer(Engine& engine);
  net::WebAnswer answer(const net::WebRequest& request) const;
  void serve(net::WebSocket& client, const std::function<bool()>& stopping);
  struct Visit;
  bool hear(Visit& visit, const std::string& message);
  bool foretell(Visit& visit);

  Engine& engine_;
  Broadcast broadcast_;
  Lease lease_;
  std::string token_;
  std::atomic<long> clients_{0};  // that ever came
  std::atomic<unsigned> port_{0};
  std::unique_ptr<net::WebServer> server_;  // last: its threads use the others
};

}  // namespace acus::app
