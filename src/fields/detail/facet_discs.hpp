// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The nearest facet for all points of a block at once: facets that no point of the block can have
// for its nearest are left behind, and what remains is handed on to the block's parts. Of each
// facet the disc around it is asked first: seen from far above a flat surface boxes and balls keep
// every facet within sight, discs only those below the point. Discs are held in single precision,
// one number beside the other, so that several are asked at a time; distances are found from the
// facets themselves, and what rounding could leave out is kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace carpus::fields {

/// A point of a facet, and how far it is from where it was asked for.
struct NearestFacet {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  double squared_distance = 0;  ///< [mm^2]
  std::uint32_t facet = kNone;  ///< kNone: none within the limit
  Vec3 point;                   ///< of the facet [mm]
};

/// The point of a facet nearest to p.
[[nodiscard]] NearestFacet nearest_on(const TriangleMesh& mesh,
                                      std::uint32_t facet,
                                      const Vec3& p) noexcept;

/// Points no farther than `radius` from `centre`, and a facet that is near them.
struct FacetBall {
  Vec3 centre;
  double radius = 0;  ///< [mm]
  NearestFacet near;  ///< to the centre; the nearer, the more is left out
};

/// Some facets of a mesh, each in its circle.
class FacetDiscs {
 public:
  /// All facets of the mesh, which must outlive this.
  /// @param farthest_mm  from the mesh's bounds of any point that is asked for
  FacetDiscs(const TriangleMesh& mesh, double farthest_mm);

  [[nodiscard]] std::size_t size() const noexcept { return facet_.size(); }

  /// The nearest of them within `limit_mm` of p. `hint`, a facet that is probably near, or kNone,
  /// makes it faster; the distance is the least that is computed for any of them either way.
  [[nodiscard]] NearestFacet nearest(const Vec3& p, double limit_mm, std::uint32_t hint);

  /// Into `kept` those that may be the nearest to a point of the ball and within `limit_mm` of it,
  /// and perhaps some more.
  /// @return the one of them that seems nearest to the ball's centre, or kNone.
  std::uint32_t keep_nearest_in(const FacetBall& ball, double limit_mm, FacetDiscs& kept);

 private:
  void resize(std::size_t count);
  /// What `judge` makes of how p is seen from each disc, into lower_.
  template <typename Judge>
  void measure_from(const Vec3& p, Judge judge) noexcept;

  const TriangleMesh* mesh_;
  Vec3 origin_;                                        ///< of the numbers below
  double slack_mm_;                                    ///< of the distances that they say
  double turned_slack_mm_;                             ///< of what they say by directions
  std::vector<float> x_, y_, z_;                       ///< centres [mm]
  std::vector<float> normal_x_, normal_y_, normal_z_;  ///< unit; zero without area: then a ball
  std::vector<float> radius_;
  std::vector<std::uint32_t> facet_;
  std::vector<float> lower_;  ///< scratch
};

}  // namespace carpus::fields
