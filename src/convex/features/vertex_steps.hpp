// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Steps of a walk with a vertex in the pair, which [lin1991incremental] and [mirtich1998vclip] take
// alike.
#pragma once

#include <optional>

#include "convex/features/edge_face.hpp"
#include "convex/features/regions.hpp"
#include "convex/features/segments.hpp"

namespace carpus::convex {

/// Moves `feature` on if there is something to move to.
[[nodiscard]] inline bool moves_to(Feature& feature, const std::optional<Feature>& next) noexcept {
  if (next) feature = *next;
  return next.has_value();
}

template <typename Near, typename Far>
[[nodiscard]] Step step_vertex_vertex(const Near& near,
                                      Feature& a,
                                      const Far& far,
                                      Feature& b) noexcept {
  const Vec3 across = far.vertex(b.id) - near.vertex(a.id);
  if (moves_to(a, leave_vertex(near, a.id, across))) return Step::Continue;
  if (moves_to(b, leave_vertex(far, b.id, -across))) return Step::Continue;
  return Step::Apart;
}

/// The vertex must lie in the edge's region and its foot on the edge in the vertex's. Clipping the
/// edge to the vertex's region, and the sign of the slope where it is cut, say the same: the foot
/// is where the slope changes.
template <typename Near, typename Far>
[[nodiscard]] Step step_vertex_edge(const Near& near,
                                    Feature& vertex,
                                    const Far& far,
                                    Feature& edge) noexcept {
  const EdgeRegion region = region_of_edge(far, edge);
  const Vec3 at = near.vertex(vertex.id);
  if (moves_to(edge, leave_edge(region, edge, at))) return Step::Continue;
  const Segment segment{region.tail, region.along};
  const Vec3 foot = segment.at(nearest_on(segment, at));
  if (moves_to(vertex, leave_vertex(near, vertex.id, foot - at))) return Step::Continue;
  return Step::Apart;
}

/// The edge of vertex `v` that gains most on the plane of face `f`: downhill where the vertex is
/// above the plane, uphill where it is below.
template <typename Near, typename Far>
[[nodiscard]] std::optional<Feature> edge_towards(const Near& near,
                                                  std::uint32_t v,
                                                  const Far& far,
                                                  std::uint32_t f,
                                                  bool is_above) noexcept {
  const Vec3 normal = far.normal(f);
  return leave_vertex(near, v, is_above ? -normal : normal);
}

}  // namespace carpus::convex
