// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Slow and obvious: two polytopes are apart iff a facet normal of either or a cross product of an
// edge of each separates them. Every axis is tried in exact arithmetic, at the pose as given. For a
// matrix that is not singular.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"
#include "geometry/exact_number.hpp"

namespace carpus::test {

struct ExactBody {
  std::vector<ExactVec3> vertices;
  std::vector<ExactVec3> normals;
  std::vector<ExactVec3> edges;

  ExactBody(const convex::ConvexBody& body, const Mat3& rotation, const Vec3& translation) {
    for (const Vec3& v : body.vertices()) {
      const auto component = [&](std::size_t i) {
        return dot(ExactVec3(rotation.rows[i]), ExactVec3(v)) + ExactNumber(translation[i]);
      };
      vertices.emplace_back(component(0), component(1), component(2));
    }
    for (const hull::PolygonalFace& face : body.faces()) {
      const auto corner = [&](std::size_t i) -> const ExactVec3& {
        return vertices[face.corners[i % face.corners.size()]];
      };
      normals.push_back(cross(corner(1) - corner(0), corner(2) - corner(0)));
      for (std::size_t i = 0; i < face.corners.size(); ++i) {
        if (face.corners[i] < face.corners[(i + 1) % face.corners.size()]) {
          edges.push_back(corner(i + 1) - corner(i));
        }
      }
    }
  }
};

[[nodiscard]] inline bool is_separating(const ExactVec3& axis,
                                        const ExactBody& a,
                                        const ExactBody& b) {
  const auto is_beyond = [&](const ExactBody& low, const ExactBody& high) {
    ExactNumber top = dot(axis, low.vertices[0]);
    for (const ExactVec3& v : low.vertices) {
      const ExactNumber s = dot(axis, v);
      if ((s - top).sign() > 0) top = s;
    }
    return std::all_of(high.vertices.begin(), high.vertices.end(),
                       [&](const ExactVec3& v) { return (dot(axis, v) - top).sign() > 0; });
  };
  return is_beyond(a, b) || is_beyond(b, a);
}

[[nodiscard]] inline convex::Verdict verdict_by_all_axes(const convex::ConvexBody& first,
                                                         const convex::ConvexBody& second,
                                                         const convex::PairPose& pose) {
  const ExactBody a(first, Mat3::identity(), {});
  const ExactBody b(second, pose.rotation, pose.translation);
  const auto separates = [&](const ExactVec3& axis) { return is_separating(axis, a, b); };
  if (std::any_of(a.normals.begin(), a.normals.end(), separates)) return convex::Verdict::Apart;
  if (std::any_of(b.normals.begin(), b.normals.end(), separates)) return convex::Verdict::Apart;
  for (const ExactVec3& e : a.edges) {
    for (const ExactVec3& f : b.edges) {
      if (separates(cross(e, f))) return convex::Verdict::Apart;
    }
  }
  return convex::Verdict::Meet;
}

}  // namespace carpus::test
