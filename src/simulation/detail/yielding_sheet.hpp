// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A sheet of soft tissue in a joint's wall that yields to tips: the disc, or a ligament between two
// bones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "arthroscopy/bone_interval.hpp"
#include "cases/arthroscopic_map.hpp"
#include "cases/case_data.hpp"
#include "cases/joint_lesions.hpp"
#include "geometry/vec3.hpp"
#include "simulation/snapshot.hpp"
#include "yielding/net.hpp"

namespace carpus::simulation::detail {

struct YieldingSheet {
  yielding::Net net;        ///< frame Bone of `first`; may have no particles
  std::uint8_t first = 0;   ///< body that it goes with
  std::uint8_t second = 0;  ///< ... and the other one; the same where there is but one
  std::uint8_t joint = 0;   ///< in ArthroscopicMap::joints
  std::optional<arthroscopy::BoneInterval> interval;  ///< of its bodies: on its other side
  double half_thick_mm = 0;  ///< its particles lie so deep under what is touched
  double most_gives_mm = 0;  ///< then what lies under it stops a tip
  Vec3 middle;               ///< of a ball about it as scanned, frame Bone of `first`
  double reach_mm = 0;
};

/// The disc is always the first, with particles or without.
inline constexpr std::size_t kDiscSheet = 0;
inline constexpr std::uint8_t kNoSheet = 0xFF;

/// Of a case and an exercise, at most kMaxSheets. They keep the case's distance fields.
[[nodiscard]] std::vector<YieldingSheet> yielding_sheets(const cases::CaseData& data,
                                                         const cases::ArthroscopicMap& map,
                                                         const cases::JointLesions* lesions);

}  // namespace carpus::simulation::detail
