// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A probe held fast between two blocks in a box of a joint: they lie nearer to each other than it
// is thick, so that pushing out settles nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/rng.hpp"
#include "fields/distance_field.hpp"
#include "haptics/virtual_coupling.hpp"
#include "simulation/box_joint_test_support.hpp"
#include "simulation/muscle_hand_test_support.hpp"
#include "simulation/operation_test_support.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {
namespace {

using namespace box_joint;  // NOLINT(google-build-using-namespace)

constexpr double kHalfLongMm = 8;
constexpr double kProbeMm = 0.5;  // half as thick
constexpr double kApartMm = 0.6;  // of a block from the joint's middle plane, where it has room
constexpr double kCloseMm = 0.4;  // and where it has none

void make_block(cases::CaseData& data, BoneId id, double side, double from_middle_mm) {
  TriangleMesh mesh;
  for (const double z : {kCloseMm, 6.0}) {
    for (const double y : {-6.0, 6.0}) {
      for (const double x : {-kHalfLongMm, kHalfLongMm}) {
        mesh.vertices.push_back(kMiddle + Vec3{x, y, side * z});
      }
    }
  }
  mesh.facets = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  if (side < 0) {
    for (auto& facet : mesh.facets) std::swap(facet[1], facet[2]);
  }
  cases::Bone& bone = data.bones[test::body_of(id)];
  static_cast<TriangleMesh&>(bone.surface) = mesh;
  bone.distance_field = fields::build_distance_field(bone.surface, {0.25, 4.0});
  const auto group = static_cast<std::size_t>(anatomy::group_of(id));
  for (cases::HandMotionNode& node : data.hand_motion.nodes) {
    node.groups[group] = {{1, 0, 0, 0}, {0, 0, side * (from_middle_mm - kCloseMm)}};
  }
}

cases::CaseData wrist_with_blocks(double from_middle_mm) {
  cases::CaseData made = box_wrist();
  make_block(made, BoneId::Scaphoid, -1, from_middle_mm);
  make_block(made, BoneId::Lunate, 1, from_middle_mm);
  return made;
}

/// How deep the probe, a capsule that ends at its tip, is in blocks that are kCloseMm from the
/// middle.
double depth_of(const ItemView& probe) {
  constexpr double kLookedAtMm = 40;
  double most = 0;
  for (double s = kProbeMm; s < kLookedAtMm; s += 0.1) {
    const Vec3 at = probe.tip_in_patient + probe.shaft_in_patient * s - kMiddle;
    const double beyond = std::max(std::abs(at.x) - kHalfLongMm, 0.0);
    most = std::max(most, kProbeMm - std::hypot(beyond, kCloseMm - std::abs(at.z)));
  }
  return most;
}

/// A probe that lay with its tip in the joint's middle as the blocks closed on it.
class Wedged {
 public:
  Wedged() {
    static const std::vector<std::byte> kBefore = before();
    EXPECT_TRUE(world_.read_state(kBefore));
    hand_.lead(kMiddle);
    EXPECT_GT(world_.faults().unresolved_contacts, 0U) << "it has no room";
    EXPECT_LT(length(tip()), 1e-9);
  }
  [[nodiscard]] Hand& hand() { return hand_; }
  /// From the joint's middle.
  [[nodiscard]] Vec3 tip() const { return hand_.tip() - kMiddle; }
  [[nodiscard]] Vec3 force() const { return hand_.now().hands[0].force_in_patient; }
  [[nodiscard]] const ItemView& probe() const { return hand_.now().items[0]; }
  [[nodiscard]] bool is_in_joint() const { return hand_.now().scope.facts.is_in_joint[0]; }

