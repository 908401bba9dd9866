// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Telling a simulated scan from a person's, so that no case made of it passes for a patient's.
#pragma once

#include <filesystem>
#include <string>

namespace carpus::cli {

/// Whether the scan that reconstruct reads is simulated: it says so in its description
/// (case_io::read_description), or has its truth (truth.json) beside it or in the folder above. A
/// file whose header was lost, by conversion for one, and which lies without its truth is not
/// recognised.
/// @throws as case_io::read_ct.
[[nodiscard]] bool is_simulated_scan(const std::filesystem::path& input,
                                     const std::string& series_uid = {});

}  // namespace carpus::cli
