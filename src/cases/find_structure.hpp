// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One of a case's tendons, arteries and nerves by its id, and what a case lacks of those that are
// asked for: cases of older programs have fewer.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cases/structures.hpp"

namespace carpus::cases {

/// The one with this id (data/structures.json), or nullptr.
[[nodiscard]] const Structure* find_structure(const std::vector<Structure>& structures,
                                              std::string_view id) noexcept;

/// Of these ids those that are not there, as a person says them: "ulnar artery, ulnar nerve"; empty
/// where all are.
[[nodiscard]] std::string lacking(const std::vector<Structure>& structures,
                                  const std::vector<std::string>& ids);

/// Likewise of all that this program knows; the scan may have had no room for some of it.
[[nodiscard]] std::string lacking(const std::vector<Structure>& structures);

}  // namespace carpus::cases
