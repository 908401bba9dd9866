// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/json_fields.hpp"

namespace carpus::procedure::detail {

inline constexpr int kFirstPlace = 1;
inline constexpr int kLastPlace = 31;

/// Places of the tour by their numbers, at least one.
/// @throws InvalidInput naming the field.
[[nodiscard]] std::vector<std::uint8_t> read_tour_places(JsonFields& fields,
                                                         const std::string& field,
                                                         std::size_t most);

}  // namespace carpus::procedure::detail
