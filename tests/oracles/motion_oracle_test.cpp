// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// First and last time of contact against all separating axes in long double. The largest gap over
// all axes is a convex function of time: its zeros are found by bisection from its least value.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/amount_test_support.hpp"
#include "core/rng.hpp"
#include "oracles/sample_bodies.hpp"
#include "oracles/separating_axes.hpp"
#include "survey/motion/contact_interval.hpp"

namespace carpus {
namespace {

using convex::ConvexBody;
using convex::PairPose;
using survey::ContactInterval;
using survey::ContactIntervalQuery;
using survey::MotionOutcome;

class Oracle {
 public:
  Oracle(const ConvexPolytope& first,
         const ConvexPolytope& second,
         const PairPose& pose,
         const Vec3& velocity) {
    const auto a = oracles::body_of<long double>(first, Mat3::identity(), {});
    const auto b = oracles::body_of<long double>(second, pose.rotation, pose.translation);
    const oracles::Triple<long double> v{velocity.x, velocity.y, velocity.z};
    for (const auto& normal : a.normals) add(normal, a, b, v);
    for (const auto& normal : b.normals) add(normal, a, b, v);
    for (const auto& e : a.edges) {
      for (const auto& f : b.edges) add(oracles::cross_of(e, f), a, b, v);
    }
  }

  [[nodiscard]] long double gap(long double t) const {
    long double widest = -std::numeric_limits<long double>::max();
    for (const Axis& axis : axes_) {
      widest = std::max({widest, axis.above + t * axis.speed, axis.below - t * axis.speed});
    }
    return widest;
  }

  /// Where the gap is least within [low, high].
  [[nodiscard]] long double nearest(long double low, long double high) const {
    for (int i = 0; i < 70; ++i) {
      const long double a = low + (high - low) * 0.45L;
      const long double b = low + (high - low) * 0.55L;
      (gap(a) <= gap(b) ? high : low) = gap(a) <= gap(b) ? b : a;
    }
    return (low + high) / 2;
  }

  [[nodiscard]] long double zero(long double touching, long double apart) const {
    for (int i = 0; i < 60; ++i) {
      const long double middle = (touching + apart) / 2;
      (gap(middle) <= 0 ? touching : apart) = middle;
    }
    return touching;
  }

 private:
  /// The second body's gaps above and below the first along a unit axis, and its speed there.
  struct Axis {
    long double above, below, speed;
  };

  static std::array<long double, 2> range(const oracles::Triple<long double>& axis,
                                          const oracles::Body<long double>& body) {
    std::array<long double, 2> result{std::numeric_limits<long double>::max(),
                                      -std::numeric_limits<long double>::max()};
    for (const auto& v : body.vertices) {
      const long double s = oracles::dot_of(axis, v);
      result = {std::min(result[0], s), std::max(result[1], s)};
    }
    return result;
  }

  void add(const oracles::Triple<long double>& axis,
           const oracles::Body<long double>& a,
           const oracles::Body<long double>& b,
           const oracles::Triple<long double>& velocity) {
    const long double length = std::sqrt(oracles::dot_of(axis, axis));
    if (!(length > 1e-8L)) return;  // parallel edges
    const auto [low_a, high_a] = range(axis, a);
    const auto [low_b, high_b] = range(axis, b);
    axes_.push_back({(low_b - high_a) / length, (low_a - high_b) / length,
                     oracles::dot_of(axis, velocity) / length});
  }

  std::vector<Axis> axes_;
};

/// CARPUS_LONG=1 runs 25 times as many bodies.
std::uint64_t times_long(std::uint64_t count) { return test::amount(count, count, 25 * count); }

struct Tally {
  std::array<int, 7> seen{};  ///< by outcome
  int wrong_outcomes = 0;
  int undecided = 0;  ///< glancing within rounding
  double worst_mm = 0;

