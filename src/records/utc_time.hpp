// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The time of day as records keep it.
#pragma once

#include <chrono>
#include <string>

namespace carpus::records {

/// "2026-01-31T12:00:00.000Z"
[[nodiscard]] std::string format_utc(std::chrono::system_clock::time_point time);

/// Now.
[[nodiscard]] std::string utc_now();

}  // namespace carpus::records
