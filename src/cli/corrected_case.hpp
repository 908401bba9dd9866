// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A new version of a case whose bones a person has corrected: what it keeps of the earlier one, and
// what was changed, in words that stay with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "geometry/grid.hpp"
#include "reconstruct/keep_untouched.hpp"

namespace carpus::cli {

/// "lunate"; of a broken scaphoid "scaphoid_proximal".
/// @param label  1 to kScaphoidDistalLabel
[[nodiscard]] std::string name_of_label(std::size_t label, bool is_scaphoid_broken);

/// Whether `folder` is a case, so that its own scan is meant.
[[nodiscard]] bool is_case_folder(const std::filesystem::path& folder);

struct EarlierCase {
  std::string id;  ///< its folder's name; empty where that is not plain, and may say who it is
  std::string pseudonym;
  cases::Provenance provenance;
  reconstruct::EarlierVersion version;
};

/// @throws IoError, InvalidInput where its case.json, labels, surfaces or trust.json cannot be
/// read.
[[nodiscard]] EarlierCase read_earlier_case(const std::filesystem::path& folder);

/// "scaphoid: 12 mm3 added, 3 mm3 taken away", for each bone that differs; by the numbers of
/// anatomy/bone_id.hpp, on one grid.
[[nodiscard]] std::vector<std::string> changes_between(const Grid<std::uint8_t>& before,
                                                       const Grid<std::uint8_t>& after);

}  // namespace carpus::cli
