// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The bones of a case as bodies that move in groups: who comes near whom, and how deep.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "anatomy/carpal_kinematics.hpp"
#include "cases/case_data.hpp"
#include "geometry/aabb.hpp"
#include "geometry/pose.hpp"

namespace carpus::cases::detail {

/// Motion of each group from the scan, by CarpalGroup.
using GroupPoses = std::array<Pose<frame::Patient, frame::Bone>, anatomy::kCarpalGroupCount>;

/// A surface vertex of one bone that is near another bone.
struct NearPoint {
  std::size_t on = 0;  ///< the bone whose vertex it is
  std::size_t to = 0;  ///< the bone that it is near
  Vec3 point;          ///< frame Bone of `on` [mm]
};

/// How far a point is from a bone's surface.
struct Separation {
  double distance_mm = 0;  ///< negative inside
  Vec3 outward;  ///< unit, out of the bone, frame Patient; zero where the field is clamped
};

class BoneScene {
 public:
  /// Keeps references into `data`, which must outlive it.
  explicit BoneScene(const CaseData& data);

  [[nodiscard]] std::size_t size() const noexcept { return bodies_.size(); }
  [[nodiscard]] anatomy::CarpalGroup group_of(std::size_t body) const noexcept {
    return bodies_[body].group;
  }
  /// The middle of a group's vertices as scanned; zero for a group without bones.
  [[nodiscard]] const Vec3& middle_of(anatomy::CarpalGroup group) const noexcept {
    return middles_[static_cast<std::size_t>(group)];
  }
  /// Whether the case has bones of this group.
  [[nodiscard]] bool has(anatomy::CarpalGroup group) const noexcept;
  /// Smallest distance of two bones' surfaces in the scan [mm], negative where they overlap; at
  /// most kFarMm.
  [[nodiscard]] double scan_gap_mm(std::size_t a, std::size_t b) const noexcept {
    return scan_gaps_[a * bodies_.size() + b];
  }

  /// Vertices of bones within `margin_mm` of (or inside) a bone of another group.
  [[nodiscard]] std::vector<NearPoint> near_points(const GroupPoses& poses, double margin_mm) const;

  [[nodiscard]] Separation separation_of(const NearPoint& near,
                                         const GroupPoses& poses) const noexcept;

  /// Deepest overlap of two bones of different groups beyond that of the scan [mm]; 0 for none.
  [[nodiscard]] double overlap_mm(const GroupPoses& poses) const;
  /// Deepest overlap within the scan [mm].
  [[nodiscard]] double scan_overlap_mm() const;

  /// What counts as far: the least band of the fields.
  static constexpr double kFarMm = 3.0;

 private:
  /// Vertices that follow each other lie beside each other.
  static constexpr std::size_t kRunVertices = 32;
  struct Body {
    anatomy::CarpalGroup group = anatomy::CarpalGroup::Ulna;
    const Bone* bone = nullptr;
    Aabb box;
    std::vector<Aabb> runs;  ///< of kRunVertices vertices each, in the surface's order
  };
  template <typename Visit>
  void visit_near(const GroupPoses& poses, double margin_mm, const Visit& visit) const;

  std::vector<Body> bodies_;
  std::vector<double> scan_gaps_;
  std::array<Vec3, anatomy::kCarpalGroupCount> middles_{};
};

}  // namespace carpus::cases::detail
