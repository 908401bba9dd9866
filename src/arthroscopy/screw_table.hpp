// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a screw that is to be controlled may lie, and what is asked of it (data/screw_control.json).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "arthroscopy/pathology_table.hpp"
#include "cases/controlled_screw.hpp"

namespace carpus::arthroscopy {

struct ScrewTable {
  std::array<double, cases::kScrewFaults> chances{};  ///< 1 in all
  std::array<double, 2> proud_mm{};                   ///< an end, least and most
  std::array<double, 2> thread_proud_mm{};
  std::array<double, 2> buried_mm{};
  double flush_share = 0.0;  ///< of ends that are not proud
  double cover_mm = 0.0;     ///< bone that is meant at either end
  PathologyTable questions;  ///< the sites in their order, then the decision

  /// @throws InvalidInput naming what is wrong.
  [[nodiscard]] static ScrewTable parse(std::string_view json_text);
  /// The built-in table; parsed at the first call.
  [[nodiscard]] static const ScrewTable& generic();
};

/// What is asked besides the sites, and the grades of the answers, by their places in the table.
inline constexpr std::size_t kScrewDecision = cases::kScrewSites;
enum class EndGrade : std::uint8_t { Buried = 0, Flush = 1, Proud = 2 };
enum class SurfaceGrade : std::uint8_t { Covered = 0, Proud = 1 };
enum class DecisionGrade : std::uint8_t { Leave = 0, Deeper = 1, Exchange = 2 };

/// Whether an answer says that the screw stands out at a site.
[[nodiscard]] constexpr bool says_proud(std::size_t site, std::uint8_t grade) noexcept {
  return grade == (site == 0 ? static_cast<std::uint8_t>(EndGrade::Proud)
                             : static_cast<std::uint8_t>(SurfaceGrade::Proud));
}

}  // namespace carpus::arthroscopy
