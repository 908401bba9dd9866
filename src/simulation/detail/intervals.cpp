// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/intervals.hpp"

namespace carpus::simulation::detail {

bool lies_behind(const YieldingSheet& sheet, std::uint8_t joint) noexcept {
  return sheet.interval && sheet.interval->joint == joint;
}

arthroscopy::InInterval in_intervals(std::span<const YieldingSheet> sheets,
                                     std::span<const Pose<frame::Bone, frame::Patient>> inverses,
                                     std::uint8_t joint,
                                     const Vec3& middle,
                                     double radius_mm) noexcept {
  arthroscopy::InInterval deepest;
  for (const YieldingSheet& sheet : sheets) {
    if (!lies_behind(sheet, joint)) continue;
    const arthroscopy::InInterval made = arthroscopy::in_interval(
        *sheet.interval, inverses[sheet.first], inverses[sheet.second], middle, radius_mm);
    if (made.depth_mm > deepest.depth_mm) {
      deepest.depth_mm = made.depth_mm;
      deepest.out = made.out;
    }
    deepest.is_between = deepest.is_between || made.is_between;
    if (made.off_mm > 0.0) {
      deepest.off_mm = made.off_mm;
      deepest.back = made.back;
    }
  }
  return deepest;
}

bool leads_back(const arthroscopy::InInterval& interval,
                double off_mm,
                bool is_wall_near) noexcept {
  return interval.off_mm > 0.0 && (interval.off_mm < off_mm || !is_wall_near);
}

}  // namespace carpus::simulation::detail
