// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// pathology.json, what an instructor prepared to be wrong in a case's joints
// (cases/prepared_pathology.hpp, docs/case_format.md). A case need not have it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cases/prepared_pathology.hpp"

namespace carpus::case_io {

inline constexpr const char* kPathologyFile = "pathology.json";

[[nodiscard]] std::string pathology_text(const cases::PreparedPathology& pathology);

/// @throws InvalidInput naming `file` and field, and for a finding or grade that there is not,
/// which there are.
/// @throws SchemaError where a newer program wrote it.
[[nodiscard]] cases::PreparedPathology parse_pathology(const std::string& text,
                                                       const std::string& file);

/// Of a case folder; nothing where it has none.
/// @throws as parse_pathology; IoError where it cannot be read.
[[nodiscard]] std::optional<cases::PreparedPathology> read_pathology(
    const std::filesystem::path& folder);

}  // namespace carpus::case_io
