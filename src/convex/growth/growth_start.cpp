// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/growth/growth_start.hpp"

#include <cmath>

#include "geometry/vec3.hpp"

namespace carpus::convex {
namespace {

/// Two are usual.
constexpr int kMostSteps = 4;

struct FaceAndCorner {
  double bound = -HUGE_VAL;
  std::uint32_t face = 0;
  std::uint32_t corner = 0;
};

/// @param of_face, of_corner  the first and the second body, or the second and the first.
FaceAndCorner ascend(const ProofBody& of_face,
                     const ProofBody& of_corner,
                     const RelativePose& pose,
                     bool is_face_of_second,
                     std::uint32_t face) noexcept {
  const PolarGraph& faces = *of_face.facets;
  const SupportGraph& corners = *of_corner.corners;
  FaceAndCorner best;
  for (int step = 0; step < kMostSteps; ++step) {
    // p . x - shift <= t on the one, d . x <= t (d . at) on the other, each about its origin.
    const Vec3 p = faces.row(face).normal();
    const Vec3 d = is_face_of_second ? -(pose.rotation * p) : -pose.into_second(p);
    const double along = is_face_of_second ? dot(d, pose.offset) : dot(p, pose.offset);
    const std::uint32_t corner = corners.climb(d, corners.near(d));
    const Vec3& at = corners.corner(corner);
    const double bound = along / (1 + dot(d, at));
    if (!(bound > best.bound)) break;
    best = {bound, face, corner};
    const Vec3 x =
        is_face_of_second ? pose.into_second(at - pose.offset) : pose.rotation * at + pose.offset;
    const std::uint32_t next = faces.climb(face, x).face;
    if (next == face) break;
    face = next;
  }
  return best;
}

}  // namespace

FeaturePair features_from_faces(const ProofBody& first,
                                const ProofBody& second,
                                const RelativePose& pose,
                                std::uint32_t in_first,
                                std::uint32_t in_second) noexcept {
  const FaceAndCorner best = ascend(first, second, pose, false, in_first);
  if (!(best.bound > 1)) {
    const FaceAndCorner other = ascend(second, first, pose, true, in_second);
    if (other.bound > best.bound) {
      return {Feature::vertex(other.corner),
              Feature::face(second.facets->face_of_body(other.face))};
    }
  }
  return {Feature::face(first.facets->face_of_body(best.face)), Feature::vertex(best.corner)};
}

}  // namespace carpus::convex
