// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/network_server.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <unordered_map>
#include <vector>
//
#include <utility>  // before asio: its 1.74 needs std::exchange and does not include it
//
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>

#include "core/error.hpp"
#include "server/access.hpp"
#include "server/answer_budget.hpp"
#include "server/detail/http_session.hpp"
#include "server/detail/tls_context.hpp"
#include "server/detail/web_socket_session.hpp"
#include "server/origin_guard.hpp"
#include "server/work_thread.hpp"

namespace carpus::server {

namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

/// Connections that are told that there is no room, at once; more are closed without a word.
constexpr std::size_t kMaxTurnedAway = 16;
/// Requests that wait for a disk.
constexpr std::size_t kMaxSlowRequests = 32;

tcp::acceptor open_acceptor(asio::io_context& context, const NetworkOptions& options) {
  error_code error;
  const auto address = asio::ip::make_address(options.address, error);
  if (error) {
    throw InvalidInput("'" + options.address +
                       "' is not an IP address; give one with --listen, such as 127.0.0.1");
  }
  const tcp::endpoint endpoint(address, options.port);
  tcp::acceptor acceptor(context);
  acceptor.open(endpoint.protocol());
  acceptor.set_option(asio::socket_base::reuse_address(true));
  acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (!error) return acceptor;
  const std::string port = std::to_string(options.port);
  if (error == asio::error::address_in_use) {
    throw IoError("port " + port +
                  " is in use by another program; stop that, or choose another port with --port");
  }
  if (error == asio::error::access_denied) {
    throw IoError("port " + port +
                  " is reserved for the system; choose one above 1023 with --port");
  }
  throw IoError("cannot listen on " + options.address + " port " + port + ": " + error.message() +
                "; choose another address with --listen");
}

std::vector<std::string> own_names() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return {};
  return {name.data()};
}

}  // namespace

void require_network(const NetworkOptions& options) {
  if (!options.public_url.empty()) (void)parse_public_url(options.public_url);
  (void)detail::make_tls_context(options.certificate, options.key);
  asio::io_context context;
  (void)open_acceptor(context, options);
}

struct NetworkServer::Implementation {
  using Session = detail::HttpSession;
  using Sessions = std::unordered_map<Session*, std::shared_ptr<Session>>;

  Implementation(const NetworkOptions& network_options, HttpHandler http_handler, PageHandler& p)
      : options(network_options),
        public_url(options.public_url.empty() ? PublicUrl{} : parse_public_url(options.public_url)),
        tls(detail::make_tls_context(options.certificate, options.key)),
        acceptor(open_acceptor(context, options)),
        guard(acceptor.local_endpoint().port(), own_names(), tls.has_value(), public_url),
        http(std::move(http_handler)),
        pages(p),
        signals(context) {
    if (!options.links) return;
    const bool is_secure =
        public_url.authority.empty() ? tls.has_value() : public_url.scheme == "https";
    access.emplace(*options.links, acceptor.local_endpoint().port(), is_secure);
    session_context.access = &*access;
  }

  void accept_next() {
    acceptor.async_accept([this](error_code error, tcp::socket socket) {
      if (stopping) return;
      if (!error) begin(std::move(socket));
      if (error) return accept_later();
      accept_next();
    });
  }

  /// After a failure such as too many open files, without spinning.
  void accept_later() {
    retry.expires_after(std::chrono::milliseconds(100));
    retry.async_wait([this](error_code error) {
      if (!error && !stopping) accept_next();
    });
  }

  void begin(tcp::socket socket) {
    error_code error;
    const auto peer = socket.remote_endpoint(error);
    if (error) return;  // it has gone already
    socket.set_option(tcp::no_delay(true), error);
    const std::string address = peer.address().to_string();
    const bool has_room = make_room(address);
    Sessions& place = has_room ? https : turned_away;
    if (!has_room && turned_away.size() >= kMaxTurnedAway) return;
    detail::DoorStream stream =
        tls ? detail::DoorStream(std::move(socket), *tls) : detail::DoorStream(std::move(socket));
    auto session = std::make_shared<Session>(std::move(stream), address, session_context,
                                             [&place](Session* s) { place.erase(s); });
    place.emplace(session.get(), session);
    if (has_room) {
      session->begin();
    } else {
      session->turn_away();
    }
  }

  /// Whether one more may come from this address, after closing one that has nothing to say.
  bool make_room(const std::string& address) {
    const auto is_from_here = [&](const auto& entry) { return entry.first->address() == address; };
    const auto from_here =
        static_cast<std::size_t>(std::count_if(https.begin(), https.end(), is_from_here) +
                                 std::count_if(sockets.begin(), sockets.end(), is_from_here));
    const std::size_t limit =
        public_url.authority.empty() ? options.max_per_address : options.max_connections;
    if (from_here >= limit) return displace(&address);
    if (https.size() + sockets.size() < options.max_connections) return true;
    // Whoever comes with many displaces their own first.
    return displace(&address) || displace(nullptr);
  }

  /// Closes the one that has been silent longest, of this address where one is given.
  bool displace(const std::string* address) {
    detail::HttpSession* silent_http = nullptr;
    detail::WebSocketSession* silent_page = nullptr;
    auto since = std::chrono::steady_clock::time_point::max();
    const auto is_longest = [&](const auto& session) {
      return session.is_silent() && session.silent_since() < since &&
             (address == nullptr || session.address() == *address);
    };
    for (const auto& [key, session] : https) {
      if (!is_longest(*session)) continue;
      silent_http = key;
      since = session->silent_since();
    }
    for (const auto& [key, session] : sockets) {
      if (!is_longest(*session)) continue;
      silent_page = key;
      since = session->silent_since();
    }
    if (silent_page != nullptr) {
      silent_page->abort();
    } else if (silent_http != nullptr) {
      silent_http->abort();
    }
    return silent_page != nullptr || silent_http != nullptr;
  }

