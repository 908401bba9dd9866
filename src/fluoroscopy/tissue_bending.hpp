// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where soft tissue goes when bones move: at a bone it goes with the bone, and between bones by a
// rigid motion between theirs, weighted by distance. Nothing is resampled: a picture asks for the
// sources of a few thousand points along its rays.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/grid.hpp"
#include "geometry/pose.hpp"
#include "geometry/rigid_blend.hpp"

namespace carpus::fluoroscopy {

/// A body of the scan: which voxels are its, and with which others soft tissue sees it as one.
struct BodyLabel {
  std::uint8_t label = 0;
  /// Soft tissue is first shared between segments (forearm and hand), by the nearest body of each,
  /// then between the bodies of a segment. Any number that fits.
  int segment = 0;
};

/// Distances to the bodies, made once a scan.
class TissueBending {
 public:
  TissueBending(const GridView<const std::uint8_t>& labels, std::span<const BodyLabel> bodies);

  [[nodiscard]] std::size_t body_count() const noexcept { return fields_.size(); }

  /// The body nearest to a point of the scan [mm]; nothing where no body has voxels.
  [[nodiscard]] std::optional<std::size_t> nearest_body(const Vec3& scanned) const noexcept;

 private:
  friend class BentTissue;

  struct DistanceField {
    std::size_t segment = 0;  ///< 0, 1, ...
    Grid<float> to_body;      ///< [mm], frame Bone; empty for a body without voxels
  };
  std::vector<DistanceField> fields_;
  std::size_t segments_ = 0;
};

/// The same at given poses. Keeps a reference to the bending.
class BentTissue {
 public:
  /// @param patient_from_bone  one a body, in their order.
  BentTissue(const TissueBending& bending,
             std::span<const Pose<frame::Patient, frame::Bone>> patient_from_bone);

  /// Whether all bodies have moved as one, so that `source_of` is one rigid motion.
  [[nodiscard]] bool is_rigid() const noexcept { return is_rigid_; }

  /// Where the tissue that is at this point now was scanned [mm]. Deterministic; any thread.
  [[nodiscard]] Vec3 source_of(const Point<frame::Patient>& now) const noexcept;

 private:
  const TissueBending& bending_;
  std::vector<Pose<frame::Bone, frame::Patient>> back_;
  std::vector<DualQuaternion> motions_;  ///< the same as back_
  bool is_rigid_ = true;
};

}  // namespace carpus::fluoroscopy
