// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The state of an edge of one body and a face of the other, which never holds the nearest points
// alone: it passes on, or finds that the edge goes through the face.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "convex/features/placement.hpp"
#include "convex/features/regions.hpp"
#include "convex/features/segments.hpp"

namespace carpus::convex {

/// What a step of a walk found.
enum class Step : std::uint8_t {
  Continue,  ///< a feature has changed
  Apart,     ///< the pair holds the nearest points
  Overlap,   ///< the pair has a common point, or one feature lies in the other body
};

/// The part of a segment, parameters [low, high], that remains after clipping, and what cut it off:
/// the numbers of the planes, or kUncut.
struct ClippedSegment {
  static constexpr std::size_t kUncut = std::numeric_limits<std::size_t>::max();
  double low = 0;
  double high = 1;
  std::size_t low_by = kUncut;
  std::size_t high_by = kUncut;

  /// Cuts off where the value, linear from `at_tail` to `at_head`, is positive. False if that is
  /// everywhere.
  [[nodiscard]] bool cut(double at_tail, double at_head, std::size_t by) noexcept {
    if (at_tail > 0 && at_head > 0) return false;
    if (at_tail > 0) {
      const double t = at_tail / (at_tail - at_head);
      if (t > low) {
        low = t;
        low_by = by;
      }
    } else if (at_head > 0) {
      const double t = at_tail / (at_tail - at_head);
      if (t < high) {
        high = t;
        high_by = by;
      }
    }
    return true;
  }
  [[nodiscard]] bool is_empty() const noexcept { return !(low <= high); }
};

/// The side of a face nearest to a segment that does not enter its prism, or that side's end.
template <typename Body>
[[nodiscard]] Feature nearest_boundary(const Body& body,
                                       std::uint32_t f,
                                       const Segment& segment) noexcept {
  const std::span<const VoronoiFeatures::Side> sides = body.features->sides(f);
  double best = std::numeric_limits<double>::infinity();
  Feature nearest;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Feature side = body.features->side_edge(f, i);
    const Vec3 tail = body.vertex(side.id);
    const SegmentPair points = nearest_points(segment, {tail, body.vertex(side.head) - tail});
    const double squared = squared_length(points.on_second - points.on_first);
    if (squared < best) {
      best = squared;
      nearest = side;
      if (points.t <= 0) nearest = Feature::vertex(side.id);
      if (points.t >= 1) nearest = Feature::vertex(side.head);
    }
  }
  return nearest;
}

/// [mirtich1998vclip]: clip the edge to the face's prism; if nothing remains the face's
/// boundary is nearer, else the end of the rest that is nearer to the plane decides.
template <typename Near, typename Far>
[[nodiscard]] Step step_edge_face(const Near& near,
                                  Feature& edge,
                                  const Far& far,
                                  Feature& face) noexcept {
  const Vec3 tail = near.vertex(edge.id);
  const Vec3 head = near.vertex(edge.head);
  const Segment segment{tail, head - tail};
  const Vec3 normal = far.normal(face.id);
  const std::span<const VoronoiFeatures::Side> sides = far.features->sides(face.id);
  ClippedSegment rest;
  const Vec3 first = far.vertex(sides.front().corner);
  Vec3 corner = first;
  bool excluded = false;
  for (std::size_t i = 0; i < sides.size() && !excluded; ++i) {
    const Vec3 next = i + 1 == sides.size() ? first : far.vertex(sides[i + 1].corner);
    const Vec3 outward = cross(next - corner, normal);
    excluded = !rest.cut(dot(outward, tail - corner), dot(outward, head - corner), i);
    corner = next;
  }
  if (excluded || rest.is_empty()) {
    face = nearest_boundary(far, face.id, segment);
    return Step::Continue;
  }
  const double low = dot(normal, segment.at(rest.low) - first);
  const double high = dot(normal, segment.at(rest.high) - first);
  if ((low <= 0 && high >= 0) || (low >= 0 && high <= 0)) return Step::Overlap;
  const double slope = dot(normal, segment.along);
  const bool low_is_nearer = (low > 0 ? slope : -slope) >= 0;
  const std::size_t by = low_is_nearer ? rest.low_by : rest.high_by;
  if (by != ClippedSegment::kUncut) {
    face = far.features->side_edge(face.id, by);
  } else {
    edge = Feature::vertex(low_is_nearer ? edge.id : edge.head);
  }
  return Step::Continue;
}

}  // namespace carpus::convex
