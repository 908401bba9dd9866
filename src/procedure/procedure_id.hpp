// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The operations that can be trained.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace carpus::procedure {

enum class ProcedureId : std::uint8_t { DorsalScaphoidFixation = 0 };

/// "dorsal_scaphoid_fixation": as in the protocol, in recordings and records.
[[nodiscard]] constexpr std::string_view name_of(ProcedureId /*id*/) noexcept {
  return "dorsal_scaphoid_fixation";
}
[[nodiscard]] constexpr std::optional<ProcedureId> procedure_of(std::string_view name) noexcept {
  if (name == name_of(ProcedureId::DorsalScaphoidFixation)) {
    return ProcedureId::DorsalScaphoidFixation;
  }
  return std::nullopt;
}

}  // namespace carpus::procedure
