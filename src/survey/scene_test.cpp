// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/scene.hpp"
#include "survey/methods.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/allocation_test_support.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "geometry/tolerance.hpp"
#include "hull/quickhull.hpp"

namespace carpus::survey {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

int forgotten = 0;

/// Bounding spheres in place of the bodies: a method whose truth is one line.
class Spheres final : public convex::PairQuery {
 public:
  Spheres(const convex::ConvexBody& first, const convex::ConvexBody& second)
      : first_(first), second_(second) {}

  convex::Verdict meets(const convex::PairPose& pose) noexcept override {
    const double gap = gap_at(pose);
    if (std::isnan(gap)) return convex::Verdict::Unknown;
    return gap <= 0 ? convex::Verdict::Meet : convex::Verdict::Apart;
  }
  std::optional<convex::Closest> closest(const convex::PairPose& pose) noexcept override {
    const double gap = gap_at(pose);
    if (!(gap > 0)) return std::nullopt;
    return convex::Closest{gap, {}, {}, {1, 0, 0}};
  }
  void forget() noexcept override { ++forgotten; }

 private:
  [[nodiscard]] double gap_at(const convex::PairPose& pose) const noexcept {
    const Vec3 centre = pose.rotation * second_.interior_point() + pose.translation;
    return distance(centre, first_.interior_point()) - inner(first_) - inner(second_);
  }
  /// Inside the body's box, so that boxes apart are spheres apart.
  static double inner(const convex::ConvexBody& body) noexcept {
    const Vec3 low = body.interior_point() - body.box().low;
    const Vec3 high = body.box().high - body.interior_point();
    return std::min({low.x, low.y, low.z, high.x, high.y, high.z}) / 2;
  }

  const convex::ConvexBody& first_;
  const convex::ConvexBody& second_;
};

constexpr Method kSpheres{"spheres",
                          "",
                          true,
                          false,
                          "",
                          [](const convex::ConvexBody& first, const convex::ConvexBody& second) {
                            return std::unique_ptr<convex::PairQuery>(new Spheres(first, second));
                          }};

std::vector<convex::ConvexBody> pebbles(std::size_t count) {
  Rng rng(count);
  std::vector<convex::ConvexBody> bodies;
  while (bodies.size() < count) {
    std::vector<Vec3> points;
    const Vec3 centre{rng.uniform(-15, 15), rng.uniform(-15, 15), rng.uniform(-15, 15)};
    for (int i = 0; i < 40; ++i) {
      const Vec3 p = normalized_or({rng.normal(), rng.normal(), rng.normal()}, {1, 0, 0});
      points.push_back(centre + Vec3{14 * p.x, 10 * p.y, 9 * p.z});
    }
    bodies.emplace_back(hull::build_convex_hull(points).polytope);
  }
  return bodies;
}

BodyPose random_pose(Rng& rng, double range) {
  return {rotation_from_quaternion(rng.normal(), rng.normal(), rng.normal(), rng.normal()),
          {rng.uniform(-range, range), rng.uniform(-range, range), rng.uniform(-range, range)}};
}

/// A pose, then many near it, then another: small motion and jumps.
void move(std::vector<BodyPose>& poses, Rng& rng, int tick) {
  for (BodyPose& pose : poses) {
    if (tick % 20 == 0) pose = random_pose(rng, 25);
    pose.translation += Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)} * 0.3;
    pose.rotation = rotation_about({0, 0, 1}, rng.uniform(-0.02, 0.02)) * pose.rotation;
  }
}

std::vector<convex::Verdict> verdicts_without_scene(const std::vector<convex::ConvexBody>& bodies,
                                                    const std::vector<BodyPose>& poses) {
  std::vector<convex::Verdict> verdicts;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      verdicts.push_back(Spheres(bodies[i], bodies[j]).meets(relative_pose(poses[i], poses[j])));
    }
  }
  return verdicts;
}

TEST(Scene, GivesTheMethodsVerdictForEveryPairUnderEveryBroadPhase) {
  const std::vector<convex::ConvexBody> bodies = pebbles(12);
  std::vector<Scene> scenes;
  for (const BroadPhase phase :
       {BroadPhase::None, BroadPhase::AllBoxes, BroadPhase::SweepAndPrune}) {
    scenes.emplace_back(bodies, kSpheres, phase);
  }
  Rng rng(3);
  std::vector<BodyPose> poses(bodies.size());
  std::array<std::size_t, 3> queries{};
  std::size_t meeting = 0;
  for (int tick = 0; tick < 400; ++tick) {
    move(poses, rng, tick);
    if (tick % 37 == 0) scenes[2].forget();
    const std::vector<convex::Verdict> expected = verdicts_without_scene(bodies, poses);
    const auto expected_meeting = static_cast<std::size_t>(
        std::count(expected.begin(), expected.end(), convex::Verdict::Meet));
    for (std::size_t s = 0; s < scenes.size(); ++s) {
      const SceneTick done = scenes[s].update(poses);
      const bool agrees =
          std::equal(expected.begin(), expected.end(), scenes[s].verdicts().begin());
      ASSERT_TRUE(agrees && done.meeting == expected_meeting) << "tick " << tick;
      queries[s] += done.queries;
    }
    meeting += expected_meeting;
  }
  EXPECT_EQ(queries[0], 400U * 66U);
  EXPECT_EQ(queries[1], queries[2]);
  EXPECT_LT(queries[1], queries[0] * 3 / 4);
  EXPECT_GT(meeting, 50U);
}

