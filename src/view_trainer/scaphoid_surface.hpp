// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The truth about a screw: how far its metal stands out of the scaphoid's own triangles, and where.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "anatomy/bone_solid.hpp"
#include "cases/case_data.hpp"
#include "fields/exact_surface.hpp"
#include "fields/triangle_tree.hpp"
#include "view_trainer/placed_screw.hpp"

namespace carpus::view_trainer {

/// Which part of the scaphoid: within kPoleMm of the screw's end at that pole, else its side.
enum class Region : std::uint8_t { Distal = 0, Proximal = 1, Side = 2 };
inline constexpr double kPoleMm = 3.0;

/// The place of a screw's metal that is farthest out.
struct Protrusion {
  double depth_mm =
      0.0;  ///< distance to the outer surface; negative: the least bone that covers it
  Vec3 at;  ///< frame Bone
  Region region = Region::Side;
};

/// A screw whose metal stands out by more than this is out [mm]: what the score fails. Less is
/// within the cartilage, 0.5 to 1 mm thick, and reaches no other bone.
inline constexpr double kOutMm = 0.5;

/// The scaphoid of a case as scanned, whole or in fragments with the gap between them closed
/// (anatomy/bone_solid.hpp). Fracture faces are no outside.
class ScaphoidSurface {
 public:
  /// @param data  must outlive it. @throws InvalidInput where it has no scaphoid.
  explicit ScaphoidSurface(const cases::CaseData& data);

  [[nodiscard]] const cases::CaseData& data() const noexcept { return data_; }
  [[nodiscard]] const BoneSolid& solid() const noexcept { return solid_; }
  [[nodiscard]] const std::vector<const cases::Bone*>& fragments() const noexcept {
    return fragments_;
  }

  /// To the outer surface's triangles, negative inside a fragment or the bridged gap [mm].
  [[nodiscard]] double signed_distance(const Vec3& point) const;

  /// Of the screw's envelope, a cone with flat ends over the thread's crests; to about 0.01 mm.
  [[nodiscard]] Protrusion protrusion_of(const PlacedScrew& placed) const;

  /// Points of the bridged gap, at most 0.3 mm apart; none in a whole bone.
  [[nodiscard]] const std::vector<Vec3>& gap_points() const noexcept { return gap_points_; }

  /// The bone beside the scaphoid that is nearest to a point, in words; empty beyond 3 mm.
  [[nodiscard]] std::string neighbour_at(const Vec3& point) const;

 private:
  [[nodiscard]] bool is_inside_a_fragment(const Vec3& point) const;
  void find_gap();

  const cases::CaseData& data_;
  std::vector<const cases::Bone*> fragments_;
  BoneSolid solid_;
  std::vector<fields::ExactSurface> exact_;
  TriangleMesh all_;                       ///< the fragments' triangles
  std::vector<std::uint8_t> is_fracture_;  ///< by triangle of all_
  fields::TriangleTree all_tree_;
  fields::TriangleTree outer_tree_;
  std::vector<Vec3> gap_points_;
};

}  // namespace carpus::view_trainer
