// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/growth/contact_features.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

#include "convex/features/regions.hpp"
#include "convex/features/segments.hpp"
#include "convex/features/vertex_steps.hpp"
#include "geometry/tolerance.hpp"

namespace carpus::convex {
namespace {

/// Nearly all walks of a moving wrist that end are shorter.
constexpr int kMostSteps = 24;

/// The two bodies as seen by one of them; each body's points and directions are kept in its own
/// frame, and only what meets is turned.
template <bool kIsSecond>
struct View {
  const VoronoiFeatures& own;
  const VoronoiFeatures& other;
  const RelativePose& pose;

  [[nodiscard]] Vec3 turned_to_own(const Vec3& d) const noexcept {
    return kIsSecond ? pose.into_second(d) : pose.rotation * d;
  }
  [[nodiscard]] Vec3 turned_to_other(const Vec3& d) const noexcept {
    return kIsSecond ? pose.rotation * d : pose.into_second(d);
  }
  [[nodiscard]] Vec3 point_to_own(const Vec3& p) const noexcept {
    return kIsSecond ? pose.into_second(p - pose.offset) : pose.rotation * p + pose.offset;
  }
  [[nodiscard]] View<!kIsSecond> swapped() const noexcept { return {other, own, pose}; }
};

/// The edge of vertex v that goes farthest along `d`; empty where all go back.
std::optional<Feature> edge_along(const VoronoiFeatures& body,
                                  std::uint32_t v,
                                  const Vec3& d) noexcept {
  return leave_vertex(FixedBody{&body}, v, d);
}

/// How a point lies to an edge: by its length, and to the faces on both sides.
struct BesideEdge {
  double along = 0;  ///< 0 at the tail, 1 at the head
  double left = 0;   ///< > 0: beyond the edge's region, over the left face
  double right = 0;
  bool is_below = false;  ///< both faces' planes, and beside the edge's inside
};

BesideEdge beside(const VoronoiFeatures& body,
                  const Feature& edge,
                  const Vec3& along,
                  double squared,
                  const Vec3& from_tail) noexcept {
  const Vec3& left = body.plane(edge.left).normal;
  const Vec3& right = body.plane(edge.right).normal;
  const Vec3 across = cross(along, from_tail);
  const double share = dot(from_tail, along) / squared;
  return {share, dot(left, across), -dot(right, across),
          share >= 0 && share <= 1 && dot(left, from_tail) < 0 && dot(right, from_tail) < 0};
}

/// Where the pair goes from an edge that a point is not beside; false if it is.
bool leaves(const BesideEdge& place, Feature& edge) noexcept {
  if (place.along < 0) {
    edge = Feature::vertex(edge.id);
  } else if (place.along > 1) {
    edge = Feature::vertex(edge.head);
  } else if (place.left > 0 && place.left >= place.right) {
    edge = Feature::face(edge.left);
  } else if (place.right > 0) {
    edge = Feature::face(edge.right);
  } else {
    return false;
  }
  return true;
}

bool is_same_edge(const Feature& a, const Feature& b) noexcept {
  return a.kind == FeatureKind::Edge && b.kind == FeatureKind::Edge &&
         std::minmax(a.id, a.head) == std::minmax(b.id, b.head);
}

/// Down an edge of the view's own body over a face of the other, in whose frame points are.
struct Descent {
  Feature edge;
  std::uint32_t face = 0;
  std::uint32_t to = 0;  ///< the edge's end
  Vec3 from;             ///< over the face
  Vec3 reach;            ///< from there to the end
};

/// From a point of the edge towards its end that lies lower over the face.
Descent towards_lower_end(const VoronoiFeatures& other,
                          const Feature& edge,
                          std::uint32_t face,
                          const Segment& segment,
                          const Vec3& from) noexcept {
  const bool is_to_head = dot(other.plane(face).normal, segment.along) < 0;
  return {edge, face, is_to_head ? edge.head : edge.id, from,
          segment.tail + (is_to_head ? segment.along : Vec3{}) - from};
}

/// As far as the edge is over the face: to its end, or to the side of the face that it crosses.
template <bool kIsSecond>
Step run_down(const View<kIsSecond>& view,
              const Descent& way,
              Feature& own,
              Feature& other,
              Vec3& middle) noexcept {
  const VoronoiFeatures& body = view.other;
  const Vec3& normal = body.plane(way.face).normal;
  const std::span<const VoronoiFeatures::Side> sides = body.sides(way.face);
  double share = 1;
  std::size_t slot = sides.size();
  Vec3 corner = body.vertex(sides.back().corner);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Vec3& next = body.vertex(sides[i].corner);
    const Vec3 inward = cross(normal, next - corner);
    const double rate = -dot(inward, way.reach);
    const double inside = dot(inward, way.from - corner);
    if (rate > 0 && inside < share * rate) {
      share = std::max(0.0, inside / rate);
      slot = i;
    }
    corner = next;
  }
  const Vec3 lowest = way.from + way.reach * share;
  const double height = dot(normal, lowest - corner);
  if (height < -kContactToleranceMm) {
    const Vec3 in_other = lowest - normal * (height * 0.5);
    middle = kIsSecond ? in_other : view.point_to_own(in_other);
    return Step::Overlap;
  }
  if (slot == sides.size()) {
    own = Feature::vertex(way.to);
    other = Feature::face(way.face);
  } else {
    const Feature side = body.side_edge(way.face, slot == 0 ? sides.size() - 1 : slot - 1);
    // Back where the walk came from: the edges touch.
    if (is_same_edge(own, way.edge) && is_same_edge(other, side)) return Step::Apart;
    own = way.edge;
    other = side;
  }
  return Step::Continue;
}

Step edge_edge(const View<false>& view, FeaturePair& pair, Vec3& middle) noexcept {
  Feature& a = pair.first;
  Feature& b = pair.second;
  const Vec3& a_tail = view.own.vertex(a.id);
  const Vec3& b_tail = view.other.vertex(b.id);
  const Vec3 u = view.own.vertex(a.head) - a_tail;
  const Vec3 v_own = view.other.vertex(b.head) - b_tail;
  const Vec3 v = view.pose.rotation * v_own;
  const Vec3 between = view.point_to_own(b_tail) - a_tail;
  const Vec3 n = cross(u, v);
  const double uu = squared_length(u);
  const double vv = squared_length(v);
  const double nn = squared_length(n);
  const double s = nn > 0 ? unit_clamp(dot(cross(between, v), n) / nn) : 0;
  const double t = unit_clamp(dot(u * s - between, v) / vv);
  const Vec3 on_b = between + v * t;  // from a's tail
  const BesideEdge of_b = beside(view.own, a, u, uu, on_b);
  const Vec3 on_a = u * unit_clamp(of_b.along);
  const Vec3 from_b_tail = view.turned_to_other(on_a - between);
  const BesideEdge of_a = beside(view.other, b, v_own, vv, from_b_tail);
  if (of_b.is_below && of_a.is_below) {
    middle = a_tail + (on_a + on_b) * 0.5;
    return Step::Overlap;
  }
  Feature next = a;
  if (leaves(of_b, next)) {
    if (next.kind == FeatureKind::Face) {
      const Descent way =
          towards_lower_end(view.own, b, next.id, {a_tail + between, v}, a_tail + on_b);
      return run_down(view.swapped(), way, b, a, middle);
    }
    a = next;
    return Step::Continue;
  }
  next = b;
  if (leaves(of_a, next)) {
    if (next.kind == FeatureKind::Face) {
      const Vec3 at = b_tail + from_b_tail;
      const Segment edge{at - view.turned_to_other(on_a), view.turned_to_other(u)};
      return run_down(view, towards_lower_end(view.other, a, next.id, edge, at), a, b, middle);
    }
    b = next;
    return Step::Continue;
  }
  return Step::Apart;
}

/// A vertex of the view's own body and a face of the other.
template <bool kIsSecond>
Step vertex_face(const View<kIsSecond>& view,
                 Feature& vertex,
                 Feature& face,
                 Vec3& middle) noexcept {
  const VoronoiFeatures& body = view.other;
  const Vec3 at = view.swapped().point_to_own(view.own.vertex(vertex.id));
  const Vec3& normal = body.plane(face.id).normal;
  if (moves_to(face, leave_face(FixedBody{&body}, face.id, at))) {
    return Step::Continue;
  }
  if (const std::optional<Feature> down =
          edge_along(view.own, vertex.id, -view.turned_to_own(normal))) {
    const Vec3 reach =
        view.turned_to_other(view.own.vertex(down->head) - view.own.vertex(vertex.id));
    return run_down(view, {*down, face.id, down->head, at, reach}, vertex, face, middle);
  }
  const double height = height_over(FixedBody{&body}, face.id, at);
  if (height > 0) return Step::Apart;
  const Vec3 in_other = at - normal * (height * 0.5);
  middle = kIsSecond ? in_other : view.point_to_own(in_other);
  return Step::Overlap;
}

template <bool kIsSecond>
Step vertex_edge(const View<kIsSecond>& view, Feature& vertex, Feature& edge) noexcept {
  const VoronoiFeatures& body = view.other;
  const Vec3& tail = body.vertex(edge.id);
  const Vec3 along = body.vertex(edge.head) - tail;
  const Vec3 from_tail = view.swapped().point_to_own(view.own.vertex(vertex.id)) - tail;
  const BesideEdge place = beside(body, edge, along, squared_length(along), from_tail);
  if (leaves(place, edge)) return Step::Continue;
  const Vec3 to_foot = view.turned_to_own(along * place.along - from_tail);
  return moves_to(vertex, edge_along(view.own, vertex.id, to_foot)) ? Step::Continue : Step::Apart;
}

Step vertex_vertex(const View<false>& view, FeaturePair& pair) noexcept {
  const Vec3 across =
      view.point_to_own(view.other.vertex(pair.second.id)) - view.own.vertex(pair.first.id);
  const bool has_moved =
      moves_to(pair.first, edge_along(view.own, pair.first.id, across)) ||
      moves_to(pair.second, edge_along(view.other, pair.second.id, -view.turned_to_other(across)));
  return has_moved ? Step::Continue : Step::Apart;
}

template <bool kIsSecond>
Step vertex_and(const View<kIsSecond>& view,
                Feature& vertex,
                Feature& other,
                Vec3& middle) noexcept {
  return other.kind == FeatureKind::Edge ? vertex_edge(view, vertex, other)
                                         : vertex_face(view, vertex, other, middle);
}

}  // namespace

ContactEnd walk_to_contact(const VoronoiFeatures& first,
                           const VoronoiFeatures& second,
                           const RelativePose& pose,
                           FeaturePair& pair) noexcept {
  const View<false> view{first, second, pose};
  ContactEnd end;
  for (int i = 0; i < kMostSteps; ++i) {
    Step step = Step::Apart;
    if (pair.first.kind == FeatureKind::Edge && pair.second.kind == FeatureKind::Edge) {
      step = edge_edge(view, pair, end.middle);
    } else if (pair.first.kind != FeatureKind::Vertex) {
      step = vertex_and(view.swapped(), pair.second, pair.first, end.middle);
    } else if (pair.second.kind != FeatureKind::Vertex) {
      step = vertex_and(view, pair.first, pair.second, end.middle);
    } else {
      step = vertex_vertex(view, pair);
    }
    if (step == Step::Continue) continue;
    end.kind = step == Step::Apart ? ContactEnd::Kind::Apart : ContactEnd::Kind::Overlap;
    break;
  }
  return end;
}

}  // namespace carpus::convex
