// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/origin_guard.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"

namespace carpus::server {

namespace {

constexpr std::uint16_t kHttpPort = 80;
constexpr std::uint16_t kHttpsPort = 443;

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

bool consists_of(std::string_view text, std::string_view characters) {
  return !text.empty() && text.find_first_not_of(characters) == std::string_view::npos;
}

/// Digits and points only, or in square brackets; no such name can be registered.
bool is_ip_address(std::string_view host) {
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    return consists_of(host.substr(1, host.size() - 2), "0123456789abcdef:.");
  }
  return std::count(host.begin(), host.end(), '.') == 3 && consists_of(host, "0123456789.");
}

}  // namespace

PublicUrl parse_public_url(std::string_view text) {
  const std::string url = lower(text.ends_with('/') ? text.substr(0, text.size() - 1) : text);
  for (const std::string scheme : {"https", "http"}) {
    if (!url.starts_with(scheme + "://")) continue;
    const std::string authority = url.substr(scheme.size() + 3);
    if (!consists_of(authority, "abcdefghijklmnopqrstuvwxyz0123456789.-:[]")) break;
    return {scheme, authority};
  }
  throw InvalidInput("'" + std::string(text) +
                     "' is no address of a site; give the one that people open, such as "
                     "https://train.example.org, with --public-url");
}

OriginGuard::OriginGuard(std::uint16_t port,
                         std::vector<std::string> host_names,
                         bool is_secure,
                         PublicUrl public_url)
    : port_(port),
      host_names_(std::move(host_names)),
      is_secure_(is_secure),
      public_url_(std::move(public_url)) {
  for (std::string& name : host_names_) name = lower(name);
}

bool OriginGuard::is_public(std::string_view host) const {
  return !public_url_.authority.empty() && lower(host) == public_url_.authority;
}

bool OriginGuard::accepts_host(std::string_view host) const {
  if (is_public(host)) return true;
  std::string name = lower(host);
  std::string port = std::to_string(is_secure_ ? kHttpsPort : kHttpPort);
  const std::size_t colon = name.rfind(':');
  if (colon != std::string::npos && name.find(']', colon) == std::string::npos) {
    port = name.substr(colon + 1);
    name.resize(colon);
  }
  if (port != std::to_string(port_)) return false;
  return name == "localhost" || is_ip_address(name) ||
         std::find(host_names_.begin(), host_names_.end(), name) != host_names_.end();
}

bool OriginGuard::accepts_origin(std::string_view origin, std::string_view host) const {
  if (is_public(host)) {
    return lower(origin) == public_url_.scheme + "://" + public_url_.authority;
  }
  const std::string scheme = is_secure_ ? "https://" : "http://";
  return accepts_host(host) && lower(origin) == scheme + lower(host);
}

}  // namespace carpus::server
