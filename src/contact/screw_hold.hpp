// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a screw holds: the bone that its thread can bite, between core and crest, and how much of it
// drilling, a second pass or stripping has left.
#pragma once

#include <cstdint>

#include "fields/cut_bone.hpp"
#include "geometry/grid.hpp"
#include "geometry/instrument_shape.hpp"
#include "geometry/pose.hpp"
#include "geometry/swept_tool.hpp"

namespace carpus::contact {

/// A thread in one body.
struct ScrewHold {
  /// Bone between core and crest, each part weighted by its density: what 1 mm^3 of bone at
  /// kDenseHu counts for is 1 [mm^3].
  double bone_mm3 = 0;
  /// The same had nothing been removed.
  double whole_mm3 = 0;
  /// Along the thread that has at least half its ring in what is left [turns].
  double turns = 0;

  /// Share of the hold that is left, 0 to 1; 0 outside any bone.
  [[nodiscard]] double share() const noexcept { return whole_mm3 > 0 ? bone_mm3 / whole_mm3 : 0; }
};

/// Bone of full weight [HU]: cortical shells of carpal bones begin about here [clinical: B11 K].
inline constexpr double kDenseHu = 1000.0;

/// Looks at fixed places of the ring between core and crest: 12 around, 3 out, each 0.5 mm or less
/// along the threaded length.
/// @param left  the body; ct: density as scanned, Patient of its geometry being frame Bone [HU].
/// @param bone_from_screw  of the screw's foremost point, +z towards its head.
/// Safe in the step (no allocation, only + - * / and sqrt), but 0.1 ms for 24 mm: ask when the
/// screw has turned, not each tick.
[[nodiscard]] ScrewHold screw_hold(const fields::CutBone& left,
                                   const GridView<const std::int16_t>& ct,
                                   const ThreadedCylinderShape& screw,
                                   const Pose<frame::Bone, frame::Tool>& bone_from_screw) noexcept;

/// What turning on in place takes away: the thread shears what it bit.
/// @param share  of the thread's depth, 0 to 1.
[[nodiscard]] SweptTool stripped_thread(const ThreadedCylinderShape& screw,
                                        const Pose<frame::Bone, frame::Tool>& bone_from_screw,
                                        double share) noexcept;

/// Headless variable-pitch screws pressed 16 cadaver scaphoids together with up to 103.9 +- 33.2 N;
/// more turns stripped them [clinical: B3 E, from S49].
inline constexpr double kGreatestCompressionN = 100.0;
/// Of the peak, once the bone has settled for 120 to 150 s: 68.6 of 103.9 N [clinical: B3, S49].
inline constexpr double kSettledCompressionShare = 0.66;

/// Compression at which the thread strips [N]: the weaker of the two ends decides.
/// @param tip_share, tail_share  ScrewHold::share() of the parts on either side of the gap.
[[nodiscard]] double stripping_compression_n(double tip_share, double tail_share) noexcept;

}  // namespace carpus::contact
