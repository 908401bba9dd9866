// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/query_number.hpp"

#include <algorithm>
#include <charconv>

namespace carpus::server {

std::optional<std::int64_t> number_in_query(std::string_view target, std::string_view name) {
  const std::size_t begin = target.find('?');
  if (begin == std::string_view::npos) return 0;
  std::string_view query = target.substr(begin + 1);
  query = query.substr(0, query.find('#'));
  while (!query.empty()) {
    const std::string_view pair = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), pair.size() + 1));
    if (!pair.starts_with(name) || pair.substr(name.size()).substr(0, 1) != "=") continue;
    const std::string_view text = pair.substr(name.size() + 1);
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || number < 0) return std::nullopt;
    return number;
  }
  return 0;
}

}  // namespace carpus::server
