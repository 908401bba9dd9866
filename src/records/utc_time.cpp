// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/utc_time.hpp"

#include <array>
#include <cstdio>
#include <ctime>

namespace carpus::records {

std::string format_utc(std::chrono::system_clock::time_point time) {
  using std::chrono::milliseconds;
  const auto since_epoch = std::chrono::floor<milliseconds>(time.time_since_epoch());
  const auto seconds = std::chrono::floor<std::chrono::seconds>(since_epoch);
  const std::time_t clock_time = static_cast<std::time_t>(seconds.count());
  std::tm parts{};
  gmtime_r(&clock_time, &parts);
  std::array<char, 40> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  std::snprintf(text.data() + length, text.size() - length, ".%03dZ",
                static_cast<int>((since_epoch - seconds).count()));
  return text.data();
}

std::string utc_now() { return format_utc(std::chrono::system_clock::now()); }

}  // namespace carpus::records
