// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The soft tissue of a case on disk: `soft_tissue/` in the case's folder (docs/case_format.md).
#pragma once

#include <filesystem>
#include <optional>

#include "cases/case_data.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::case_io {

inline constexpr const char* kSoftTissueFolder = "soft_tissue";

/// Writes the folder into the case's, whole or not at all; one that is there is replaced in one
/// step.
/// @throws IoError where the case's folder is not there or the disk is full.
void write_soft_tissue(const soft_tissue::SoftTissue& tissue,
                       const cases::CaseData& data,
                       const std::filesystem::path& case_folder);

/// What write_soft_tissue wrote; empty where the case has none. Every file is checked.
/// @throws SchemaError where it was written by a newer program, IoError where files are missing or
///     damaged.
[[nodiscard]] std::optional<soft_tissue::SoftTissue> read_soft_tissue(
    const std::filesystem::path& case_folder);

}  // namespace carpus::case_io
