// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cases/case_data.hpp"

namespace carpus::cli {

/// Puts the structures of `data` into its folder in place of those that are there; all else of the
/// folder stays as it is. Each file whole or not at all.
void write_structures(const cases::CaseData& data, const std::filesystem::path& folder);

}  // namespace carpus::cli
