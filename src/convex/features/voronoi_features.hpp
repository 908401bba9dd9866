// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Vertices, edges and faces of a convex body and who borders whom: what the methods that walk over
// closest features share. Read it before lin_canny.hpp, v_clip.hpp and swift.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "convex/convex_body.hpp"
#include "geometry/convex_polytope.hpp"
#include "geometry/vec3.hpp"

namespace carpus::convex {

enum class FeatureKind : std::uint8_t { Vertex, Edge, Face };

/// A vertex, an edge or a face of one body. An edge carries its ends and the faces on its two
/// sides, so that no table of edges is needed.
struct Feature {
  FeatureKind kind = FeatureKind::Vertex;
  std::uint32_t id = 0;     ///< the vertex, the face, or the edge's tail
  std::uint32_t head = 0;   ///< edge: the other end
  std::uint32_t left = 0;   ///< edge: face to the left, seen from outside
  std::uint32_t right = 0;  ///< edge: face to the right

  bool operator==(const Feature&) const = default;

  [[nodiscard]] static constexpr Feature vertex(std::uint32_t v) noexcept {
    return {FeatureKind::Vertex, v, 0, 0, 0};
  }
  [[nodiscard]] static constexpr Feature face(std::uint32_t f) noexcept {
    return {FeatureKind::Face, f, 0, 0, 0};
  }
};

/// The graph of features, on merged faces: on triangles that share a plane the Voronoi regions of
/// the edges between them are empty, and walks go in circles there.
///
/// The Voronoi region of a feature is where it is the body's nearest feature [lin1991incremental],
/// and is bounded by one plane for each neighbour: across the end of an edge, square to it; and
/// through an edge, square to the face. These planes are not stored: each follows from two vertices
/// and a normal, and memory costs more than the few products.
class VoronoiFeatures {
 public:
  /// About 25 bytes a vertex, 8 a spoke and a side, 36 a face. O(vertices).
  explicit VoronoiFeatures(const ConvexBody& body) : VoronoiFeatures(body, body.interior_point()) {}
  /// Coordinates are kept relative to `centre`: far from the origin of its frame (that of a CT) a
  /// body would lose the digits of its shape in every product.
  VoronoiFeatures(const ConvexBody& body, const Vec3& centre);

  struct Spoke {
    std::uint32_t end;   ///< of an edge that leaves the vertex
    std::uint32_t face;  ///< to the left of that edge
  };
  struct Side {
    std::uint32_t corner;     ///< where this side of the face begins
    std::uint32_t neighbour;  ///< the face across
  };

  [[nodiscard]] std::size_t vertex_count() const noexcept { return vertices_.size(); }
  [[nodiscard]] std::size_t face_count() const noexcept { return planes_.size(); }
  [[nodiscard]] const Vec3& centre() const noexcept { return centre_; }
  /// About the centre [mm].
  [[nodiscard]] double radius_mm() const noexcept { return radius_mm_; }
  /// Relative to the centre, as all positions of this class.
  [[nodiscard]] const Vec3& vertex(std::uint32_t v) const noexcept { return vertices_[v]; }
  [[nodiscard]] std::span<const Vec3> vertices() const noexcept { return vertices_; }
  /// Normal by Newell's sum over all corners; the offset is the largest of the corners'.
  [[nodiscard]] const Plane& plane(std::uint32_t f) const noexcept { return planes_[f]; }
  [[nodiscard]] std::span<const Plane> planes() const noexcept { return planes_; }
  /// Edges about a vertex, counter-clockwise from outside.
  [[nodiscard]] std::span<const Spoke> spokes(std::uint32_t v) const noexcept {
    return {spokes_.data() + spoke_starts_[v], spokes_.data() + spoke_starts_[v + 1]};
  }
  /// Sides of a face, counter-clockwise from outside.
  [[nodiscard]] std::span<const Side> sides(std::uint32_t f) const noexcept {
    return {sides_.data() + side_starts_[f], sides_.data() + side_starts_[f + 1]};
  }
  /// The edge that leaves `v` by its spoke number `slot`.
  [[nodiscard]] Feature spoke_edge(std::uint32_t v, std::size_t slot) const noexcept {
    const std::span<const Spoke> all = spokes(v);
    const Spoke& before = slot == 0 ? all.back() : all[slot - 1];
    return {FeatureKind::Edge, v, all[slot].end, all[slot].face, before.face};
  }
  /// The edge along side number `slot` of face `f`, which lies to its left.
  [[nodiscard]] Feature side_edge(std::uint32_t f, std::size_t slot) const noexcept {
    const std::span<const Side> all = sides(f);
    const Side& after = slot + 1 == all.size() ? all.front() : all[slot + 1];
    return {FeatureKind::Edge, all[slot].corner, after.corner, f, all[slot].neighbour};
  }
  /// Strictly inside the body.
  [[nodiscard]] const Vec3& interior_point() const noexcept { return interior_point_; }

 private:
  std::vector<Vec3> vertices_;
  std::vector<std::uint32_t> spoke_starts_;
  std::vector<Spoke> spokes_;
  std::vector<Plane> planes_;
  std::vector<std::uint32_t> side_starts_;
  std::vector<Side> sides_;
  Vec3 interior_point_;
  Vec3 centre_;
  double radius_mm_ = 0;
};

}  // namespace carpus::convex
