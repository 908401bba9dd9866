// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/device_aim.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carpus::server {
namespace {

devices::Capabilities arm() {
  devices::Capabilities able;
  able.position = able.absolute = able.force = true;
  return able;
}

TEST(DeviceAim, EachDeviceDoesWhatItDoesBest) {
  EXPECT_EQ(best_aim(arm()), Aim::Portal);
  devices::Capabilities haply = arm();
  haply.rotation = true;
  EXPECT_EQ(best_aim(haply), Aim::Own);
  devices::Capabilities pad;
  pad.position = true;
  EXPECT_EQ(best_aim(pad), Aim::Page);
  EXPECT_FALSE(can_aim(Aim::Portal, pad));
  // What it cannot do is the page's.
  DeviceAim aim;
  AimMoment moment;
  moment.page_shaft = {0, 1, 0};
  moment.own_shaft = {1, 0, 0};
  EXPECT_EQ(aim.shaft(Aim::Own, arm(), moment), (Vec3{0, 1, 0}));
}

TEST(DeviceAim, APortalTurnsWhereTheTipIsIntoWhereTheToolPoints) {
  DeviceAim aim;
  AimMoment moment;
  moment.page_shaft = {0, 0, 1};
  EXPECT_EQ(aim.shaft(Aim::Portal, arm(), moment), (Vec3{0, 0, 1}));
  moment.page_shaft = {0, 0.6, 0.8};  // before, the page's wheel turns it
  EXPECT_EQ(aim.shaft(Aim::Portal, arm(), moment), (Vec3{0, 0.6, 0.8}));
  moment.page_shaft = {0, 0, 1};
  moment.is_at_bone = true;
  EXPECT_LT(distance(aim.shaft(Aim::Portal, arm(), moment), {0, 0, 1}), 1e-12);
  EXPECT_TRUE(aim.is_in_portal());
  moment.tip = {25, 0, 0};  // the portal stays at (0, 0, 25)
  EXPECT_LT(distance(aim.shaft(Aim::Portal, arm(), moment), {-std::sqrt(0.5), 0, std::sqrt(0.5)}),
            1e-12);
  moment.page_shaft = {1, 0, 0};  // the wheel turns it no more
  EXPECT_LT(distance(aim.shaft(Aim::Portal, arm(), moment), {-std::sqrt(0.5), 0, std::sqrt(0.5)}),
            1e-12);
  // Drawn out, it is free, and still points where it did.
  moment.is_at_bone = false;
  moment.tip = {3, 0, 20};
  const Vec3 out = aim.shaft(Aim::Portal, arm(), moment);
  EXPECT_FALSE(aim.is_in_portal());
  moment.tip = {9, 9, 20};
  EXPECT_EQ(aim.shaft(Aim::Portal, arm(), moment), out);
  moment.page_shaft = {0, 1, 0};
  EXPECT_EQ(aim.shaft(Aim::Portal, arm(), moment), (Vec3{0, 1, 0}));
}

TEST(DeviceAim, ADeviceThatSaysHowFastItTurnsTurnsTheToolSo) {
  devices::Capabilities mouse;
  mouse.position = mouse.rotation = true;
  DeviceAim aim;
  AimMoment moment;
  moment.page_shaft = {0, 0, 1};
  moment.own_spin_rad_s = {0, 0.5, 0};
  Vec3 shaft;
  for (int i = 0; i < 1000; ++i) shaft = aim.shaft(Aim::Own, mouse, moment);
  EXPECT_NEAR(shaft.x, std::sin(0.5), 1e-3);
  EXPECT_NEAR(length(shaft), 1, 1e-9);
  moment.own_spin_rad_s = {std::nan(""), 0, 0};
  EXPECT_EQ(aim.shaft(Aim::Own, mouse, moment), shaft);
}

}  // namespace
}  // namespace carpus::server