 private:
  static std::vector<std::byte> before() {
    const cases::CaseData apart = wrist_with_blocks(kApartMm);
    World world(apart, probe_alone(), 1);
    Hand hand(world);
    hand.mm_per_tick = 0.1;
    enter(hand);
    EXPECT_TRUE(hand.now().scope.facts.is_in_joint[0]);
    EXPECT_EQ(world.faults().unresolved_contacts, 0U) << "it has room";
    return world.write_state();
  }
  static const cases::CaseData& close() {
    static const cases::CaseData kClose = wrist_with_blocks(kCloseMm);
    return kClose;
  }
  World world_{close(), probe_alone(), 1};
  Hand hand_{world_};
};

TEST(WedgedInJoint, SlidesOutAlongItsShaftNoDeeperAsTheHandDrawsBack) {
  constexpr double kToleranceMm = 1e-3;
  constexpr int kTicks = 20;  // 2 mm a tick at most
  for (const double aside_mm : {0.0, 1.5}) {
    Wedged held;
    const double first_mm = depth_of(held.probe());
    EXPECT_NEAR(first_mm, kProbeMm - kCloseMm, 1e-6);
    double last = 0;
    int ticks = 0;
    for (; ticks < kTicks && held.is_in_joint(); ++ticks) {
      held.hand().lead(kMiddle + Vec3{kHalf + 5, 0, aside_mm});
      const Vec3 tip = held.tip();
      ASSERT_LE(depth_of(held.probe()), first_mm + kToleranceMm) << "tick " << ticks;
      ASSERT_GE(tip.x, last) << "tick " << ticks;
      if (tip.x < kHalfLongMm - kProbeMm) {
        ASSERT_NEAR(std::hypot(tip.y, tip.z), 0.0, kToleranceMm) << "tick " << ticks;
      }
      last = tip.x;
    }
    EXPECT_FALSE(held.is_in_joint()) << "still in after " << ticks << " ticks, at " << last;
  }
}

TEST(WedgedInJoint, StaysWhereItIsPushedOnOrAside) {
  for (const Vec3& to : {Vec3{-6, 0, 0}, Vec3{0, 0, 6}, Vec3{0, 6, -6}}) {
    Wedged held;
    held.hand().mm_per_tick = 0.1;
    held.hand().go(kMiddle + to, 20);
    EXPECT_LT(length(held.tip()), 1e-3) << to.x << ' ' << to.y << ' ' << to.z;
  }
}

/// A jump leaves the first store alone, and the long way back takes all of it.
void spend(Wedged& held, const Vec3& way) {
  held.hand().lead(kMiddle + way * 10);
  held.hand().go(kMiddle + way);
  ASSERT_LT(length(held.force()), 1e-3);
}

TEST(WedgedInJoint, HoldsTheHandThatDrawsAwayWhateverWasSpentBefore) {
  for (const Vec3& way : {Vec3{-1, 0, 0}, Vec3{0, 0, 1}}) {
    Wedged held;
    spend(held, way);
    for (const double far_mm : {2.0, 5.0, 10.0}) {
      held.hand().go(kMiddle + way * far_mm, 20);
      EXPECT_NEAR(dot(held.force(), -way), far_mm * haptics::kContactStiffnessNPerMm, 0.01);
    }
    EXPECT_LT(length(held.tip()), 1e-3);
  }
}

TEST(WedgedInJoint, GivesBackNoMoreThanWasPutInAndAFirstStoreForEachTimeItIsDrawnAway) {
  Wedged held;
  spend(held, {0, 0, 1});
  Rng rng(1);
  test::MuscleHand muscle{kMiddle + Vec3{0, 0, 1}, {}};
  Vec3 wanted = muscle.place;
  Vec3 last = test::as_given(muscle.place);
  Vec3 force = held.force();
  double work = 0;  // on the hand [N mm]
  double most_put_in = 0;
  double may = haptics::kFirstStoredNMm;
  bool drew_away = false;
  int times = 0;
  for (int tick = 0; tick < 2000; ++tick) {
    if (tick % 150 == 0) wanted = kMiddle + Vec3{0, rng.uniform(-7, 7), rng.uniform(-7, 7)};
    muscle.step(wanted, force);
    const Vec3 at = test::as_given(muscle.place);
    const bool draws_away = dot(at - last, at - held.hand().tip()) > 0;
    if (draws_away && !drew_away) {
      may += haptics::kFirstStoredNMm;
      ++times;
    }
    drew_away = draws_away;
    work += dot(force, at - last);
    held.hand().lead(muscle.place);
    last = at;
    most_put_in = std::min(most_put_in, work);
    ASSERT_LE(work, may + 1e-9) << "tick " << tick;
    force = held.force();
  }
  EXPECT_LT(times, 200) << "the bound says something";
  EXPECT_LT(most_put_in, -1.0) << "the hand did work against it";
}

}  // namespace
}  // namespace carpus::simulation
