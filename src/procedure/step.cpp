// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/step.hpp"

#include <array>
#include <cstddef>

namespace carpus::procedure {

std::string_view name_of(Step step) noexcept {
  static constexpr std::array<std::string_view, kStepCount> kNames{
      "survey",  "entry",  "aim",    "drive",  "check",
      "measure", "choose", "insert", "verify", "finished"};
  const auto index = static_cast<std::size_t>(step);
  return index < kNames.size() ? kNames[index] : std::string_view{"unknown"};
}

}  // namespace carpus::procedure
