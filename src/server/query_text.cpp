// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/query_text.hpp"

#include <algorithm>
#include <charconv>

namespace carpus::server {

namespace {

std::optional<std::string> decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      result += text[i];
      continue;
    }
    unsigned value = 0;
    const std::string_view digits = text.substr(i + 1, 2);
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (error != std::errc{} || digits.size() != 2 || end != digits.data() + 2 || value == 0) {
      return std::nullopt;
    }
    result += static_cast<char>(value);
    i += 2;
  }
  return result;
}

}  // namespace

std::optional<std::string> text_in_query(std::string_view target, std::string_view name) {
  std::optional<std::string> found;
  const std::size_t begin = target.find('?');
  std::string_view query = begin == std::string_view::npos ? "" : target.substr(begin + 1);
  while (!query.empty()) {
    const std::string_view pair = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), pair.size() + 1));
    if (!pair.starts_with(name) || pair.substr(name.size()).substr(0, 1) != "=") continue;
    if (found) return std::nullopt;
    found = decoded(pair.substr(name.size() + 1));
    if (!found) return std::nullopt;
  }
  return found.value_or("");
}

}  // namespace carpus::server
