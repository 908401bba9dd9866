// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where wire and screw lie in the scaphoid: the geometry under the score. Frame Bone of the
// scaphoid, which is Patient as scanned.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "procedure/situation.hpp"
#include "procedures/scaphoid_fixation/outer_bone.hpp"

namespace carpus::procedures::scaphoid_fixation {

/// The pole through which wire and screw go in.
enum class Approach : std::uint8_t { FromProximal = 0, FromDistal = 1 };

/// How far a line runs beside the middle of the bone at one level of its axis.
struct Offset {
  double distance_mm = 0.0;     ///< from the centroid of the bone's section
  double local_width_mm = 0.0;  ///< diameter of the circle with the section's area
  std::string towards;          ///< "volar and radial": where it lies from the middle

  [[nodiscard]] double percent_of_width() const noexcept {
    return local_width_mm > 0.0 ? 100.0 * distance_mm / local_width_mm : 100.0;
  }
};

/// A line through the bone.
struct LinePlacement {
  double angle_deg = 0.0;  ///< to the central axis
  double angle_to_longest_deg = 0.0;
  Offset at_waist;
  Offset at_proximal;  ///< at a sixth of the axis from the proximal end
  Offset at_distal;    ///< at a sixth from the distal end
  LineInterval chord;  ///< of the line inside the scaphoid, from the entry along it [mm]
  /// Bone that lies before the line's far end, so whose joint it comes into; empty: none within 3
  /// mm
  std::string leaves_towards;

  [[nodiscard]] double length_mm() const noexcept { return chord.leave_mm - chord.enter_mm; }
};

/// A screw on that line.
struct ScrewPlacement {
  double tail_cover_mm = 0.0;       ///< bone over its tail along the line, negative: stands out
  double tip_cover_mm = 0.0;        ///< bone before its tip
  double penetration_mm = 0.0;      ///< how far any part of it stands out of the bone
  std::string penetration_at;       ///< where, in words; empty when nowhere
  double beside_mm = 0.0;           ///< least bone beside it along its middle
  double in_smaller_part_mm = 0.0;  ///< of its length, in the fragment that holds less of it
};

/// A bone as its pieces lie, frame Bone of one of them, and what is measured against.
struct LyingBone {
  std::vector<MeshIn<frame::Bone>> pieces;
  OuterBone bone;
  cases::ScaphoidLandmarks marks;
};

/// @param marks  of the pieces.
[[nodiscard]] LyingBone lying_bone(std::vector<MeshIn<frame::Bone>> pieces,
                                   const cases::ScaphoidLandmarks& marks);

/// Nothing when the line misses the scaphoid.
[[nodiscard]] std::optional<LinePlacement> place_line(const LyingBone& scaphoid,
                                                      const cases::CaseData& data,
                                                      Approach approach,
                                                      const Vec3& entry,
                                                      const Vec3& direction);

/// @param lain  the screw's line.
[[nodiscard]] ScrewPlacement place_screw(const LyingBone& scaphoid,
                                         const cases::CaseData& data,
                                         const LinePlacement& line,
                                         Approach approach,
                                         const procedure::LineFacts& lain);

}  // namespace carpus::procedures::scaphoid_fixation
