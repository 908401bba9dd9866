// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "device_bench/collision_question.hpp"

#include <vector>

#include "core/check.hpp"
#include "hull/fast_hull.hpp"
#include "survey/methods.hpp"

namespace carpus::device_bench {
namespace {

constexpr double kBoneHalfMm = 120;
constexpr double kBoneDeepMm = 80;
/// The probe's point.
constexpr double kToolMm = 0.05;

convex::ConvexBody bone_behind(const haptics::SurfacePlane& wall, const Vec3& middle) {
  const Vec3 on_face = middle - wall.normal * (dot(wall.normal, middle) - wall.offset_mm);
  const Vec3 u = any_perpendicular(wall.normal);
  const Vec3 v = cross(wall.normal, u);
  std::vector<Vec3> corners;
  for (const double a : {-kBoneHalfMm, kBoneHalfMm}) {
    for (const double b : {-kBoneHalfMm, kBoneHalfMm}) {
      for (const double c : {0.0, -kBoneDeepMm}) {
        corners.push_back(on_face + u * a + v * b + wall.normal * c);
      }
    }
  }
  return convex::ConvexBody(hull::build_fast_hull(corners).polytope);
}

convex::ConvexBody tool_point() {
  std::vector<Vec3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const double side : {-kToolMm, kToolMm}) {
      Vec3 corner;
      corner[k] = side;
      corners.push_back(corner);
    }
  }
  return convex::ConvexBody(hull::build_fast_hull(corners).polytope);
}

}  // namespace

CollisionQuestion::CollisionQuestion(const haptics::SurfacePlane& wall, const Vec3& middle)
    : bone_(bone_behind(wall, middle)), tool_(tool_point()) {
  const survey::Method* method = survey::find_method("lp_scan");
  CARPUS_CHECK(method != nullptr);
  query_ = method->make(bone_, tool_);
}

bool CollisionQuestion::meets(const Vec3& tip) {
  query_->forget();
  return query_->meets({Mat3::identity(), tip}) == convex::Verdict::Meet;
}

}  // namespace carpus::device_bench
