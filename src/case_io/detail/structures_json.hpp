// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// structures.json of a case folder (docs/case_format.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/structures.hpp"

namespace carpus::case_io {

inline constexpr const char* kStructuresFile = "structures.json";

[[nodiscard]] std::string structures_text(const std::vector<cases::Structure>& structures);

/// @throws SchemaError where a newer program wrote it, IoError where it is damaged, both naming
///     `file` and what to do.
[[nodiscard]] std::vector<cases::Structure> parse_structures(const std::string& text,
                                                             const std::filesystem::path& file);

}  // namespace carpus::case_io
