// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where wire and screw lie in the scaphoid: the geometry under the score. Frame Bone of the
// scaphoid, which is Patient as scanned.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "anatomy/bone_solid.hpp"
#include "cases/case_data.hpp"
#include "instruments/instrument.hpp"
#include "procedure/situation.hpp"

namespace carpus::procedures::scaphoid_fixation {

/// The pole through which wire and screw go in.
enum class Approach : std::uint8_t { FromProximal = 0, FromDistal = 1 };

/// How far the wire runs beside the central axis at one level of it.
struct Offset {
  double distance_mm = 0.0;
  double local_width_mm = 0.0;  ///< diameter of the circle with the section's area
};

/// Line of the wire against the central axis.
struct LinePlacement {
  double angle_deg = 0.0;
  double angle_to_longest_deg = 0.0;
  Offset at_waist;
  Offset at_proximal;  ///< at a sixth of the axis from the proximal end
  Offset at_distal;    ///< at a sixth from the distal end
  LineInterval chord;  ///< of the wire's line inside the scaphoid, from the entry along it [mm]
};

/// A screw on that line.
struct ScrewPlacement {
  double tail_cover_mm = 0.0;   ///< bone over its tail along the line, negative: stands out
  double tip_cover_mm = 0.0;    ///< bone before its tip
  double penetration_mm = 0.0;  ///< how far any part of it stands out of the bone
  std::string penetration_at;   ///< where, in words; empty when nowhere
};

/// Nothing when the line misses the scaphoid.
[[nodiscard]] std::optional<LinePlacement> place_line(const BoneSolid& scaphoid,
                                                      const cases::ScaphoidLandmarks& landmarks,
                                                      Approach approach,
                                                      const Vec3& entry,
                                                      const Vec3& direction);

/// @param lain  the screw's line.
[[nodiscard]] ScrewPlacement place_screw(const BoneSolid& scaphoid,
                                         const cases::CaseData& data,
                                         const LinePlacement& line,
                                         Approach approach,
                                         const procedure::LineFacts& lain);

}  // namespace carpus::procedures::scaphoid_fixation
