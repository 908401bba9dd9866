// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The steps of [lin1991incremental]: nearest points of the pair, tested against the other
// feature's region. The paper's pairs of two faces, or of a face and an edge parallel to it, hold
// no nearer points than their boundaries do; so an edge over a face passes on to these, and two
// faces never meet in a pair.
#pragma once

#include <cstddef>

#include "convex/features/edge_face.hpp"
#include "convex/features/feature_pair.hpp"
#include "convex/features/placement.hpp"
#include "convex/features/regions.hpp"
#include "convex/features/segments.hpp"
#include "convex/features/vertex_steps.hpp"

namespace carpus::survey::detail {

struct LinCannySteps {
  [[nodiscard]] static convex::Step step(const convex::FixedBody& first,
                                         const convex::MovedBody& second,
                                         convex::FeaturePair& pair) noexcept {
    if (pair.first.kind <= pair.second.kind) {
      return ordered(first, pair.first, second, pair.second);
    }
    return ordered(second, pair.second, first, pair.first);
  }

 private:
  template <typename Near, typename Far>
  [[nodiscard]] static convex::Step ordered(const Near& near,
                                            convex::Feature& a,
                                            const Far& far,
                                            convex::Feature& b) noexcept {
    if (a.kind == convex::FeatureKind::Edge) {
      return b.kind == convex::FeatureKind::Edge ? edge_edge(near, a, far, b)
                                                 : convex::step_edge_face(near, a, far, b);
    }
    if (b.kind == convex::FeatureKind::Vertex) return convex::step_vertex_vertex(near, a, far, b);
    if (b.kind == convex::FeatureKind::Edge) return convex::step_vertex_edge(near, a, far, b);
    return vertex_face(near, a, far, b);
  }

  template <typename Near, typename Far>
  [[nodiscard]] static convex::Step edge_edge(const Near& near,
                                              convex::Feature& a,
                                              const Far& far,
                                              convex::Feature& b) noexcept {
    const convex::EdgeRegion region_a = convex::region_of_edge(near, a);
    const convex::EdgeRegion region_b = convex::region_of_edge(far, b);
    const convex::SegmentPair points =
        convex::nearest_points({region_a.tail, region_a.along}, {region_b.tail, region_b.along});
    if (convex::moves_to(a, convex::leave_edge(region_a, a, points.on_second)))
      return convex::Step::Continue;
    if (convex::moves_to(b, convex::leave_edge(region_b, b, points.on_first)))
      return convex::Step::Continue;
    return convex::Step::Apart;
  }

  template <typename Near, typename Far>
  [[nodiscard]] static convex::Step vertex_face(const Near& near,
                                                convex::Feature& vertex,
                                                const Far& far,
                                                convex::Feature& face) noexcept {
    const Vec3 at = near.vertex(vertex.id);
    const double height = convex::height_over(far, face.id, at);
    if (height <= 0) return follow_cones(at, far, face);
    if (convex::moves_to(face, convex::leave_face(far, face.id, at))) return convex::Step::Continue;
    if (convex::moves_to(vertex, convex::edge_towards(near, vertex.id, far, face.id, true)))
      return convex::Step::Continue;
    return convex::Step::Apart;
  }

  /// One step between the cones from the interior point over the faces, towards the one in which
  /// the point lies [ponamgi1995incremental] Called with the point below the face.
  template <typename Far>
  [[nodiscard]] static convex::Step follow_cones(const Vec3& at,
                                                 const Far& far,
                                                 convex::Feature& face) noexcept {
    const convex::VoronoiFeatures& features = *far.features;
    const Vec3 ray = far.own_point(at) - features.interior_point();
    const std::span<const convex::VoronoiFeatures::Side> sides = features.sides(face.id);
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
    if (slot == sides.size()) return convex::Step::Overlap;  // below the face of its own cone
    face = convex::Feature::face(sides[slot == 0 ? sides.size() - 1 : slot - 1].neighbour);
    return convex::Step::Continue;
  }
};

}  // namespace carpus::survey::detail
