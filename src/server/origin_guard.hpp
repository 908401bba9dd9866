// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Who may talk to the station: pages that came from it. Guards against other sites in the same
// browser (Origin) and against names that point here by trickery (DNS rebinding: Host).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace carpus::server {

class OriginGuard {
 public:
  /// @param port  that the station listens on.
  /// @param host_names  by which it may be called beside IP addresses and localhost.
  OriginGuard(std::uint16_t port, std::vector<std::string> host_names);

  /// Whether a Host header names this station: localhost, any IP address (a page cannot make
  /// its name resolve to one and still send the address as Host) or a known name, and our port.
  [[nodiscard]] bool accepts_host(std::string_view host) const;

  /// Whether a WebSocket's Origin header is the page's own: "http://" and the Host that was asked.
  [[nodiscard]] bool accepts_origin(std::string_view origin, std::string_view host) const;

 private:
  std::uint16_t port_;
  std::vector<std::string> host_names_;
};

}  // namespace carpus::server
