// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/plugin_device.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include "core/error.hpp"

namespace carpus::devices {
namespace {

TEST(Plugin, ALibraryOfSomebodyElsesIsADevice) {
  PluginDevice device(CARPUS_EXAMPLE_PLUGIN);
  DeviceState state;
  device.poll(1, state);
  EXPECT_EQ(state.health, Health::Closed);
  device.open();
  EXPECT_TRUE(device.capabilities().force);
  EXPECT_FALSE(device.capabilities().local_plane);
  EXPECT_EQ(device.capabilities().workspace.high.x, 60);
  DeviceCommand wish;
  wish.plane_count = 1;
  wish.planes[0] = {{0, 0, 1}, 2, 0.5, 0, 0};
  wish.limit_n = 3;
  device.command(2, wish);
  device.poll(3, state);
  EXPECT_EQ(state.health, Health::Good);
  EXPECT_DOUBLE_EQ(state.position_mm.z, 1);  // 2 mm deep, 0.5 N/mm: what it was told
  wish.limit_n = 1.25;                       // now it says what is no number
  device.command(4, wish);
  device.poll(5, state);
  EXPECT_EQ(state.health, Health::Faulty);
  EXPECT_TRUE(is_finite(state.position_mm));
  EXPECT_EQ(state.refused, 1U);
}

TEST(Plugin, SaysWhyItCannotBeOpened) {
  PluginDevice device(CARPUS_EXAMPLE_PLUGIN);
  ::setenv("CARPUS_EXAMPLE_UNPLUGGED", "1", 1);
  try {
    device.open();
    ADD_FAILURE();
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("plug it in"), std::string::npos);
  }
  ::unsetenv("CARPUS_EXAMPLE_UNPLUGGED");
  device.open();
  PluginDevice none("/nowhere/none.so");
  EXPECT_THROW(none.open(), IoError);
  PluginDevice other("libm.so.6");  // a library, and no plug-in
  EXPECT_THROW(other.open(), IoError);
}

}  // namespace
}  // namespace carpus::devices
