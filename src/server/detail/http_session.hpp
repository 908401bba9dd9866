// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One HTTP connection: requests one after another, or the step up to WebSocket. Private to the
// network server.
#pragma once

#include "server/detail/door_stream.hpp"
//
#include <array>
#include <boost/beast/http.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "server/access.hpp"
#include "server/answer_budget.hpp"
#include "server/network_server.hpp"
#include "server/origin_guard.hpp"
#include "server/request_head.hpp"

namespace carpus::server::detail {

/// What a session needs of its server.
struct HttpSessionContext {
  const NetworkOptions& options;
  const OriginGuard& guard;
  const HttpHandler& handler;
  Access* access;  ///< null: whoever reaches the station may use it
  AnswerBudget& budget;
  /// Calls `work` in a lane's thread, then `done` in the network's; false when too much waits.
  std::function<bool(std::size_t lane,
                     std::function<HttpResponse()> work,
                     std::function<void(HttpResponse)> done)>
      run_aside;
  /// Takes over a connection that asked for /ws and may have it.
  std::function<void(DoorStream&&,
                     const std::string& address,
                     const boost::beast::http::request<boost::beast::http::string_body>&,
                     const Guest&)>
      upgrade;
};

class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param address  of the other side
  HttpSession(DoorStream&& stream,
              std::string address,
              const HttpSessionContext& context,
              std::function<void(HttpSession*)> on_end);
  ~HttpSession() = default;
  HttpSession(const HttpSession&) = delete;
  HttpSession& operator=(const HttpSession&) = delete;

  void begin();
  /// Answers at once that there is no room, and closes.
  void turn_away();
  void abort();

  [[nodiscard]] const std::string& address() const noexcept { return address_; }
  /// Nothing is owed to it: it has not said a whole request since `silent_since`, or listens no
  /// more.
  [[nodiscard]] bool is_silent() const noexcept { return silent_; }
  [[nodiscard]] Clock::time_point silent_since() const noexcept { return silent_since_; }

 private:
  using Body = boost::beast::http::span_body<const char>;

  void read_next();
  void read_more();
  void look_for_request();
  void on_request();
  void handle(const Guest& guest);
  /// Why a request that changes something is not answered; nothing where it is.
  [[nodiscard]] std::optional<HttpResponse> problem_of_change(const Guest& guest) const;
  void begin_body(const Guest& guest);
  void read_body();
  void take_piece();
  void on_taken(const HttpResponse& verdict);
  void upgrade(const Guest& guest);
  void answer(const HttpResponse& response);
  void refuse(const RequestProblem& problem);
  void answer_and_close(const HttpResponse& response);
  void fill_response(const HttpResponse& from);
  void write();
  void on_written();
  void linger();
  void drain(std::size_t left);
  void end();

  DoorStream stream_;
  std::string address_;
  const HttpSessionContext& context_;
  std::function<void(HttpSession*)> on_end_;
  std::string received_;  ///< at most a head and what came with it
  std::size_t scanned_ = 0;
  std::array<char, 4096> piece_{};
  RequestHead head_;
  std::unique_ptr<BodyTaker> taker_;  ///< while a body comes
  std::string body_piece_;            ///< that comes, or is being taken
  std::uint64_t body_left_ = 0;
  Clock::time_point body_due_;
  bool has_head_ = false;  ///< of the request that is being answered
  bool keep_alive_ = false;
  std::optional<boost::beast::http::response<Body>> response_;
  std::optional<boost::beast::http::response_serializer<Body>> serializer_;
  AnswerBudget::Share share_;  ///< holds the body until it is written
  bool silent_ = true;
  Clock::time_point silent_since_ = Clock::now();
  bool ended_ = false;
};

}  // namespace carpus::server::detail
