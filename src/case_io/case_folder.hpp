// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Case folders: a patient's wrist on disk, in the open format of docs/case_format.md.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "case_io/atomic_folder.hpp"
#include "cases/case_data.hpp"
#include "core/progress.hpp"

namespace carpus::case_io {

/// Writes the case whole or not at all: an existing case is replaced only with Overwrite::Replace,
/// in one step, and is not lost when writing fails. Reading it back gives the same values, bit for
/// bit (of a hull: vertices and facets; neighbours and planes are rebuilt).
/// @throws IoError where the folder is in the way or the disk is full; nothing is left behind then.
/// @throws InvalidInput where the case lacks what a case must have (CT, labels, bones).
void write_case(const cases::CaseData& data,
                const std::filesystem::path& folder,
                Overwrite overwrite = Overwrite::Refuse,
                const Progress& progress = no_progress);

/// The files of a case folder that tell of its structures, by name, as they are with those of
/// `data`; to be written in this order. All else in the folder stays as it is.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> structure_files(
    const cases::CaseData& data);

/// Reads a case folder. Every file is checked; none is believed.
/// @throws SchemaError where it was written by a newer program, saying which version.
/// @throws IoError where files are missing or damaged, naming the file and what to do.
[[nodiscard]] cases::CaseData read_case(const std::filesystem::path& folder,
                                        const Progress& progress = no_progress);

}  // namespace carpus::case_io
