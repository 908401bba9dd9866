// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One bone as it is summed along rays: what it attenuates above soft tissue, less what was drilled
// out of it.
#pragma once

#include <cstdint>
#include <vector>

#include "fluoroscopy/attenuation_volume.hpp"
#include "fluoroscopy/removed_bone.hpp"
#include "fluoroscopy/tissue_split.hpp"

namespace carpus::fluoroscopy {

class MovingBody {
 public:
  explicit MovingBody(BodyPart part);

  /// Takes in what changed inside `changed`, voxels of `removed`; what was taken in before stays.
  /// The hole is filled by what would be there without bone: blood and saline attenuate like soft
  /// tissue. Costs as much as the changed box is large. A grid finer than the scan's is averaged,
  /// a coarser one read trilinearly.
  void set_removed(const RemovedBone& removed, const IndexBox& changed);

  /// Whole again.
  void restore();

  /// Frame Bone.
  [[nodiscard]] const AttenuationVolume& volume() const noexcept { return volume_; }

  /// Counts changes, from 0.
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }

 private:
  Grid<std::int16_t> whole_;
  AttenuationVolume volume_;
  std::uint64_t revision_ = 0;
};

}  // namespace carpus::fluoroscopy
