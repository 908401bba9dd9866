// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Size, place and proportions of a body: what bones are recognised by.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "anatomy/joint_end.hpp"
#include "geometry/aabb.hpp"
#include "geometry/grid.hpp"
#include "geometry/vec3.hpp"

namespace carpus::anatomy {

/// Sums over equal pieces of a body; those of two bodies add up to those of both.
struct Moments {
  double count = 0;
  Vec3 sum;
  std::array<double, 6> products{};  ///< xx yy zz xy xz yz

  void add(const Vec3& p) noexcept;
  void add(const Moments& other) noexcept;
};

/// A long bone whose shaft leaves the scan (or the model) is measured by its joint end only, at
/// most this long, so that the field of view does not change its shape. The model's metacarpals end
/// there.
inline constexpr double kJointEndLength = 17.0;

struct BodyShape {
  Moments moments;        ///< of the joint end, if cut
  double piece_mm3 = 0;   ///< volume of one piece
  bool is_cut = false;    ///< a shaft leaves the volume
  Aabb bounds;            ///< of the whole body
  std::vector<Vec3> rim;  ///< some points of its border
  double volume_mm3 = 0;  ///< of the joint end, if cut
  Vec3 centroid;          ///< likewise
  Vec3 extents;           ///< standard deviations along the principal axes, greatest first [mm]
  /// Where it could be a long bone: its joint end if it is cut, both ends if all of it is there.
  std::vector<JointEnd> ends;
};

/// Fills volume, centroid and extents from the moments.
void summarise(BodyShape& shape) noexcept;

/// Shapes of regions 1..count of `labels`, in that order, in the Patient frame [mm]. A region is
/// cut when it meets the faces of the volume over more than 20 mm^2.
[[nodiscard]] std::vector<BodyShape> measure_shapes(const GridView<const std::uint16_t>& labels,
                                                    std::uint16_t count);

/// Two bodies as one; neither may be cut.
[[nodiscard]] BodyShape joined(const BodyShape& a, const BodyShape& b);

/// Least distance between the borders [mm], to the spacing of the rim points.
[[nodiscard]] double gap_between(const BodyShape& a, const BodyShape& b);

}  // namespace carpus::anatomy
