// The only file that parses Boost.Beast, which takes long. Everything runs on the thread that asks: an
// operation is begun and the context of its connection is run until it is done or patience has ended.
#include "acus/net/web_socket.h"

#include <sys/resource.h>

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <list>
#include <new>
#include <optional>
#include <system_error>
#include <thread>

namespace acus::net {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using Clock = std::chrono::steady_clock;

constexpr std::size_t longest_message = 1U << 20U;  // bytes
constexpr double handshake_patience = 5.0;          // s
constexpr double between_looks = 0.02;              // s, at whether a server shall stop
constexpr std::uint32_t longest_head = 16U << 10U;  // bytes
constexpr std::size_t most_clients = 16;
// What a page of ours may load: itself, and WebAssembly. No other page may put it into a frame or read it.
constexpr const char* page_policy =
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; img-src "
    "'self' data: "
    "blob:; worker-src 'self' blob:; connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; "
    "form-action 'none'";

Clock::time_point in(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

struct WebSocket::Connection {
  asio::io_context context{1};
  websocket::stream<beast::tcp_stream> stream{context};
  beast::flat_buffer incoming;
  bool reading = false, over = false;
  std::optional<beast::error_code> read;  // how the read that was begun ended
  long heard = 0;                         // messages, pings and pongs

  Connection() {
    stream.read_message_max(longest_message);
    // Deadlines are kept by whoever waits.
    websocket::stream_base::timeout never{};
    never.handshake_timeout = never.idle_timeout = websocket::stream_base::none();
    stream.set_option(never);
    stream.control_callback([this](websocket::frame_type, beast::string_view) { ++heard; });
  }

  // Runs what was begun until `done` or the deadline; false at the deadline. What is ready then is still
  // taken, but whoever always has more ready does not keep us.
  template <class Done>
  bool run_until(Clock::time_point deadline, Done done) {
    constexpr int a_message = 16;  // handlers that one of them takes, and some
    for (int late = 0; !done();) {
      context.restart();
      if (Clock::now() < deadline)
        context.run_one_until(deadline);
      else if (++late > a_message || context.poll_one() == 0)
        return done();
    }
    return true;
  }

  // Begins with `begin(handler)` and waits. What failed, or that it took too long.
  template <class Begin>
  beast::error_code finish(Clock::time_point deadline, Begin begin) {
    std::optional<beast::error_code> result;
    begin([&result](beast::error_code error, auto&&...) { result = error; });
    if (!run_until(deadline, [&] { return result.has_value(); })) {
      beast::error_code ignored;
      stream.next_layer().socket().close(ignored);  // the handler runs with an error
      run_until(in(handshake_patience), [&] { return result.has_value(); });
      return beast::error::timeout;
    }
    return *result;
  }

  bool write(std::string_view message, double patience) {
    if (over) return false;
    over = static_cast<bool>(finish(in(patience), [&](auto handler) {
      stream.async_write(asio::const_buffer(message.data(), message.size()), handler);
    }));
    return !over;
  }

  void take_small_messages_at_once() {
    beast::error_code ignored;
    stream.next_layer().socket().set_option(asio::ip::tcp::no_delay(true), ignored);
  }
};

WebSocket::WebSocket(std::unique_ptr<Connection> connection) : connection_(std::move(connection)) {}

WebSocket::~WebSocket() {
  Connection& c = *connection_;
  if (!c.over) {
    constexpr double goodbye = 0.05;  // s
    c.finish(in(goodbye),
             [&](auto handler) { c.stream.async_close(websocket::close_code::normal, handler); });
  }
  beast::error_code ignored;
  c.stream.next_layer().socket().close(ignored);
  c.run_until(in(handshake_patience), [&] { return !c.reading || c.read.has_value(); });
}

Result<std::unique_ptr<WebSocket>> WebSocket::connect(const std::string& host, unsigned short port,
                                                      double patience, const std::string& target,
                                                      const std::string& origin) {
  const Clock::time_point deadline = in(patience);
  const std::string where = host + ":" + std::to_string(port);
  auto connection = std::make_unique<Connection>();
  Connection& c = *connection;
  beast::error_code error;
  const asio::ip::address address = asio::ip::make_address(host == "localhost" ? "127.0.0.1" : host, error);
  if (error) return Error{"'" + host + "' is no address; give one like 127.0.0.1"};
  error = c.finish(deadline, [&](auto handler) {
    c.stream.next_layer().socket().async_connect({address, port}, handler);
  });
  if (error) return Error{"nobody answers at " + where + " (" + error.message() + ")"};
  c.take_small_messages_at_once();
  c.stream.set_option(websocket::stream_base::decorator([&origin](websocket::request_type& request) {
    if (!origin.empty()) request.set(http::field::origin, origin);
  }));
  error = c.finish(deadline, [&](auto handler) { c.stream.async_handshake(where, target, handler); });
  if (error) return Error{"what answers at " + where + " speaks no WebSocket (" + error.message() + ")"};
  return std::unique_ptr<WebSocket>(new WebSocket(std::move(connection)));
}

bool WebSocket::send(std::string_view message, double patience) {
  Connection& c = *connection_;
  c.stream.text(true);
  return c.write(message, patience);
}

bool WebSocket::send_bytes(std::string_view message, double patience) {
  Connection& c = *connection_;
  c.stream.binary(true);
  return c.write(message, patience);
}

WebSocket::Received WebSocket::receive(std::string& message, double patience) {
  Connection& c = *connection_;
  if (c.over) return Received::closed;
  if (!c.reading) {
    c.read.reset();
    c.reading = true;
    c.stream.async_read(c.incoming, [&c](beast::error_code error, std::size_t) { c.read = error; });
  }
  if (!c.run_until(in(patience), [&] { return c.read.has_value(); })) return Received::nothing;
  c.reading = false;
  if (*c.read) {
    c.over = true;
    return Received::closed;
  }
  const asio::const_buffer bytes = c.incoming.data();
  message.assign(static_cast<const char*>(bytes.data()), bytes.size());
  c.incoming.consume(bytes.size());
  ++c.heard;
  return Received::message;
}

long WebSocket::heard() const { return connection_->heard; }

struct WebServer::Listener {
  WebService service;
  asio::io_context context{1};
  asio::ip::tcp::acceptor acceptor{context};
  unsigned short port = 0;  // that was taken
  std::atomic<bool> stopping{false};
  std::thread accepting;
  struct Visit {
    std::thread thread;
    std::atomic<bool> over{false};
  };
  std::list<Visit> visits;  // of the accepting thread

  std::optional<Error> listen(unsigned short asked) {
    const asio::ip::tcp::endpoint here(asio::ip::address_v4::loopback(), asked);
    beast::error_code error;
    acceptor.open(here.protocol(), error);
    if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor.bind(here, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (!error) port = acceptor.local_endpoint(error).port();
    if (!error) return std::nullopt;
    return Error{"port " + std::to_string(asked) + " cannot be listened at (" + error.message() +
                 "); choose another with --port"};
  }

  void accept_until_stopped() {
    constexpr int niceness = 10;  // of 19; a page's share of a busy processor is then a tenth
    if (service.gives_way) setpriority(PRIO_PROCESS, 0, niceness);  // of this thread, and those it starts
    while (!stopping) {
      auto connection = std::make_unique<WebSocket::Connection>();
      std::optional<beast::error_code> come;
      acceptor.async_accept(connection->stream.next_layer().socket(),
                            [&come](beast::error_code error) { come = error; });
      while (!come) {
        context.restart();
        context.run_one_until(in(between_looks));
        if (stopping) acceptor.close();
      }
      if (!*come && visits.size() < most_clients) receive(std::move(connection));
      visits.remove_if([](Visit& visit) {
        if (visit.over) visit.thread.join();
        return visit.over.load();
      });
    }
    for (Visit& visit : visits) visit.thread.join();
  }

  void receive(std::unique_ptr<WebSocket::Connection> connection) {
    Visit& visit = visits.emplace_back();
    try {
      visit.thread = std::thread([this, &visit, c = std::move(connection)]() mutable {
        try {
          visit_by(std::move(c));
        } catch (const std::bad_alloc&) {  // this client goes, the others stay
        }
        visit.over = true;
      });
    } catch (const std::system_error&) {  // no more threads or memory: turned away
      visits.pop_back();
    }
  }

  void visit_by(std::unique_ptr<WebSocket::Connection> connection) {
    WebSocket::Connection& c = *connection;
    c.take_small_messages_at_once();
    beast::flat_buffer buffer;
    http::request_parser<http::empty_body> parser;
    parser.header_limit(longest_head);
    beast::tcp_stream& stream = c.stream.next_layer();
    const beast::error_code failed = c.finish(
        in(handshake_patience), [&](auto handler) { http::async_read(stream, buffer, parser, handler); });
    if (failed == beast::error::timeout) return;  // its socket is closed
    if (failed) return say(c, {400, {}, "this is no request that is understood here\n"});
    const http::request<http::empty_body>& head = parser.get();
    const WebRequest request{std::string(head.method_string()), std::string(head.target()),
                             std::string(head[http::field::host]), std::string(head[http::field::origin])};
    if (!websocket::is_upgrade(head)) return say(c, service.answer(request));
    if (service.admits && !service.admits(request))
      return say(c, {403, {}, "open the address that acus has printed\n"});
    if (c.finish(in(handshake_patience), [&](auto handler) { c.stream.async_accept(head, handler); })) return;
    WebSocket client(std::move(connection));
    service.serve(client, [this] { return stopping.load(); });
  }

  static void say(WebSocket::Connection& c, const WebAnswer& answer) {
    constexpr unsigned http_1_1 = 11;
    http::response<http::string_body> response(static_cast<http::status>(answer.status), http_1_1,
                                               answer.body);
    response.set(http::field::content_type, answer.type.empty() ? WebAnswer().type : answer.type);
    response.set(http::field::cache_control, "no-cache");
    response.set("Content-Security-Policy", page_policy);
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    response.set("Referrer-Policy", "no-referrer");
    response.set("X-Content-Type-Options", "nosniff");
    response.keep_alive(false);
    response.prepare_payload();
    beast::tcp_stream& stream = c.stream.next_layer();
    c.finish(in(handshake_patience), [&](auto handler) { http::async_write(stream, response, handler); });
    beast::error_code ignored;
    stream.socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
  }
};

WebServer::WebServer(std::unique_ptr<Listener> listener) : listener_(std::move(listener)) {}

WebServer::~WebServer() {
  listener_->stopping = true;
  listener_->accepting.join();
}

Result<std::unique_ptr<WebServer>> WebServer::start(unsigned short port, WebService service) {
  auto listener = std::make_unique<Listener>();
  listener->service = std::move(service);
  if (const auto refused = listener->listen(port)) return *refused;
  listener->accepting = std::thread([l = listener.get()] { l->accept_until_stopped(); });
  return std::unique_ptr<WebServer>(new WebServer(std::move(listener)));
}

unsigned short WebServer::port() const { return listener_->port; }

}  // namespace acus::net
