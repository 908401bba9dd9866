// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which region of a segmented wrist is which bone, whether the wrist is a left or a right one, and
// where its radius coordinate system lies: by fitting the parametric wrist to the regions. No
// clicks, no orientation tags of the scan.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "geometry/grid.hpp"
#include "geometry/pose.hpp"

namespace carpus::anatomy {

enum class NamingStatus : std::uint8_t {
  Failed,
  Ok,          ///< every bone found, and the fit is as good as on known wrists
  Incomplete,  ///< some bones are missing; the rest fits
  Doubtful,    ///< the fit is worse than on any known wrist: to be checked by a person
  NotAWrist,   ///< names would be guesses
};

/// What one region is.
struct RegionName {
  BoneId bone = BoneId::Radius;
  BonePart part = BonePart::Whole;
  double cost = 0;  ///< misfit of this bone: below 1 good, above 5 suspicious
};

struct BoneNaming {
  NamingStatus status = NamingStatus::Failed;
  Side side = Side::Left;
  std::vector<std::optional<RegionName>> regions;  ///< [label - 1]; empty = no bone
  std::vector<BoneId> missing;
  /// Sum over bones, missing bones and regions without a name, but for those far from the wrist.
  double cost = 0;
  std::size_t far_bodies = 0;  ///< fingers and what else lies beyond the wrist; nameless
  double other_side_cost = 0;  ///< of the best naming as the other side; the margin is confidence
  double scale = 1;            ///< size relative to the model (scaphoid 25.5 mm)
  /// Fitted to the radius (to all bones where there is none). Rigid, never a reflection.
  Pose<frame::Wrist, frame::Patient> wrist_from_patient;
  double radius_misfit_mm = 0;  ///< rms distance between the radius and the model's, when fitted
};

/// A single bone beyond it is to be checked by a person.
inline constexpr double kSuspiciousBoneCost = 5;
/// Of all bones together. Right names on simulated wrists cost 1 to 10, on other adults' 10 to 17;
/// the one wrong naming seen cost 31.
inline constexpr double kDoubtfulNamingCost = 20;

/// Names regions 1..count of `regions`. A scaphoid in two pieces is recognised; a piece too many of
/// another bone gets that bone's name as well, so that both form one bone.
///
/// Cost of a bone: min(d^2 / 25 mm^2, 12) for the distance d of the centroids, 0.5 (log volume
/// ratio / 0.35)^2, the mean of (log extent ratio / 0.2)^2, and 6 if just one of the two is cut by
/// the field of view. Long bones are compared by a joint end, over the length that the scan shows,
/// 17 mm at most; a long bone that is there whole by the end that fits better. The search starts
/// from both sides, 18 postures, and 16 orientations about the main axis, and alternates least-cost
/// assignment and similarity fit, as in iterative closest points [besl1992method].
[[nodiscard]] BoneNaming name_bones(const GridView<const std::uint16_t>& regions,
                                    std::uint16_t count);

}  // namespace carpus::anatomy