/// How far relative_pose() places v from where exact arithmetic would.
long double misplacement(const BodyPose& first, const BodyPose& second, const Vec3& v) {
  using Real = long double;
  const convex::PairPose pose = relative_pose(first, second);
  std::array<Real, 3> off{};
  for (std::size_t r = 0; r < 3; ++r) {
    off[r] = pose.translation[r];
    for (std::size_t c = 0; c < 3; ++c) off[r] += Real{pose.rotation.rows[r][c]} * v[c];
  }
  for (std::size_t k = 0; k < 3; ++k) {
    Real world = Real{second.translation[k]} - first.translation[k];
    for (std::size_t c = 0; c < 3; ++c) world += Real{second.rotation.rows[k][c]} * v[c];
    for (std::size_t r = 0; r < 3; ++r) off[r] -= world * first.rotation.rows[k][r];
  }
  return std::sqrt(off[0] * off[0] + off[1] * off[1] + off[2] * off[2]);
}

TEST(Scene, RoundsAPairsPoseWithinItsBound) {
  Rng rng(5);
  for (int i = 0; i < 2000; ++i) {
    const BodyPose first = random_pose(rng, 1000);
    const BodyPose second = random_pose(rng, i % 2 == 0 ? 1000 : 1e-3);
    const Vec3 v{rng.uniform(-200, 200), rng.uniform(-200, 200), rng.uniform(-200, 200)};
    const double sizes = 9 * length(v) + 7 * distance(first.translation, second.translation);
    ASSERT_LE(misplacement(first, second, v), kRoundoff * sizes);
  }
}

TEST(Scene, GivesDistancesOfAllPairsOrOfThoseWithinALimit) {
  const std::vector<convex::ConvexBody> bodies = pebbles(8);
  Scene scene(bodies, kSpheres, BroadPhase::SweepAndPrune);
  Rng rng(11);
  std::vector<BodyPose> poses(bodies.size());
  std::size_t beyond = 0;
  for (int tick = 0; tick < 100; ++tick) {
    move(poses, rng, tick);
    const SceneTick all = scene.update_distances(poses);
    ASSERT_EQ(all.queries, scene.pair_count());
    const std::vector<double> exact(scene.distances_mm().begin(), scene.distances_mm().end());
    const std::vector<convex::Verdict> verdicts(scene.verdicts().begin(), scene.verdicts().end());
    scene.update_distances(poses, 4);
    for (std::size_t p = 0; p < exact.size(); ++p) {
      const double within = scene.distances_mm()[p];
      const bool is_right = within == exact[p] || (within == kInfinity && exact[p] > 4);
      const bool is_same = scene.verdicts()[p] == verdicts[p];
      ASSERT_TRUE(is_right && is_same && (exact[p] == 0) == (verdicts[p] == convex::Verdict::Meet));
      beyond += within == kInfinity ? 1 : 0;
    }
  }
  EXPECT_GT(beyond, 100U);
}

/// Only the pairs of body 2 are unknown.
bool is_unknown_of_body_2(const Scene& scene) {
  for (std::size_t p = 0; p < scene.pair_count(); ++p) {
    const bool has_it = scene.pair(p).first == 2 || scene.pair(p).second == 2;
    if ((scene.verdicts()[p] == convex::Verdict::Unknown) != has_it) return false;
  }
  return true;
}

TEST(Scene, KnowsNothingOfABodyWhosePoseIsNotFinite) {
  const std::vector<convex::ConvexBody> bodies = pebbles(5);
  for (const BroadPhase phase :
       {BroadPhase::None, BroadPhase::AllBoxes, BroadPhase::SweepAndPrune}) {
    Scene scene(bodies, kSpheres, phase);
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
      std::vector<BodyPose> poses(bodies.size());
      poses[2].translation.y = bad;
      EXPECT_EQ(scene.update_distances(poses).unknown, 4U);
      EXPECT_TRUE(is_unknown_of_body_2(scene));
      EXPECT_TRUE(std::isnan(scene.distances_mm()[pair_number(0, 2, 5)]));
      EXPECT_FALSE(std::isnan(scene.distances_mm()[pair_number(0, 1, 5)]));
      poses[2].translation.y = 0;
      poses[2].rotation.rows[1].z = bad;
      EXPECT_EQ(scene.update(poses).unknown, 4U);
      EXPECT_TRUE(is_unknown_of_body_2(scene));
    }
    EXPECT_EQ(scene.update(std::vector<BodyPose>(bodies.size())).unknown, 0U);
  }
}

TEST(Scene, AllocatesNothingInAnUpdate) {
  const std::vector<convex::ConvexBody> bodies = pebbles(6);
  Scene none(bodies, kSpheres, BroadPhase::None);
  Scene boxes(bodies, kSpheres, BroadPhase::AllBoxes);
  Scene sweep(bodies, kSpheres, BroadPhase::SweepAndPrune);
  Rng rng(2);
  std::vector<BodyPose> poses(bodies.size());
  carpus::test::start_counting_allocations();
  for (int tick = 0; tick < 40; ++tick) {
    move(poses, rng, tick);
    for (Scene* scene : {&none, &boxes, &sweep}) {
      scene->update(poses);
      scene->update_distances(poses, 2);
    }
    sweep.forget();
  }
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
}

TEST(Scene, ForgetsInEveryQuery) {
  const std::vector<convex::ConvexBody> bodies = pebbles(4);
  Scene scene(bodies, kSpheres, BroadPhase::SweepAndPrune);
  forgotten = 0;
  scene.forget();
  EXPECT_EQ(forgotten, 6);
}

TEST(Scene, TakesNoBodiesAndRefusesAMethodWithoutQueries) {
  Scene empty({}, kSpheres, BroadPhase::SweepAndPrune);
  EXPECT_EQ(empty.update({}).queries, 0U);
  const std::vector<convex::ConvexBody> bodies = pebbles(2);
  EXPECT_THROW(Scene(bodies, Method{}, BroadPhase::None), InvalidInput);
}

}  // namespace
}  // namespace carpus::survey