  void upgrade(detail::DoorStream&& stream,
               const std::string& address,
               const boost::beast::http::request<boost::beast::http::string_body>& request,
               const Guest& guest) {
    auto session = std::make_shared<detail::WebSocketSession>(
        std::move(stream), detail::WebSocketSession::Peer{address, guest}, options, pages,
        [this](detail::WebSocketSession* s) { sockets.erase(s); });
    sockets.emplace(session.get(), session);
    session->accept(request);
  }

  bool run_aside(std::size_t lane,
                 std::function<HttpResponse()> work,
                 std::function<void(HttpResponse)> done) {
    return lanes.at(lane - 1).post([this, work = std::move(work), done = std::move(done)] {
      asio::post(context, [done, response = work()]() mutable { done(std::move(response)); });
    });
  }

  void stop() {
    if (std::exchange(stopping, true)) return;
    error_code ignored;
    acceptor.close(ignored);
    for (const auto& [key, session] : std::unordered_map(sockets)) session->abort();
    for (const auto& [key, session] : Sessions(https)) session->abort();
    for (const auto& [key, session] : Sessions(turned_away)) session->abort();
    context.stop();
  }

  void repeat(std::chrono::milliseconds interval, std::function<void()> task) {
    auto timer = std::make_shared<asio::steady_timer>(context);
    auto shared_task = std::make_shared<std::function<void()>>(std::move(task));
    arm(timer, std::chrono::steady_clock::now() + interval, interval, shared_task);
  }

  void arm(const std::shared_ptr<asio::steady_timer>& timer,
           std::chrono::steady_clock::time_point due,
           std::chrono::milliseconds interval,
           const std::shared_ptr<std::function<void()>>& task) {
    timer->expires_at(due);
    timer->async_wait([this, timer, due, interval, task](error_code error) {
      if (error || stopping) return;
      (*task)();
      arm(timer, std::max(due + interval, std::chrono::steady_clock::now()), interval, task);
    });
  }

  NetworkOptions options;
  PublicUrl public_url;
  AnswerBudget budget{options.max_answer_bytes};  // before whatever may hold a share of it
  std::optional<asio::ssl::context> tls;
  asio::io_context context{1};
  tcp::acceptor acceptor;
  OriginGuard guard;
  std::optional<Access> access;
  HttpHandler http;
  PageHandler& pages;
  asio::signal_set signals;
  asio::steady_timer retry{context};
  detail::HttpSessionContext session_context{
      options,
      guard,
      http,
      nullptr,
      budget,
      [this](std::size_t lane, auto work, auto done) {
        return run_aside(lane, std::move(work), std::move(done));
      },
      [this](auto&& stream, const auto& address, const auto& request, const auto& guest) {
        upgrade(std::move(stream), address, request, guest);
      }};
  Sessions https;
  Sessions turned_away;
  std::unordered_map<detail::WebSocketSession*, std::shared_ptr<detail::WebSocketSession>> sockets;
  bool stopping = false;
  /// Last: they use what is above.
  std::array<WorkThread, NetworkOptions::kLanes> lanes{
      WorkThread{kMaxSlowRequests}, WorkThread{kMaxSlowRequests}, WorkThread{kMaxSlowRequests},
      WorkThread{kMaxSlowRequests}};
};

NetworkServer::NetworkServer(const NetworkOptions& options, HttpHandler http, PageHandler& pages)
    : implementation_(std::make_unique<Implementation>(options, std::move(http), pages)) {}

NetworkServer::~NetworkServer() = default;

std::string NetworkServer::url() const {
  const PublicUrl& proxy = implementation_->public_url;
  if (!proxy.authority.empty()) return proxy.scheme + "://" + proxy.authority;
  const auto endpoint = implementation_->acceptor.local_endpoint();
  std::string host = implementation_->options.address;
  if (endpoint.address().is_v6()) host = "[" + host + "]";
  if (endpoint.address().is_unspecified()) host = own_names().empty() ? host : own_names().front();
  const char* const scheme = implementation_->tls ? "https://" : "http://";
  return scheme + host + ":" + std::to_string(endpoint.port());
}

std::uint16_t NetworkServer::port() const noexcept {
  error_code ignored;
  return implementation_->acceptor.local_endpoint(ignored).port();
}

void NetworkServer::run() {
  implementation_->accept_next();
  implementation_->context.run();
}

void NetworkServer::stop() {
  asio::post(implementation_->context, [this] { implementation_->stop(); });
}

void NetworkServer::stop_on_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) implementation_->signals.add(signal);
  // A reader that goes away, of a log or a socket, is an error of that write and no more.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file at its limit is a write that fails, as on a full disk
  implementation_->signals.async_wait([this](error_code error, int) {
    if (!error) implementation_->stop();
  });
}

void NetworkServer::post(std::function<void()> task) {
  asio::post(implementation_->context, std::move(task));
}

void NetworkServer::repeat(std::chrono::milliseconds interval, std::function<void()> task) {
  implementation_->repeat(interval, std::move(task));
}

}  // namespace carpus::server
