// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The oracle: a CT resampled for a pose of the bones, as slow and as plain as can be. Each voxel
// asks which bone now lies there and else where its tissue came from; the composition must look the
// same without any of it.
#pragma once

#include <span>
#include <vector>

#include "cases/case_data.hpp"
#include "fluoroscopy/tissue_bending.hpp"

namespace carpus::bench {

/// The bones of a scan, each with what is within 1.2 mm of it: what moves rigidly.
class RigidBones {
 public:
  explicit RigidBones(const cases::CaseData& data);

  /// HU on a grid that holds all of it with the bones at these poses and soft tissue bent between
  /// them.
  [[nodiscard]] Grid<std::int16_t> resampled_ct(
      const fluoroscopy::TissueBending& bending,
      std::span<const Pose<frame::Patient, frame::Bone>> patient_from_bone) const;

  /// 1000 HU where bones lie in the same place, though not as scanned, air elsewhere. The resampled
  /// CT holds one of the two there, the composition both.
  [[nodiscard]] Grid<std::int16_t> bones_in_one_place(
      std::span<const Pose<frame::Patient, frame::Bone>> patient_from_bone) const;

 private:
  /// Of a bone at a place where it was scanned [mm]; far where it is farther than the margin.
  [[nodiscard]] double distance_mm(std::size_t bone, const Vec3& scanned) const;
  [[nodiscard]] bool is_anothers(std::size_t bone, const Vec3& scanned) const;
  [[nodiscard]] bool is_in_bone(const Vec3& scanned) const;

  const cases::CaseData& data_;
  std::vector<Grid<float>> distances_;  ///< around each bone
};

}  // namespace carpus::bench
