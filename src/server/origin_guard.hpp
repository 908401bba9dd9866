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

/// By what a station is reached that does not know it by itself: the address of a proxy.
struct PublicUrl {
  std::string scheme;     ///< "http" or "https"
  std::string authority;  ///< "train.example.org" or with a port
};

/// @throws InvalidInput  it is no "https://name" or "http://name:port"
[[nodiscard]] PublicUrl parse_public_url(std::string_view text);

class OriginGuard {
 public:
  /// @param port  that the station listens on.
  /// @param host_names  by which it may be called beside IP addresses and localhost.
  /// @param is_secure  whether it speaks TLS itself
  /// @param public_url  of a proxy before it; empty where there is none
  OriginGuard(std::uint16_t port,
              std::vector<std::string> host_names,
              bool is_secure = false,
              PublicUrl public_url = {});

  /// Whether a Host header names this station: localhost, any IP address (a page cannot make
  /// its name resolve to one and still send the address as Host) or a known name, and our port;
  /// or the proxy's address.
  [[nodiscard]] bool accepts_host(std::string_view host) const;

  /// Whether a WebSocket's Origin header is the page's own: the scheme and the Host that was asked.
  [[nodiscard]] bool accepts_origin(std::string_view origin, std::string_view host) const;

 private:
  [[nodiscard]] bool is_public(std::string_view host) const;

  std::uint16_t port_;
  std::vector<std::string> host_names_;
  bool is_secure_;
  PublicUrl public_url_;
};

}  // namespace carpus::server
