// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A wrist with ligaments cut, on the bench: tables for people, and as JSON.
#pragma once

#include <string>
#include <string_view>

#include "soft_tissue/sectioning.hpp"
#include "soft_tissue/sectioning_check.hpp"

namespace carpus::cli {

/// Ranges, bones held in place, and the published statements with what this wrist says to each.
[[nodiscard]] std::string section_table(const soft_tissue::SectioningResult& result,
                                        const soft_tissue::SectioningTable& table);

/// docs/json.md, "Sectioned ligaments". With every step of every curve.
[[nodiscard]] std::string section_json(const soft_tissue::SectioningResult& result,
                                       const soft_tissue::SectioningTable& table,
                                       std::string_view pseudonym,
                                       bool is_simulated);

}  // namespace carpus::cli
