// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Contact of the guide wire with the bones as they lie: hulls as filter, distance fields of the
// real surfaces for the answer.
#pragma once

#include <array>
#include <cstdint>
#include <deque>

#include "cases/case_data.hpp"
#include "convex/convex_body.hpp"
#include "convex/growth/growth.hpp"
#include "geometry/aabb.hpp"
#include "geometry/vec3.hpp"

namespace carpus::simulation::detail {

inline constexpr std::size_t kMaxBones = 32;

/// The wire's hull is thicker than the wire by this much, so that one answer holds while the tip
/// moves and is pushed by less [mm].
inline constexpr double kHullMarginMm = 1.0;

/// Bones near the wire: what the filter leaves.
struct NearBones {
  std::array<std::uint8_t, kMaxBones> index{};
  std::uint8_t count = 0;
};

/// Where the surface of some bone is, seen from one point.
struct SurfacePoint {
  bool is_near = false;    ///< within the band of some field
  double distance_mm = 0;  ///< signed, to the nearest surface
  Vec3 normal_in_patient;  ///< unit, outwards
  std::uint8_t label = 0;  ///< of that bone
};

/// The wire as a rigid body: its tip and the unit vector from it to the hand.
struct WirePose {
  Vec3 tip;
  Vec3 shaft;
};

/// Result of moving the wire against the bones.
struct Resolved {
  Vec3 tip;
  bool is_free = true;     ///< nothing was touched
  bool is_wedged = false;  ///< could not be pushed out within the bound
};

/// The bones of a posed case, ready for the tick. Holds references to the case.
class BoneContact {
 public:
  explicit BoneContact(const cases::CaseData& posed_case);

  /// Bones whose boxes the wire may meet on its way from `from` to `to`.
  [[nodiscard]] NearBones boxes_near(const WirePose& from, const WirePose& to) const noexcept;

  /// Of these, the bones whose hull meets the wire thickened by kHullMarginMm, exactly: the growth
  /// program on both hulls' facets, warm from the last tick. A bone of which it does not know stays
  /// in.
  [[nodiscard]] NearBones hulls_met(const NearBones& near, const WirePose& wire) noexcept;

  /// The surface nearest to a point among `near`.
  [[nodiscard]] SurfacePoint surface_at(const NearBones& near, const Vec3& point) const noexcept;

  /// The same among all bones; for the wire's tip inside bone.
  [[nodiscard]] SurfacePoint surface_at(const Vec3& point) const noexcept;

  /// Pushes the wire, without turning it, out of every bone that it penetrates.
  [[nodiscard]] Resolved push_out(const NearBones& near, WirePose wire) const noexcept;

 private:
  struct PosedBone {
    PosedBone(const cases::Bone& posed, const convex::ConvexBody& thick_wire);

    const cases::Bone* bone;
    Pose<frame::Bone, frame::Patient> bone_from_patient;
    Aabb box;  ///< of the surface, in Patient
    convex::ConvexBody hull;
    convex::GrowthQuery hull_and_wire;  ///< keeps its last proof, which changes no answer
  };

  /// Deepest penetration of the wire into one bone.
  struct Penetration {
    double depth_mm = 0;
    Vec3 normal_in_patient;
  };
  [[nodiscard]] Penetration deepest_in(const PosedBone& bone, const WirePose& wire) const noexcept;
  [[nodiscard]] SurfacePoint surface_of(const PosedBone& bone, const Vec3& point) const noexcept;

  convex::ConvexBody thick_wire_;
  std::deque<PosedBone> bones_;  ///< never moved: the queries hold references
};

}  // namespace carpus::simulation::detail
