// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A joint's place in the map by its id.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "cases/arthroscopic_map.hpp"

namespace carpus::arthroscopy::detail {

/// None where the map does not have it.
[[nodiscard]] inline std::optional<std::uint8_t> joint_of(const cases::ArthroscopicMap& map,
                                                          const std::string& id) {
  for (std::size_t j = 0; j < map.joints.size(); ++j) {
    if (map.joints[j].id == id) return static_cast<std::uint8_t>(j);
  }
  return std::nullopt;
}

}  // namespace carpus::arthroscopy::detail
