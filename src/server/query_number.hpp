// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace carpus::server {

/// The number that a target's query gives for a name: 0 where it does not, nothing where it is no
/// number, or a negative one.
[[nodiscard]] std::optional<std::int64_t> number_in_query(std::string_view target,
                                                          std::string_view name);

}  // namespace carpus::server
