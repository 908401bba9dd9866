// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A convex body as every method of this module takes it: built once in the body's own frame, shared
// by all pairs, never changed. Moving a body changes a pose and nothing here.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "geometry/aabb.hpp"
#include "geometry/convex_polytope.hpp"
#include "hull/merged_faces.hpp"

namespace carpus::convex {

/// The body *is* the convex hull of its vertices as given (doubles, exactly); planes are rounded.
class ConvexBody {
 public:
  /// @param polytope  a HullResult's: closed, each vertex a corner [mm].
  /// @throws InvalidInput if it has no facets.
  explicit ConvexBody(ConvexPolytope polytope);

  [[nodiscard]] const ConvexPolytope& polytope() const noexcept { return polytope_; }
  [[nodiscard]] std::span<const Vec3> vertices() const noexcept { return polytope_.vertices; }

  /// Faces with exactly coplanar facets merged: the vertices of the polar polytope. Walks over
  /// facets that are not merged stick on plateaus.
  [[nodiscard]] std::span<const hull::PolygonalFace> faces() const noexcept { return faces_; }
  /// The plane of a face (of its first facet).
  [[nodiscard]] const Plane& face_plane(std::uint32_t face) const noexcept {
    return polytope_.planes[faces_[face].facets.front()];
  }

  /// Vertices that share an edge of the merged faces with `vertex`, counter-clockwise from outside.
  [[nodiscard]] std::span<const std::uint32_t> vertex_neighbours(
      std::uint32_t vertex) const noexcept {
    return {neighbours_.data() + neighbour_starts_[vertex],
            neighbours_.data() + neighbour_starts_[vertex + 1]};
  }
  /// [i]: the face to the left of the edge from `vertex` to vertex_neighbours(vertex)[i].
  [[nodiscard]] std::span<const std::uint32_t> vertex_faces(std::uint32_t vertex) const noexcept {
    return {around_.data() + neighbour_starts_[vertex],
            around_.data() + neighbour_starts_[vertex + 1]};
  }

  /// Centroid of the volume, strictly inside unless the body is thinner than rounding [mm].
  [[nodiscard]] const Vec3& interior_point() const noexcept { return interior_point_; }
  /// Largest distance of a vertex from interior_point(), rounded up [mm].
  [[nodiscard]] double radius_mm() const noexcept { return radius_mm_; }
  [[nodiscard]] const Aabb& box() const noexcept { return box_; }
  /// Largest magnitude of a coordinate.
  [[nodiscard]] double largest_coordinate_mm() const noexcept { return largest_coordinate_mm_; }

  /// What a method derives from the body, T(body), made at the first request and shared by all
  /// queries of the body. For set-up: allocates, and not from two threads at once.
  template <typename T>
  [[nodiscard]] const T& derived() const {
    static constexpr char kKey = 0;  // its address names T
    for (const auto& [key, value] : derived_) {
      if (key == &kKey) return *static_cast<const T*>(value.get());
    }
    derived_.emplace_back(&kKey, std::make_shared<const T>(*this));
    return *static_cast<const T*>(derived_.back().second.get());
  }

 private:
  ConvexPolytope polytope_;
  std::vector<hull::PolygonalFace> faces_;
  std::vector<std::uint32_t> neighbour_starts_;
  std::vector<std::uint32_t> neighbours_;
  std::vector<std::uint32_t> around_;
  Vec3 interior_point_;
  double radius_mm_ = 0;
  Aabb box_;
  double largest_coordinate_mm_ = 0;
  mutable std::vector<std::pair<const char*, std::shared_ptr<const void>>> derived_;
};

}  // namespace carpus::convex
