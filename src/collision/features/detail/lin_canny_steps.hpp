// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The steps of [lin1991incremental]: nearest points of the pair, tested against the other
// feature's region. The paper's pairs of two faces, or of a face and an edge parallel to it, hold
// no nearer points than their boundaries do; so an edge over a face passes on to these, and two
// faces never meet in a pair.
#pragma once

#include <cstddef>

#include "collision/features/detail/edge_face.hpp"
#include "collision/features/detail/placement.hpp"
#include "collision/features/detail/regions.hpp"
#include "collision/features/detail/segments.hpp"
#include "collision/features/detail/vertex_steps.hpp"
#include "collision/features/feature_pair.hpp"

namespace carpus::collision::detail {

struct LinCannySteps {
  [[nodiscard]] static Step step(const FixedBody& first,
                                 const MovedBody& second,
                                 FeaturePair& pair) noexcept {
    if (pair.first.kind <= pair.second.kind) {
      return ordered(first, pair.first, second, pair.second);
    }
    return ordered(second, pair.second, first, pair.first);
  }

 private:
  template <typename Near, typename Far>
  [[nodiscard]] static Step ordered(const Near& near,
                                    Feature& a,
                                    const Far& far,
                                    Feature& b) noexcept {
    if (a.kind == FeatureKind::Edge) {
      return b.kind == FeatureKind::Edge ? edge_edge(near, a, far, b)
                                         : step_edge_face(near, a, far, b);
    }
    if (b.kind == FeatureKind::Vertex) return step_vertex_vertex(near, a, far, b);
    if (b.kind == FeatureKind::Edge) return step_vertex_edge(near, a, far, b);
    return vertex_face(near, a, far, b);
  }

  template <typename Near, typename Far>
  [[nodiscard]] static Step edge_edge(const Near& near,
                                      Feature& a,
                                      const Far& far,
                                      Feature& b) noexcept {
    const EdgeRegion region_a = region_of_edge(near, a);
    const EdgeRegion region_b = region_of_edge(far, b);
    const SegmentPair points =
        nearest_points({region_a.tail, region_a.along}, {region_b.tail, region_b.along});
    if (moves_to(a, leave_edge(region_a, a, points.on_second))) return Step::Continue;
    if (moves_to(b, leave_edge(region_b, b, points.on_first))) return Step::Continue;
    return Step::Apart;
  }

  template <typename Near, typename Far>
  [[nodiscard]] static Step vertex_face(const Near& near,
                                        Feature& vertex,
                                        const Far& far,
                                        Feature& face) noexcept {
    const Vec3 at = near.vertex(vertex.id);
    const double height = height_over(far, face.id, at);
    if (height <= 0) return follow_cones(at, far, face);
    if (moves_to(face, leave_face(far, face.id, at))) return Step::Continue;
    if (moves_to(vertex, edge_towards(near, vertex.id, far, face.id, true))) return Step::Continue;
    return Step::Apart;
  }

  /// One step between the cones from the interior point over the faces, towards the one in which
  /// the point lies [ponamgi1995incremental] Called with the point below the face.
  template <typename Far>
  [[nodiscard]] static Step follow_cones(const Vec3& at, const Far& far, Feature& face) noexcept {
    const VoronoiFeatures& features = *far.features;
    const Vec3 ray = far.own_point(at) - features.interior_point();
    const std::span<const VoronoiFeatures::Side> sides = features.sides(face.id);
    double worst = 0;
    std::size_t slot = sides.size();
    Vec3 corner = features.vertex(sides.back().corner) - features.interior_point();
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const Vec3 next = features.vertex(sides[i].corner) - features.interior_point();
      const double inside = dot(cross(corner, next), ray);
      if (inside < worst) {
        worst = inside;
        slot = i;
      }
      corner = next;
    }
    if (slot == sides.size()) return Step::Overlap;  // below the face of its own cone
    face = Feature::face(sides[slot == 0 ? sides.size() - 1 : slot - 1].neighbour);
    return Step::Continue;
  }
};

}  // namespace carpus::collision::detail
