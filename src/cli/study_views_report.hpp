// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What `carpus study views` prints, writes and draws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "view_trainer/view_study.hpp"

namespace carpus::cli {

struct ViewsStudy {
  std::uint64_t first_seed = 1;
  std::size_t seeds = 0;        ///< screws a case
  std::vector<bool> simulated;  ///< by case
  std::vector<view_trainer::StudiedCase> cases;

  [[nodiscard]] std::vector<view_trainer::StudiedScrew> screws() const;
};

/// Tables for people, with the published findings beside ours and why they differ.
[[nodiscard]] std::string views_study_text(const ViewsStudy& study);

/// docs/json.md.
[[nodiscard]] std::string views_study_json(const ViewsStudy& study);

/// Sensitivity of each set of views by where the screw is out, as SVG.
[[nodiscard]] std::string views_study_picture(const ViewsStudy& study);

}  // namespace carpus::cli
