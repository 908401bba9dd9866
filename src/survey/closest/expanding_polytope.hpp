// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A polytope inside the Minkowski difference that grows where it is nearest to the origin.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/vec3.hpp"
#include "survey/closest/posed_pair.hpp"

namespace carpus::survey {

/// A closed surface of triangles whose corners are points of the difference. If each triangle keeps
/// the origin on its inner side, `height` away, then the ball of the least height lies in the
/// difference: the surface winds about each point of the ball. That holds whether or not the
/// surface is convex, so a surface kept from another pose still proves something at the next one.
///
/// Fixed capacity, reserved at construction. Sources: [vandenbergen2001depth]; growing a hull by
/// one point [barber1996quickhull].
class ExpandingPolytope {
 public:
  static constexpr std::uint16_t kNone = 0xFFFF;

  struct Triangle {
    Vec3 normal;    ///< unit, outwards
    double height;  ///< least of normal . corner: the triangle is no nearer to the origin [mm]
    std::array<std::uint16_t, 3> corners;     ///< counter-clockwise from outside
    std::array<std::uint16_t, 3> neighbours;  ///< [i]: across the edge from corner i to i + 1
  };

  enum class Growth : std::uint8_t {
    Grown,
    Full,    ///< the capacity is used up
    Broken,  ///< rounding: no surface of proper triangles results; the polytope is as it was
  };

  explicit ExpandingPolytope(std::size_t most_corners);

  /// @param corners  of a tetrahedron, in either orientation. False if it is flat.
  [[nodiscard]] bool start(const std::array<DifferencePoint, 4>& corners) noexcept;

  /// Puts the same surface to another pose. False if a triangle became flat.
  [[nodiscard]] bool place(const PosedPair& pair) noexcept;

  /// Adds a point that lies outside of triangle `from`: it replaces all triangles below the point.
  /// What is nearer than `coplanar_mm` to their planes counts as below.
  [[nodiscard]] Growth grow(const DifferencePoint& point,
                            std::uint16_t from,
                            double coplanar_mm) noexcept;

  /// The triangle of least height (negative where the origin is outside).
  [[nodiscard]] std::uint16_t lowest() const noexcept;
  [[nodiscard]] const Triangle& triangle(std::uint16_t t) const noexcept { return triangles_[t]; }
  [[nodiscard]] const DifferencePoint& corner(std::uint16_t c) const noexcept {
    return corners_[c];
  }
  [[nodiscard]] std::size_t corner_count() const noexcept { return corners_.size(); }
  [[nodiscard]] bool is_empty() const noexcept { return corners_.empty(); }
  void clear() noexcept;

 private:
  struct HorizonEdge {
    std::uint16_t from;  // corners, counter-clockwise about what is removed
    std::uint16_t to;
    std::uint16_t outside;  // the triangle that stays
  };

  [[nodiscard]] bool make_plane(Triangle& triangle) const noexcept;
  void find_below(const Vec3& point, std::uint16_t from, double coplanar_mm) noexcept;
  [[nodiscard]] bool order_horizon() noexcept;
  [[nodiscard]] bool make_fan(std::uint16_t apex) noexcept;
  void replace_below() noexcept;
  void remove(std::uint16_t hole) noexcept;

  std::vector<DifferencePoint> corners_;
  std::vector<Triangle> triangles_;
  std::vector<double> heights_;  // as in triangles_, together, for the search of the least
  std::vector<std::uint8_t> is_below_;
  std::vector<std::uint16_t> below_;
  std::vector<HorizonEdge> horizon_;
  std::vector<std::uint16_t> edge_at_;  // by corner: the horizon's edge that leaves it
  std::vector<Triangle> fan_;
  std::size_t most_corners_;
};

}  // namespace carpus::survey
