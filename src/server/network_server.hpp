// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// HTTP and WebSocket on one port (Boost.Beast), in one thread: the network's end of the station.
// It knows nothing of operations; it hands requests and frames on and keeps bad ones out.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "server/access_links.hpp"
#include "server/guest.hpp"
#include "server/http_message.hpp"

namespace carpus::server {

/// A page that is connected to /ws. Used in the network thread only.
class PageConnection {
 public:
  virtual ~PageConnection() = default;
  /// Queues a text frame. A page that lets more than some megabytes wait is disconnected.
  virtual void send_text(std::string text) = 0;
  /// Queues a binary frame.
  virtual void send_binary(std::string bytes) = 0;
  /// Frames that wait for the network; states are not worth sending while older ones wait.
  [[nodiscard]] virtual std::size_t waiting_frames() const = 0;
  /// Says goodbye after what is queued.
  virtual void close() = 0;
  /// It has said who it is; one that has not is closed after a while, or when another needs room.
  virtual void keep() = 0;
  /// By which link it came.
  [[nodiscard]] virtual const Guest& guest() const = 0;
};

/// What happens on /ws. Called in the network thread, never after `on_close` of that connection.
class PageHandler {
 public:
  virtual ~PageHandler() = default;
  virtual void on_open(const std::shared_ptr<PageConnection>& page) = 0;
  virtual void on_text(const std::shared_ptr<PageConnection>& page, std::string_view text) = 0;
  virtual void on_binary(const std::shared_ptr<PageConnection>& page) = 0;
  /// Anything was heard, an answer to a ping included.
  virtual void on_alive(const std::shared_ptr<PageConnection>& page) = 0;
  virtual void on_close(const std::shared_ptr<PageConnection>& page) = 0;
};

struct NetworkOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;  ///< 0 lets the system choose
  /// For a request's head to arrive as a whole, for each piece of a body, and for a handshake.
  std::chrono::milliseconds request_timeout{10000};
  /// For an answer to leave: a busy page reads a large scene slowly.
  std::chrono::milliseconds answer_timeout{60000};
  /// For the other side to hear a refusal before its connection is closed.
  std::chrono::milliseconds linger_timeout{2000};
  /// For a page to say who it is (PageConnection::keep).
  std::chrono::milliseconds hello_timeout{10000};
  /// A page that does not answer pings for so long is gone.
  std::chrono::milliseconds page_timeout{30000};
  std::chrono::milliseconds ping_interval{400};
  /// Where there is no room, a newcomer takes the place of the connection that has been silent
  /// longest; who operates, waits in turn or is being answered keeps theirs.
  std::size_t max_connections = 64;
  /// From one address; behind a proxy all come from its own, and this does not count.
  std::size_t max_per_address = 32;
  /// Of answers that are on their way together; one alone may be larger.
  std::size_t max_answer_bytes = std::size_t{48} << 20U;
  /// Which requests are answered in which of some threads of their own, one after another in each:
  /// 1 to kLanes, for what may have to wait for a disk or takes long to make. 0 is the network's,
  /// as is every request where this is empty.
  std::function<std::size_t(const HttpRequest&)> lane_of;
  static constexpr std::size_t kLanes = 4;
  /// Who takes the bodies of requests that may have one (request_head.hpp), from instructors and
  /// our own page; nobody where it is empty. They are taken in the last lane.
  BodyHandler take_body;
  /// A body that comes slower than this on the whole is given up.
  double least_body_bytes_per_s = 65536;

  /// Who may come in: those who have one of these. All, where there are none.
  std::optional<AccessLinks> links;
  /// PEM files; TLS is spoken where both are given.
  std::filesystem::path certificate;
  std::filesystem::path key;
  /// "https://train.example.org": what people open where a proxy passes it on; empty: no proxy.
  std::string public_url;
};

/// Before long work: throws what NetworkServer's constructor would throw now.
void require_network(const NetworkOptions& options);

class NetworkServer {
 public:
  /// Takes the port.
  /// @throws IoError  naming the port, address or file and the option to change it;
  /// @throws InvalidInput  an address that is none.
  NetworkServer(const NetworkOptions& options, HttpHandler http, PageHandler& pages);
  ~NetworkServer();
  NetworkServer(const NetworkServer&) = delete;
  NetworkServer& operator=(const NetworkServer&) = delete;

  /// What people open: "http://127.0.0.1:8080", or the proxy's.
  [[nodiscard]] std::string url() const;
  [[nodiscard]] std::uint16_t port() const noexcept;

  /// Serves until stop(); all handlers are called in the thread that calls this.
  void run();
  /// From any thread: closes the connections (each gets its on_close) and lets run() return.
  void stop();
  /// SIGINT, SIGTERM and SIGHUP call stop(); SIGPIPE does nothing.
  void stop_on_signals();
  /// From any thread: calls `task` in the network thread.
  void post(std::function<void()> task);
  /// Before run(): calls `task` in the network thread at this interval.
  void repeat(std::chrono::milliseconds interval, std::function<void()> task);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace carpus::server
