// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Live fluoroscopy of a hand whose bones move: takes one picture after the other and keeps what has
// not changed since the last one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fluoroscopy/composed_projector.hpp"
#include "fluoroscopy/metal.hpp"

namespace carpus::fluoroscopy {

/// What is in the beam for one picture. Views of arrays that need only live during the call.
struct BeamScene {
  CArmPose pose;
  std::span<const Pose<frame::Patient, frame::Bone>> patient_from_bone;  ///< one a body, in order
  std::span<const MetalCylinder> metal;                                  ///< frame Patient, now
};

/// One thread at a time; rows are shared through parallel_for. What is kept never shows: the same
/// scene, removed bone and exposure give the same bytes whatever was taken before.
class ComposedRenderer {
 public:
  /// As ComposedProjector.
  ComposedRenderer(const GridView<const std::int16_t>& ct,
                   const GridView<const std::uint8_t>& labels,
                   std::span<const BodyLabel> bodies)
      : projector_(ct, labels, bodies) {}

  [[nodiscard]] const ComposedProjector& projector() const noexcept { return projector_; }

  /// Takes in what an instrument took out of a body since the last call: voxels of `changed`.
  void set_removed(std::size_t body, const RemovedBone& removed, const IndexBox& changed) {
    projector_.set_removed(body, removed, changed);
  }
  /// The body is whole again.
  void restore(std::size_t body) { projector_.restore(body); }

  /// One picture.
  /// @throws InvalidInput unless there is one pose a body.
  [[nodiscard]] Image render(const BeamScene& scene, const Exposure& exposure);

  /// The attenuation behind it.
  [[nodiscard]] AttenuationMap project(const BeamScene& scene, double tube_kv = 60.0);

  /// Bodies whose shadows were computed anew for the last picture, of those there are; soft tissue
  /// counts as one more.
  [[nodiscard]] std::size_t redone() const noexcept { return redone_; }

 private:
  struct BodyLayer {
    Pose<frame::Patient, frame::Bone> patient_from_bone;
    std::uint64_t revision = 0;
    PictureLayer layer;
  };

  ComposedProjector projector_;
  std::optional<CArmPose> pose_;  ///< what the layers are of
  AttenuationMap soft_tissue_;
  std::vector<BodyLayer> bodies_;
  AttenuationMap sum_;  ///< of both, at `sum_kv_`
  double sum_kv_ = 0.0;
  std::size_t redone_ = 0;
};

}  // namespace carpus::fluoroscopy