  [[nodiscard]] int count(MotionOutcome outcome) const {
    return seen[static_cast<std::size_t>(outcome)];
  }
};

void expect_agreement(const Tally& tally) {
  EXPECT_EQ(tally.wrong_outcomes, 0);
  EXPECT_LT(tally.worst_mm, 1e-8);
  EXPECT_EQ(tally.count(MotionOutcome::PivotLimit), 0);
}

MotionOutcome outcome_of(long double t_min, long double t_max) {
  if (t_min > 0) return MotionOutcome::WillMeet;
  return t_max < 0 ? MotionOutcome::HasPassed : MotionOutcome::Touching;
}

/// Both bodies touch at both times at the given points, their planes apart along the normal.
void expect_contact(const ConvexPolytope& first,
                    const ConvexPolytope& second,
                    const PairPose& pose,
                    const Vec3& velocity,
                    double t,
                    const survey::MotionContact& contact) {
  double high = -1e300;
  double low = 1e300;
  for (const Vec3& v : first.vertices) high = std::max(high, dot(contact.normal, v));
  for (const Vec3& v : second.vertices) {
    low = std::min(low, dot(contact.normal, pose.rotation * v + pose.translation + velocity * t));
  }
  EXPECT_NEAR(high, low, 1e-7);
  EXPECT_NEAR(high, dot(contact.normal, contact.point), 1e-7);
  for (const Plane& p : first.planes) EXPECT_LE(p.signed_distance(contact.point), 1e-7);
}

void compare(const ConvexPolytope& first,
             const ConvexPolytope& second,
             ContactIntervalQuery& query,
             const PairPose& pose,
             const Vec3& velocity,
             Tally& tally) {
  const ContactInterval ours = query.query(pose, velocity);
  ++tally.seen[static_cast<std::size_t>(ours.outcome)];
  const Oracle oracle(first, second, pose, velocity);
  const long double reach = 100 / length(velocity);
  const long double nearest = oracle.nearest(-reach, reach);
  const long double least_gap = oracle.gap(nearest);
  if (std::abs(least_gap) < 1e-9L) {
    ++tally.undecided;
    return;
  }
  if (least_gap > 0) {
    tally.wrong_outcomes += ours.outcome == MotionOutcome::NeverMeet ? 0 : 1;
    return;
  }
  const long double t_min = oracle.zero(nearest, -reach);
  const long double t_max = oracle.zero(nearest, reach);
  const auto error_mm = [&](double t, long double truth) {
    return static_cast<double>(std::abs(t - truth)) * ours.speed_mm_per_s;
  };
  tally.worst_mm =
      std::max({tally.worst_mm, error_mm(ours.t_min_s, t_min), error_mm(ours.t_max_s, t_max)});
  if (std::min(std::abs(t_min), std::abs(t_max)) < 1e-9L) {
    tally.wrong_outcomes += ours.outcome == MotionOutcome::Touching ? 0 : 1;
  } else {
    tally.wrong_outcomes += ours.outcome == outcome_of(t_min, t_max) ? 0 : 1;
  }
  if (ours.t_min_s <= ours.t_max_s) {
    expect_contact(first, second, pose, velocity, ours.t_min_s, ours.first);
    expect_contact(first, second, pose, velocity, ours.t_max_s, ours.last);
  }
}

void compare_integer_bodies(std::uint64_t seed, Tally& tally) {
  Rng rng(seed);
  const ConvexPolytope first = oracles::integer_body(rng);
  const ConvexPolytope second = oracles::integer_body(rng);
  ContactIntervalQuery query((ConvexBody(first)), ConvexBody(second));
  const auto within = [&](std::uint64_t half) {
    return static_cast<double>(rng.below(2 * half + 1)) - static_cast<double>(half);
  };
  for (int step = 0; step < 4; ++step) {
    PairPose pose;
    pose.rotation = oracles::axis_rotation(rng);
    pose.translation = {within(15), within(15), within(15)};
    Vec3 velocity{within(4), within(4), within(4)};
    if (step % 2 == 0) velocity = Vec3{within(2), within(2), within(2)} - pose.translation;
    if (velocity == Vec3{}) velocity = {1, 0, 0};
    compare(first, second, query, pose, velocity, tally);
  }
}

TEST(MotionOracle, AgreesWithBisectionOnIntegerBodiesAndSymmetricSolids) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < times_long(120); ++seed) compare_integer_bodies(seed, tally);
  expect_agreement(tally);
  EXPECT_LT(tally.undecided, static_cast<int>(times_long(20)));
  EXPECT_GT(tally.count(MotionOutcome::NeverMeet), 20);
  EXPECT_GT(tally.count(MotionOutcome::HasPassed), 10);
  EXPECT_GT(tally.count(MotionOutcome::Touching), 20);
  EXPECT_GT(tally.count(MotionOutcome::WillMeet), 20);
}

TEST(MotionOracle, AgreesWithBisectionOnBoneLikeBodiesInAnyPose) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < times_long(16); ++seed) {
    Rng rng(seed);
    const ConvexPolytope first = oracles::pebble(rng, 24);
    const ConvexPolytope second = oracles::pebble(rng, 16);
    ContactIntervalQuery query((ConvexBody(first)), ConvexBody(second));
    const Vec3 axis = normalized_or({rng.normal(), rng.normal(), rng.normal()}, {1, 0, 0});
    PairPose pose{rotation_about(axis, rng.uniform(0, 6)),
                  {rng.uniform(-20, 20), rng.uniform(-15, 15), rng.uniform(-15, 15)}};
    const Vec3 velocity =
        pose.translation * -1 + Vec3{rng.normal(), rng.normal(), rng.normal()} * 4;
    for (int step = 0; step < 4; ++step) {  // past contact, through it, and beyond
      compare(first, second, query, pose, velocity, tally);
      pose.rotation = rotation_about(axis, 0.02) * pose.rotation;
      pose.translation += velocity * 0.5;
    }
  }
  expect_agreement(tally);
  EXPECT_GT(tally.count(MotionOutcome::Touching), 3);
}

}  // namespace
}  // namespace carpus
