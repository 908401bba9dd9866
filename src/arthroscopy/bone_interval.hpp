// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The interval between two bones of a row. Where they lie near each other as scanned, cartilage of
// both fills what is between them, each as far as the middle, and goes with its own bone: whole,
// the interval is closed to every tip, and parted it is as wide as the bones have gone apart.
#pragma once

#include <cstdint>
#include <optional>

#include "cases/arthroscopic_map.hpp"
#include "cases/case_data.hpp"
#include "geometry/grid.hpp"
#include "geometry/pose.hpp"

namespace carpus::arthroscopy {

struct BoneInterval {
  const Grid<float>* first = nullptr;  ///< signed distance to each bone as scanned
  const Grid<float>* second = nullptr;
  double cartilage_mm = 0;  ///< of both bones: farther apart as scanned they have none between them
  std::uint8_t joint = 0;   ///< that it opens into, in ArthroscopicMap::joints
};

/// Between the bones of a ligament, behind it; none where the case lacks the joint there.
/// @param data  is kept: its distance fields are what is asked.
[[nodiscard]] std::optional<BoneInterval> interval_of(const cases::CaseData& data,
                                                      const cases::ArthroscopicMap& map,
                                                      const cases::LigamentBand& band);

/// What a place is to one of both bones.
struct BesideBone {
  /// As this bone has it now both were near each other there: the bone's cartilage, or where the
  /// other one's was.
  bool is_near = false;
  double deep_mm = 0;    ///< from where they were farther apart; negative where it is not near
  double beyond_mm = 0;  ///< of this bone's cartilage: towards the other bone
  Vec3 across;           ///< unit, frame Patient: towards the other bone ...
  Vec3 to_mouth;         ///< ... and to where they are farther apart
};

/// @param bone  into its frame. Real-time, as in_interval.
[[nodiscard]] BesideBone beside_bone(const Grid<float>& own,
                                     const Grid<float>& other,
                                     double cartilage_mm,
                                     const Pose<frame::Bone, frame::Patient>& bone,
                                     const Vec3& at) noexcept;

/// A ball in it.
struct InInterval {
  /// Between both bones, which have parted far enough for it.
  bool is_between = false;
  double depth_mm = 0;  ///< in cartilage; 0: in none
  Vec3 out;             ///< unit, the way out of that, frame Patient; zero where it is in none
  /// Where it is beside such a place, so far, and which way back; 0 where it is not.
  double off_mm = 0;
  Vec3 back;
};

/// @param first, second  into frame Bone of both bodies
/// Real-time: no allocation, bounded, only + - * / and sqrt.
[[nodiscard]] InInterval in_interval(const BoneInterval& interval,
                                     const Pose<frame::Bone, frame::Patient>& first,
                                     const Pose<frame::Bone, frame::Patient>& second,
                                     const Vec3& at,
                                     double radius_mm) noexcept;

}  // namespace carpus::arthroscopy
