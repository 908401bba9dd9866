// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The bones about soft tissue: how far away, which way out. Fast by their distance fields, exact by
// their triangles.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "cases/case_data.hpp"
#include "fields/triangle_tree.hpp"

namespace carpus::soft_tissue::detail {

class Surroundings {
 public:
  /// Keeps a reference to the case; makes the distance fields that it lacks.
  explicit Surroundings(const cases::CaseData& data);

  struct Near {
    double distance_mm = 0;  ///< negative inside; at most about the fields' band
    Vec3 outwards;           ///< unit, or zero far from every bone
    std::size_t bone = 0;    ///< of CaseData::bones
  };
  /// Of the nearest bone, within the fields' error (hundredths of a mm where bone is smooth).
  [[nodiscard]] Near near(const Vec3& point) const;

  /// Of one bone.
  [[nodiscard]] double distance_mm(std::size_t bone, const Vec3& point) const;

  /// Signed, by the triangles of the bone; `limit_mm` where it is farther outside.
  [[nodiscard]] double exact_mm(std::size_t bone, const Vec3& point, double limit_mm) const;

  /// The point moved out of all bones until it has so much room; what is wedged stays between.
  [[nodiscard]] Vec3 with_room(Vec3 point, double room_mm) const;

  /// The same by exact distances, for points that are already nearly there.
  [[nodiscard]] Vec3 with_exact_room(Vec3 point, double room_mm) const;

  /// Deepest of the points in any bone [mm], exact; 0 for none.
  [[nodiscard]] double deepest_mm(const std::vector<Vec3>& points) const;

  /// The nearest point of a bone, on all its parts.
  struct OnBone {
    Vec3 point;
    Vec3 outwards;
    std::size_t bone = 0;
  };
  [[nodiscard]] std::optional<OnBone> on_bone(BoneId bone, const Vec3& point) const;

  [[nodiscard]] const cases::CaseData& data() const noexcept { return data_; }
  [[nodiscard]] const fields::TriangleTree& tree(std::size_t bone) const { return trees_[bone]; }

 private:
  [[nodiscard]] const Grid<float>& field(std::size_t bone) const;

  const cases::CaseData& data_;
  std::vector<fields::TriangleTree> trees_;
  std::vector<Grid<float>> own_fields_;  ///< empty where the case has one
  std::vector<Aabb> boxes_;
};

/// Unit normal of a facet.
[[nodiscard]] Vec3 facet_normal(const TriangleMesh& mesh, std::uint32_t facet);

}  // namespace carpus::soft_tissue::detail
