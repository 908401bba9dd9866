// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/features/feature_pair.hpp"

#include "convex/features/climb.hpp"
#include "convex/features/segments.hpp"

namespace carpus::convex {
namespace {

/// Of two edges the direction square to both is the better normal (the difference of the points
/// drowns in rounding as they come near), unless they are nearly parallel.
constexpr double kLeastSquaredSine = 1e-12;

template <typename Body>
Segment segment_of(const Body& body, const Feature& edge) noexcept {
  const Vec3 tail = body.vertex(edge.id);
  return {tail, body.vertex(edge.head) - tail};
}

Closest between(const Vec3& on_first, const Vec3& on_second) noexcept {
  const Vec3 across = on_second - on_first;
  Closest closest;
  closest.distance_mm = length(across);
  closest.on_first = on_first;
  closest.on_second = on_second;
  closest.normal = normalized_or(across, {0, 0, 1});
  return closest;
}

Closest of_edges(const Segment& a, const Segment& b) noexcept {
  const SegmentPair points = nearest_points(a, b);
  Closest closest = between(points.on_first, points.on_second);
  const Vec3 across = cross(a.along, b.along);
  const bool inner = points.s > 0 && points.s < 1 && points.t > 0 && points.t < 1;
  if (inner && squared_length(across) >
                   kLeastSquaredSine * squared_length(a.along) * squared_length(b.along)) {
    const Vec3 unit = normalized_or(across, closest.normal);
    closest.normal = dot(unit, closest.normal) < 0 ? -unit : unit;
  }
  return closest;
}

/// Foot of a vertex on a face; empty where the vertex is not above it.
template <typename Body>
std::optional<Closest> of_face(const Vec3& vertex, const Body& body, std::uint32_t face) noexcept {
  const Vec3 normal = normalized_or(body.normal(face), {0, 0, 1});
  const std::uint32_t corner = body.features->sides(face).front().corner;
  const double height = dot(normal, vertex - body.vertex(corner));
  if (!(height >= 0)) return std::nullopt;
  Closest closest;
  closest.distance_mm = height;
  closest.on_first = vertex - normal * height;
  closest.on_second = vertex;
  closest.normal = normal;
  return closest;
}

void swap_roles(Closest& closest) noexcept {
  const Vec3 on_first = closest.on_first;
  closest.on_first = closest.on_second;
  closest.on_second = on_first;
  closest.normal = -closest.normal;
}

template <typename Near, typename Far>
std::optional<Closest> of_ordered(const Near& near,
                                  const Feature& a,
                                  const Far& far,
                                  const Feature& b) noexcept {
  if (a.kind == FeatureKind::Face) return std::nullopt;
  if (a.kind == FeatureKind::Edge) {
    if (b.kind != FeatureKind::Edge) return std::nullopt;
    return of_edges(segment_of(near, a), segment_of(far, b));
  }
  const Vec3 vertex = near.vertex(a.id);
  if (b.kind == FeatureKind::Vertex) return between(vertex, far.vertex(b.id));
  if (b.kind == FeatureKind::Edge) {
    const Segment edge = segment_of(far, b);
    return between(vertex, edge.at(nearest_on(edge, vertex)));
  }
  std::optional<Closest> closest = of_face(vertex, far, b.id);
  if (closest) swap_roles(*closest);  // found as (face, vertex)
  return closest;
}

}  // namespace

std::uint32_t vertex_of(const VoronoiFeatures& features, const Feature& feature) noexcept {
  return feature.kind == FeatureKind::Face ? features.sides(feature.id).front().corner : feature.id;
}

std::optional<Closest> closest_of(const FixedBody& first,
                                  const MovedBody& second,
                                  const FeaturePair& pair) noexcept {
  if (pair.first.kind <= pair.second.kind) {
    return of_ordered(first, pair.first, second, pair.second);
  }
  std::optional<Closest> closest = of_ordered(second, pair.second, first, pair.first);
  if (closest) swap_roles(*closest);
  return closest;
}

GapAlong gap_along(const FixedBody& first,
                   const MovedBody& second,
                   const FeaturePair& pair,
                   const Vec3& normal) noexcept {
  const std::uint32_t a = climb(*first.features, normal, vertex_of(*first.features, pair.first));
  const std::uint32_t b =
      climb(*second.features, second.own(-normal), vertex_of(*second.features, pair.second));
  return {dot(normal, second.vertex(b)) - dot(normal, first.vertex(a)),
          {Feature::vertex(a), Feature::vertex(b)}};
}

}  // namespace carpus::convex
