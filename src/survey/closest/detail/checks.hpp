// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What any answer must fulfil, checked against the oracles of exhaustive.hpp.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "convex/bodies_test_support.hpp"
#include "survey/closest/detail/exhaustive.hpp"

namespace carpus::test {

/// How far a point lies outside of a body [mm]; not positive inside.
inline double outside_mm(const convex::ConvexBody& body, const Vec3& p) {
  double worst = -std::numeric_limits<double>::infinity();
  for (const Plane& plane : body.polytope().planes) {
    worst = std::max(worst, plane.signed_distance(p));
  }
  return worst;
}

inline Vec3 into_second(const convex::PairPose& pose, const Vec3& p) {
  return pose.rotation.transposed() * (p - pose.translation);
}

/// Two answers to one question; the bodies' nearest points must be unique.
inline void expect_same(const std::optional<convex::Closest>& a,
                        const std::optional<convex::Closest>& b,
                        bool is_apart) {
  ASSERT_EQ(a.has_value(), is_apart);
  ASSERT_EQ(b.has_value(), is_apart);
  if (!a || !b) return;
  EXPECT_NEAR(a->distance_mm, b->distance_mm, 1e-11);
  EXPECT_LE(distance(a->on_first, b->on_first), 1e-7);
}

/// The answers of one query about one pose, against the truth.
class Judge {
 public:
  Judge(const convex::ConvexBody& first,
        const convex::ConvexBody& second,
        const convex::PairPose& pose,
        double tolerance_mm)
      : first_(first),
        second_(second),
        pose_(pose),
        tolerance_mm_(tolerance_mm),
        a_(placed(first, {}, first.interior_point())),
        b_(placed(second, pose, first.interior_point())),
        depth_(exhaustive_depth(a_, b_)) {}

  /// Negative where the bodies are apart.
  [[nodiscard]] double depth_mm() const { return static_cast<double>(depth_); }
  /// Where they are.
  [[nodiscard]] double distance_mm() const {
    return static_cast<double>(exhaustive_distance(a_, b_));
  }
  [[nodiscard]] bool is_apart() const { return depth_ < -tolerance_mm_; }
  [[nodiscard]] bool is_meeting() const { return depth_ > tolerance_mm_; }

  void expect_verdict(convex::Verdict verdict) const {
    if (is_apart()) {
      EXPECT_EQ(verdict, convex::Verdict::Apart);
    }
    if (is_meeting()) {
      EXPECT_EQ(verdict, convex::Verdict::Meet);
    }
  }

  void expect_closest(const std::optional<convex::Closest>& answer) const {
    if (is_apart() || is_meeting()) {
      EXPECT_EQ(answer.has_value(), is_apart());
    }
    if (!answer || is_meeting()) return;
    if (is_apart()) {
      EXPECT_NEAR(answer->distance_mm, distance_mm(), tolerance_mm_);
    }
    EXPECT_NEAR(length(answer->normal), 1, 1e-12);
    expect_on_bodies(answer->on_first, answer->on_second);
    EXPECT_NEAR(distance(answer->on_first, answer->on_second), answer->distance_mm, tolerance_mm_);
    // The plane across the normal leaves the whole distance between the bodies.
    const Real gap = -height_along(a_, b_, real(answer->normal) * -1);
    EXPECT_GE(static_cast<double>(gap), answer->distance_mm - tolerance_mm_);
  }

  void expect_penetration(const std::optional<convex::Penetration>& answer) const {
    if (is_apart() || is_meeting()) {
      EXPECT_EQ(answer.has_value(), is_meeting());
    }
    if (!answer || is_apart()) return;
    EXPECT_NEAR(answer->depth_mm, std::max(0.0, depth_mm()), tolerance_mm_);
    EXPECT_NEAR(length(answer->direction), 1, 1e-12);
    expect_on_bodies(answer->on_first, answer->on_second);
    EXPECT_LE(distance(answer->on_second + answer->direction * answer->depth_mm, answer->on_first),
              tolerance_mm_);
    // The move parts them: beyond it, along the direction, nothing is left.
    const Real left = height_along(a_, b_, real(answer->direction) * -1) - answer->depth_mm;
    EXPECT_LE(static_cast<double>(left), tolerance_mm_);
  }

 private:
  void expect_on_bodies(const Vec3& on_first, const Vec3& on_second) const {
    EXPECT_LE(outside_mm(first_, on_first), tolerance_mm_);
    EXPECT_LE(outside_mm(second_, into_second(pose_, on_second)), tolerance_mm_);
  }

  const convex::ConvexBody& first_;
  const convex::ConvexBody& second_;
  convex::PairPose pose_;
  double tolerance_mm_;
  PlacedBody a_;
  PlacedBody b_;
  Real depth_;
};

}  // namespace carpus::test
