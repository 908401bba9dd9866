// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is to be called when an operation of a socket has come to its end, whatever type it has: so
// that Beast's operations are compiled once instead of once for each who waits. Private to the
// network server.
#pragma once

#include <utility>  // before asio: its 1.74 needs std::exchange and does not include it
//
#include <boost/asio/associated_executor.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <memory>
#include <type_traits>

namespace carpus::server::detail {

/// Called at most once. Keeps the executor with which its handler is to be called.
template <typename... Args>
class AnyHandler {
 public:
  using executor_type = boost::asio::ip::tcp::socket::executor_type;

  template <typename Handler>
  AnyHandler(Handler&& handler, const executor_type& otherwise)
      : executor_(boost::asio::get_associated_executor(handler, otherwise)),
        held_(std::make_unique<Held<std::decay_t<Handler>>>(std::forward<Handler>(handler))) {}

  void operator()(Args... args) {
    // It may begin the next operation: nothing of this one is left then.
    const std::unique_ptr<Callable> held = std::move(held_);
    held->call(args...);
  }

  [[nodiscard]] executor_type get_executor() const noexcept { return executor_; }

 private:
  struct Callable {
    Callable() = default;
    virtual ~Callable() = default;
    Callable(const Callable&) = delete;
    Callable& operator=(const Callable&) = delete;
    virtual void call(Args... args) = 0;
  };
  template <typename Handler>
  struct Held final : Callable {
    explicit Held(Handler&& handler) : handler_(std::move(handler)) {}
    explicit Held(const Handler& handler) : handler_(handler) {}
    void call(Args... args) override {
      Handler handler(std::move(handler_));
      handler(args...);
    }
    Handler handler_;
  };

  executor_type executor_;
  std::unique_ptr<Callable> held_;
};

}  // namespace carpus::server::detail
