// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A case's pathology.json, as the command and the station change it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "cases/prepared_pathology.hpp"

namespace carpus::cli {

/// Writes it whole or not at all; without one removes it, so that chance decides again.
/// @throws IoError  saying what to do; what was there before is still there.
void write_pathology(const std::filesystem::path& folder,
                     const std::optional<cases::PreparedPathology>& pathology);

/// Labels of the findings that a case has no place to show: an examination takes them as well.
[[nodiscard]] std::vector<std::string> findings_without_place(
    const cases::CaseData& data,
    const cases::PreparedPathology& pathology);

}  // namespace carpus::cli
