// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Strands of ligaments as lines of force between rigid bodies: straight from anchor to anchor, pull
// only, slack where shorter than at rest.
#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "cases/case_data.hpp"
#include "soft_tissue/detail/wrist_bodies.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::soft_tissue::detail {

struct ForceLine {
  static constexpr std::size_t kNoLigament = static_cast<std::size_t>(-1);
  std::size_t ligament = 0;                          ///< of the tissue's
  std::vector<std::pair<std::size_t, Vec3>> points;  ///< body, and place as scanned
  double rest_mm = 0;
  double stiffness_n_per_mm = 0;
};

/// Of every strand, times the table's; and how much longer than in the scan it gets before it
/// pulls.
struct LineOptions {
  double stiffness_factor = 1;
  double radiocarpal_slack_mm = 0;                 ///< groups radiocarpal and ulnocarpal
  double midcarpal_slack_mm = 0;                   ///< group midcarpal
  std::span<const std::string_view> without = {};  ///< beginnings of ids of cut ligaments
  /// Held where a strand touches a bone on its way, each stretch a line of its own, as stiff as the
  /// same strand that much shorter; else the strand slides there.
  bool is_held_on_its_way = false;
};

[[nodiscard]] std::vector<ForceLine> make_force_lines(const cases::CaseData& data,
                                                      const SoftTissue& tissue,
                                                      const LineOptions& options);

[[nodiscard]] double length_as_scanned(const ForceLine& line) noexcept;
[[nodiscard]] double length_now(const ForceLine& line, const Bodies& bodies) noexcept;

/// The lines' energy and pull, added.
void pull_lines(std::span<const ForceLine> lines, const Bodies& bodies, Load& load) noexcept;

}  // namespace carpus::soft_tissue::detail
