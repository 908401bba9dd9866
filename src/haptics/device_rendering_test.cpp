// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/allocation_test_support.hpp"
#include "core/counting_new_test_support.hpp"
#include "core/rng.hpp"
#include "core/units.hpp"
#include "haptics/leg_stops.hpp"
#include "haptics/local_planes.hpp"
#include "haptics/passivity_net.hpp"

namespace carpus::haptics {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(LocalPlanes, StandWhereTheProxyIsAndFaceOutOfTheBone) {
  const auto plane = plane_at({1, 2, 3}, {1, 2, 1}, {1, 0, 0}, {});
  ASSERT_TRUE(plane);
  EXPECT_EQ(plane->normal, (Vec3{0, 0, 1}));
  EXPECT_DOUBLE_EQ(plane->offset_mm, 3);
  EXPECT_EQ(plane_at({1, 2, 3}, {1, 2, 3}, {1, 0, 0}, {})->normal, (Vec3{1, 0, 0}));
  EXPECT_FALSE(plane_at({1, 2, 3}, {1, 2, 3}, {}, {}));
  EXPECT_FALSE(plane_at({kNan, 2, 3}, {1, 2, 3}, {kNan, 0, 0}, {}));
}

TEST(LocalPlanes, AFrameHoldsWhatWasWishedAndItsDeviceReadsIt) {
  ForceLimiter limiter(6);
  HapticWish wish;
  wish.plane_count = 2;
  wish.planes[0] = {{0, 0, 1}, -131.25, {2, 0.002, 0.25}};
  wish.planes[1] = {{kNan, 0, 1}, 0, {}};
  wish.besides_n = {0, 0, 9};
  const firmware::Contact frame = contact_frame(wish, 0.5, limiter);
  EXPECT_EQ(frame.normals[2], 16384);
  EXPECT_EQ(frame.offsets_um[0], -131'250);
  EXPECT_EQ(frame.stiffness_n_per_m[0], 1000);
  EXPECT_EQ(frame.damping_mns_per_m[0], 2000);
  EXPECT_EQ(frame.friction[0], 32);
  EXPECT_EQ(frame.stiffness_n_per_m[1], 0) << "what is no plane is left out";
  EXPECT_EQ(frame.force_mn[2], 6000);
  EXPECT_EQ(frame.limit_mn, 6000);
  EXPECT_EQ(limiter.limited_count(), 1U);
  std::uint8_t payload[firmware::kPayloadBytesOfContact];
  write_payload(frame, payload);
  firmware::Contact back;
  EXPECT_TRUE(read_payload(payload, back));
}

TEST(LocalPlanes, WhateverIsWishedTheFrameIsOneThatADeviceTakes) {
  Rng rng(7);
  const double odd[] = {kNan, std::numeric_limits<double>::infinity(), -1e300, 1e300, 0, 1, -1};
  const auto any = [&] { return rng.below(2) == 0 ? odd[rng.below(7)] : rng.uniform(-20, 20); };
  for (int i = 0; i < 5000; ++i) {
    ForceLimiter limiter(8);
    HapticWish wish;
    wish.plane_count = rng.below(4);
    for (SurfacePlane& plane : wish.planes) {
      plane = {normalized_or({any(), any(), any()}, {0, 0, 1}), any(), {any(), any(), any()}};
    }
    wish.besides_n = {any(), any(), any()};
    wish.limit_n = any();
    wish.vibration_n = any();
    wish.vibration_hz = any();
    const firmware::Contact frame = contact_frame(wish, any(), limiter);
    std::uint8_t payload[firmware::kPayloadBytesOfContact];
    write_payload(frame, payload);
    firmware::Contact back;
    ASSERT_TRUE(read_payload(payload, back));
  }
}

double early_at(const arm::DeltaArm& arm, const Vec3& tip, const Vec3& normal) {
  return early_mm(firmware::delta_forward(arm.size, arm::inverse(arm, tip)->data()), normal);
}

TEST(LegStops, StandTheEarlierTheFewerLegsBearThePress) {
  const arm::DeltaArm arm;
  EXPECT_NEAR(early_at(arm, arm.centre, {0, 0, 1}), 0.4, 0.05);
  EXPECT_NEAR(early_at(arm, arm.centre, {1, 0, 0}), 0.86, 0.02);
  EXPECT_NEAR(early_at(arm, arm.centre, {-1, 0, 0}), 0.86, 0.02);
  for (const double x : {-50.0, 50.0}) {
    for (const Vec3& normal : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      const double early = early_at(arm, arm.centre + Vec3{x, x, x < 0 ? -40.0 : 40.0}, normal);
      EXPECT_GT(early, 0.1);
      EXPECT_LE(early, kMostEarlyMm);
    }
  }
}

TEST(LegStops, CloseTheSideThatLeadsIntoTheBone) {
  const arm::DeltaArm arm;
  Rng rng(2);
  for (int i = 0; i < 500; ++i) {
    const Vec3 tip =
        arm.centre + Vec3{rng.uniform(-30, 30), rng.uniform(-30, 30), rng.uniform(-20, 20)};
    const Vec3 normal =
        normalized_or({rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)}, {0, 0, 1});
    const auto outside = arm::inverse(arm, tip);
    ASSERT_TRUE(outside);
    const double early = early_at(arm, tip, normal);
    const SurfacePlane plane{normal, dot(normal, tip) - 2 - early, {}};
    const auto inside = arm::inverse(arm, tip - normal * 3.0);
    ASSERT_TRUE(inside);
    const firmware::Stop stop = LegStops().at(arm, plane, *outside, tip, {});
    int closed = 0;
    for (std::size_t leg = 0; leg < 3; ++leg) {
      const firmware::LegStop& one = stop.legs[leg];
      if (one.side == firmware::LegStopSide::Free) continue;
      ++closed;
      const double wall = one.angle * kPi / 8192;
      const bool is_below = one.side == firmware::LegStopSide::NotBelow;
      EXPECT_GT(((*outside)[leg] - wall) * (is_below ? 1 : -1), -1e-3) << "free outside";
      EXPECT_LT(((*inside)[leg] - wall) * (is_below ? 1 : -1), 1e-3) << "closed inside";
    }
    EXPECT_GE(closed, 1);
  }
}

TEST(LegStops, GiveWayToALegThatLeansButNeverComeNearer) {
  const arm::DeltaArm arm;
  Rng rng(5);
  LegStops stops;
  const SurfacePlane plane{{0, 0, 1}, -130, {}};
  std::array<double, 3> last{9, 9, 9};
  for (int i = 0; i < 300; ++i) {
    // Slides about on the surface, leaning on every leg.
    const Vec3 tip{10 * std::sin(0.1 * i), rng.uniform(-5, 5), -130.5};
    const auto angles = arm::inverse(arm, tip);
    const firmware::Stop stop = stops.at(arm, plane, *angles, tip, {});
    for (std::size_t leg = 0; leg < 3; ++leg) {
      ASSERT_EQ(stop.legs[leg].side, firmware::LegStopSide::NotAbove);
      const double wall = stop.legs[leg].angle * kPi / 8192;
      const bool leans = i > 0 && (*angles)[leg] > last[leg] - 0.9 * kLeansRad;
      if (leans) {
        EXPECT_GE(wall, last[leg] - 1e-3) << i << " leg " << leg;
      }
      last[leg] = wall;
    }
  }
  // Lifted off, they stand on the surface again.
  const Vec3 above{0, 0, -120};
  const firmware::Stop stop = stops.at(arm, plane, *arm::inverse(arm, above), above, {});
  const auto exact = arm::inverse(arm, {0, 0, -130 + early_at(arm, above, {0, 0, 1})});
  for (std::size_t leg = 0; leg < 3; ++leg)
    EXPECT_NEAR(stop.legs[leg].angle * kPi / 8192, (*exact)[leg], 1e-3);
}

TEST(LegStops, AreFreeFarFromTheSurfaceOrWhereNothingIsKnown) {
  const arm::DeltaArm arm;
  for (const SurfacePlane& plane :
       {SurfacePlane{{0, 0, 1}, -300, {}}, SurfacePlane{{0, 0, 1}, kNan, {}},
        SurfacePlane{{0, 0, 1}, 400, {}}, SurfacePlane{{kNan, 0, 1}, -130, {}}}) {
    const auto stop = LegStops().at(arm, plane, {}, {0, 0, -130}, {});
    for (const auto& leg : stop.legs) EXPECT_EQ(leg.side, firmware::LegStopSide::Free);
  }
  const auto stop = LegStops().at(arm, {{0, 0, 1}, -131, {}}, {}, {0, 0, -130}, {kNan, 0, 0});
  for (const auto& leg : stop.legs) EXPECT_EQ(leg.side, firmware::LegStopSide::Free);
}

TEST(PassivityNet, LetsASpringBeAndCatchesWhatGivesMore) {
  PassivityNet net;
  double share = 1;
  for (int tick = 0; tick < 4000; ++tick) {
    const double depth = 1 - std::cos(0.01 * tick);
    share = std::min(share, net.share({0, 0, 2 * depth}, {0, 0, -depth}));
  }
  EXPECT_EQ(share, 1);
  EXPECT_EQ(net.catches(), 0);
  // A wall that lags by 20 ticks behind the hand at 16 Hz.
  for (int tick = 0; tick < 2000; ++tick) {
    const double depth = 1 - std::cos(0.1 * tick);
    const double late = 1 - std::cos(0.1 * (tick - 10));
    share = std::min(share, net.share({0, 0, 2 * late}, {0, 0, -depth}));
  }
  EXPECT_EQ(share, 0);
  EXPECT_GT(net.catches(), 0);
  EXPECT_EQ(net.share({0, kNan, 0}, {}), 0);
}

TEST(ForceLimiter, HasTheLastWord) {
  ForceLimiter limiter(5);
  EXPECT_EQ(limiter.limited({3, 0, 0}), (Vec3{3, 0, 0}));
  EXPECT_NEAR(length(limiter.limited({30, 40, 0})), 5, 1e-12);
  EXPECT_EQ(limiter.limited({kNan, 0, 0}), Vec3{});
  EXPECT_EQ(limiter.limit_n(kNan), 0);
  EXPECT_EQ(limiter.faults(), 2U);
}

TEST(DeviceRendering, AllocatesNothing) {
  const arm::DeltaArm arm;
  LegStops stops;
  ForceLimiter limiter(8);
  PassivityNet net;
  HapticWish wish;
  wish.plane_count = 1;
  wish.planes[0] = {{0, 0, 1}, -131, {}};
  int sum = 0;
  test::start_counting_allocations();
  for (int i = 0; i < 200; ++i) {
    const Vec3 tip{0, 0.1 * i, -130 - 0.01 * i};
    const auto plane = plane_at({0, 0, -131}, tip, {0, 0, 1}, {});
    sum += stops.at(arm, *plane, {0.3, 0.3, 0.3}, tip, {1, 2, 3}).legs[0].angle;
    sum += contact_frame(wish, net.share({0, 0, 1}, tip), limiter).limit_mn;
  }
  EXPECT_EQ(test::stop_counting_allocations(), 0);
  EXPECT_NE(sum, 0);
}

}  // namespace
}  // namespace carpus::haptics
