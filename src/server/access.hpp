// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Who may come in: those who open the link that the station printed. The link's token is exchanged
// for a cookie, so that it does not stay in the address bar. Used in the network thread.
#pragma once

#include <chrono>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>

#include "server/access_links.hpp"
#include "server/guest.hpp"
#include "server/http_message.hpp"
#include "server/rate_limit.hpp"
#include "server/request_head.hpp"

namespace carpus::server {

class Access {
 public:
  using Clock = std::chrono::steady_clock;

  /// So many wrong links may come from one address at once, and one every `kSecondsPerFailure`
  /// later.
  static constexpr double kFailuresAtOnce = 20;
  static constexpr double kSecondsPerFailure = 3;
  /// Addresses that are remembered for their failures; beyond, the oldest is forgotten.
  static constexpr std::size_t kMaxAddresses = 1024;

  /// @param port  of the station, in the cookie's name: cookies do not tell ports apart
  /// @param is_secure  whether pages come by https
  Access(AccessLinks links, std::uint16_t port, bool is_secure);

  /// Whom a request is from, or what it is answered instead of what it asked for.
  /// @param address  that it comes from, for the count of failures
  [[nodiscard]] std::variant<Guest, HttpResponse> judge(const RequestHead& head,
                                                        std::string_view address,
                                                        Clock::time_point now);

 private:
  [[nodiscard]] const Role* role_of(std::string_view token) const noexcept;
  [[nodiscard]] HttpResponse let_in(const RequestHead& head, std::string_view token) const;
  [[nodiscard]] bool may_fail_again(std::string_view address, Clock::time_point now);

  AccessLinks links_;
  std::string cookie_name_;
  bool is_secure_;
  std::unordered_map<std::string, RateLimit> failures_;
  std::deque<std::string> failing_addresses_;  ///< oldest first
};

}  // namespace carpus::server
