// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The steps of Voronoi-Clip [mirtich1998vclip], one for each kind of pair.
#pragma once

#include <cstddef>
#include <cstdint>

#include "convex/features/edge_face.hpp"
#include "convex/features/feature_pair.hpp"
#include "convex/features/placement.hpp"
#include "convex/features/regions.hpp"
#include "convex/features/segments.hpp"
#include "convex/features/vertex_steps.hpp"

namespace carpus::survey::detail {

struct VClipSteps {
  /// One step: first and second in the roles that their kinds give them.
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

  /// Vertex and face: the vertex in the face's prism, above it, and none of its edges coming
  /// nearer.
  template <typename Near, typename Far>
  [[nodiscard]] static convex::Step vertex_face(const Near& near,
                                                convex::Feature& vertex,
                                                const Far& far,
                                                convex::Feature& face) noexcept {
    const Vec3 at = near.vertex(vertex.id);
    if (convex::moves_to(face, convex::leave_face(far, face.id, at))) return convex::Step::Continue;
    const double height = convex::height_over(far, face.id, at);
    if (height == 0) return convex::Step::Overlap;  // on the face
    if (convex::moves_to(vertex, convex::edge_towards(near, vertex.id, far, face.id, height > 0))) {
      return convex::Step::Continue;
    }
    return height > 0 ? convex::Step::Apart : escape(at, far, face);
  }

  /// Out of a local minimum: the face that the vertex is highest over; if it is above none it lies
  /// in the body.
  template <typename Far>
  [[nodiscard]] static convex::Step escape(const Vec3& at,
                                           const Far& far,
                                           convex::Feature& face) noexcept {
    const Vec3 own = far.own_point(at);
    const std::span<const Plane> planes = far.features->planes();
    double highest = 0;
    std::size_t best = planes.size();
    for (std::size_t f = 0; f < planes.size(); ++f) {
      const double height = planes[f].signed_distance(own);
      if (height > highest) {
        highest = height;
        best = f;
      }
    }
    if (best == planes.size()) return convex::Step::Overlap;
    face = convex::Feature::face(static_cast<std::uint32_t>(best));
    return convex::Step::Continue;
  }

  /// Two edges: each clipped to the other's region.
  template <typename Near, typename Far>
  [[nodiscard]] static convex::Step edge_edge(const Near& near,
                                              convex::Feature& a,
                                              const Far& far,
                                              convex::Feature& b) noexcept {
    const convex::Step first = clip_to_edge(near, a, far, b);
    return first != convex::Step::Apart ? first : clip_to_edge(far, b, near, a);
  }

  /// Clips `other` to the region of `edge`, first to the planes of its ends, then to those of its
  /// faces, and moves `edge` on to the neighbour behind a plane where `other` still comes nearer.
  /// Apart: it stays.
  template <typename Near, typename Far>
  [[nodiscard]] static convex::Step clip_to_edge(const Near& near,
                                                 convex::Feature& edge,
                                                 const Far& far,
                                                 const convex::Feature& other) noexcept {
    const convex::EdgeRegion region = convex::region_of_edge(near, edge);
    const Vec3 tail = far.vertex(other.id);
    const convex::Segment segment{tail, far.vertex(other.head) - tail};
    convex::ClippedSegment rest;
    if (clip_to_ends(region, segment, edge, rest)) return convex::Step::Continue;
    return clip_to_faces(near, region, segment, edge, rest);
  }

  [[nodiscard]] static bool clip_to_ends(const convex::EdgeRegion& region,
                                         const convex::Segment& segment,
                                         convex::Feature& edge,
                                         convex::ClippedSegment& rest) noexcept {
    const Vec3 head = segment.tail + segment.along;
    const Vec3& along = region.along;
    const convex::Feature ends[2] = {convex::Feature::vertex(edge.id),
                                     convex::Feature::vertex(edge.head)};
    const Vec3 corners[2] = {region.tail, region.head};
    if (!rest.cut(-dot(segment.tail - corners[0], along), -dot(head - corners[0], along), 0)) {
      edge = ends[0];
      return true;
    }
    if (!rest.cut(dot(segment.tail - corners[1], along), dot(head - corners[1], along), 1)) {
      edge = ends[1];
      return true;
    }
    if (rest.low_by != convex::ClippedSegment::kUncut &&
        dot(segment.along, segment.at(rest.low) - corners[rest.low_by]) > 0) {
      edge = ends[rest.low_by];
      return true;
    }
    if (rest.high_by != convex::ClippedSegment::kUncut &&
        dot(segment.along, segment.at(rest.high) - corners[rest.high_by]) < 0) {
      edge = ends[rest.high_by];
      return true;
    }
    return false;
  }

  template <typename Near>
  [[nodiscard]] static convex::Step clip_to_faces(
      const Near& near,
      const convex::EdgeRegion& region,
      const convex::Segment& segment,
      convex::Feature& edge,
      const convex::ClippedSegment& between_ends) noexcept {
    const Vec3 from_tail = segment.tail - region.tail;
    const Vec3 from_head = from_tail + segment.along;
    const std::uint32_t faces[2] = {edge.left, edge.right};
    convex::ClippedSegment rest = between_ends;
    rest.low_by = convex::ClippedSegment::kUncut;
    rest.high_by = convex::ClippedSegment::kUncut;
    const Vec3 inwards[2] = {region.into_left, region.into_right};
    for (std::size_t i = 0; i < 2; ++i) {
      if (!rest.cut(dot(from_tail, inwards[i]), dot(from_head, inwards[i]), i)) {
        edge = convex::Feature::face(faces[i]);
        return convex::Step::Continue;
      }
    }
    for (const bool at_low : {true, false}) {
      const std::size_t by = at_low ? rest.low_by : rest.high_by;
      if (by == convex::ClippedSegment::kUncut) continue;
      const Vec3 normal = near.normal(faces[by]);
      const double height = dot(normal, segment.at(at_low ? rest.low : rest.high) - region.tail);
      if (height == 0) return convex::Step::Overlap;
      const double slope = height > 0 ? dot(normal, segment.along) : -dot(normal, segment.along);
      if (at_low ? slope > 0 : slope < 0) {
        edge = convex::Feature::face(faces[by]);
        return convex::Step::Continue;
      }
    }
    return convex::Step::Apart;
  }
};

}  // namespace carpus::survey::detail
