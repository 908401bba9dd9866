// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/network_server.hpp"

#include <unistd.h>

#include <array>
#include <unordered_map>
#include <vector>
//
#include <utility>  // before asio: its 1.74 needs std::exchange and does not include it
//
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>

#include "core/error.hpp"
#include "server/detail/http_session.hpp"
#include "server/detail/web_socket_session.hpp"
#include "server/origin_guard.hpp"

namespace carpus::server {

namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

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

struct NetworkServer::Implementation {
  Implementation(const NetworkOptions& network_options, HttpHandler http_handler, PageHandler& p)
      : options(network_options),
        acceptor(open_acceptor(context, options)),
        guard(acceptor.local_endpoint().port(), own_names()),
        http(std::move(http_handler)),
        pages(p),
        signals(context) {}

  void accept_next() {
    acceptor.async_accept([this](error_code error, tcp::socket socket) {
      if (stopping) return;
      if (!error && connections() < options.max_connections) begin(std::move(socket));
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

  [[nodiscard]] std::size_t connections() const { return https.size() + sockets.size(); }

  void begin(tcp::socket socket) {
    error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    auto session = std::make_shared<detail::HttpSession>(
        std::move(socket), session_context, [this](detail::HttpSession* s) { https.erase(s); });
    https.emplace(session.get(), session);
    session->read_next();
  }

  void upgrade(boost::beast::tcp_stream&& stream,
               const boost::beast::http::request<boost::beast::http::string_body>& request) {
    auto session = std::make_shared<detail::WebSocketSession>(
        std::move(stream), options, pages,
        [this](detail::WebSocketSession* s) { sockets.erase(s); });
    sockets.emplace(session.get(), session);
    session->accept(request);
  }

  void stop() {
    if (std::exchange(stopping, true)) return;
    error_code ignored;
    acceptor.close(ignored);
    for (const auto& [key, session] : std::unordered_map(sockets)) session->abort();
    for (const auto& [key, session] : std::unordered_map(https)) session->abort();
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
  asio::io_context context{1};
  tcp::acceptor acceptor;
  OriginGuard guard;
  HttpHandler http;
  PageHandler& pages;
  asio::signal_set signals;
  asio::steady_timer retry{context};
  detail::HttpSessionContext session_context{
      options, guard, http,
      [this](auto&& stream, const auto& request) { upgrade(std::move(stream), request); }};
  std::unordered_map<detail::HttpSession*, std::shared_ptr<detail::HttpSession>> https;
  std::unordered_map<detail::WebSocketSession*, std::shared_ptr<detail::WebSocketSession>> sockets;
  bool stopping = false;
};

NetworkServer::NetworkServer(const NetworkOptions& options, HttpHandler http, PageHandler& pages)
    : implementation_(std::make_unique<Implementation>(options, std::move(http), pages)) {}

NetworkServer::~NetworkServer() = default;

std::string NetworkServer::url() const {
  const auto endpoint = implementation_->acceptor.local_endpoint();
  std::string host = implementation_->options.address;
  if (endpoint.address().is_v6()) host = "[" + host + "]";
  if (endpoint.address().is_unspecified()) host = own_names().empty() ? host : own_names().front();
  return "http://" + host + ":" + std::to_string(endpoint.port());
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
  implementation_->signals.add(SIGINT);
  implementation_->signals.add(SIGTERM);
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
