// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "yielding/net_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "core/rng.hpp"
#include "yielding/net_of_sheet.hpp"
#include "yielding/net_test_support.hpp"

namespace carpus::yielding {
namespace {

using test::depth_under;

constexpr SheetMaterial kMaterial{20.0, 0.3, 0.8, 60.0};

/// A square sheet in z = 0, `half` mm to each side of the origin.
TriangleMesh square(double half, int cells) {
  TriangleMesh mesh;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      mesh.vertices.push_back({half * (2.0 * i / cells - 1), half * (2.0 * j / cells - 1), 0});
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (cells + 1) + i); };
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      mesh.facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.facets.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

Net sheet(const ComeOff* off = nullptr) {
  return net_of_sheet(square(5, 10), {0, 0, 1}, kMaterial, 0.9, off);
}

std::size_t nearest_of(const Net& net, const Vec3& at) {
  const auto state = std::make_unique<NetState>();
  state->reset(net);
  return state->nearest(net, at);
}

TEST(YieldingNet, ParticlesLieOnTheSheetAtLeastTheSpacingApartAndItsRimIsHeld) {
  const Net net = sheet();
  EXPECT_GT(net.size(), 80U);
  EXPECT_LE(net.size(), kMaxParticles);
  for (std::size_t a = 0; a < net.size(); ++a) {
    const Vec3& p = net.rest()[a];
    const bool is_on_rim = std::max(std::abs(p.x), std::abs(p.y)) > 4.99;
    EXPECT_EQ(net.is_held(a), is_on_rim);
    EXPECT_NEAR(net.normals()[a].z, 1, 1e-9);
    for (std::size_t b = 0; b < a; ++b) EXPECT_GE(distance(p, net.rest()[b]), 0.9);
  }
}

TEST(YieldingNet, PressedMoreItGivesMoreAndBearsWhatPresses) {
  const Net net = sheet();
  const auto state = std::make_unique<NetState>();
  double before = 0;
  for (const double newtons : {0.5, 1.0, 2.0}) {
    state->reset(net);
    const double depth = depth_under(net, {0, 0, 0}, newtons, *state);
    EXPECT_NEAR(state->force_on(0).z, newtons, 0.02 * newtons);
    EXPECT_GT(depth, before);
    before = depth;
  }
  EXPECT_LT(before, 2.5) << "it holds";
}

/// Without input the energy never grows, from any state, and it rests within 2 s.
TEST(YieldingNet, LeftToItselfItOnlyLosesEnergyAndComesToRest) {
  test::only_loses_energy_and_rests(sheet(), {}, 4);
}

TEST(YieldingNet, TheSameTipsGiveTheSameBits) {
  const Net net = sheet();
  const auto first = std::make_unique<NetState>();
  const auto second = std::make_unique<NetState>();
  for (NetState* state : {first.get(), second.get()}) {
    state->reset(net);
    (void)depth_under(net, {0.3, -0.2, 0}, 1.3, *state);
  }
  for (std::size_t i = 0; i < net.size(); ++i) {
    const Vec3 a = first->at(i);
    const Vec3 b = second->at(i);
    EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
  }
}

TEST(YieldingNet, WhatIsHookedFollowsAndPullsBackAndWhatHasComeOffIsSlack) {
  const Net whole = sheet();
  const ComeOff off{{5, -3, 0}, {5, 3, 0}, 3, 0.05, 0};
  const Net torn = sheet(&off);
  const std::size_t edge = nearest_of(whole, {4, 0, 0});
  const auto lift_under = [&](const Net& net, double newtons) {
    const auto state = std::make_unique<NetState>();
    state->reset(net);
    double lift = 0;
    for (int tick = 0; tick < 3000; ++tick) {
      Tip tip;
      tip.is_there = true;
      tip.hooked = edge;
      tip.at = net.rest()[edge] + Vec3{0, 0, lift};
      state->step(net, std::span<const Tip>(&tip, 1));
      lift += 0.01 * (newtons + state->force_on(0).z);
    }
    EXPECT_NEAR(state->force_on(0).z, -newtons, 0.02);
    return state->at(edge).z - net.rest()[edge].z;
  };
  const double intact = lift_under(whole, 1);
  EXPECT_GT(intact, 0);
  EXPECT_GT(lift_under(torn, 1), 2 * intact) << "slack where it has come off";
}

TEST(YieldingNet, WhatHasComeOffStandsOffWhereItRests) {
  const Net whole = sheet();
  const ComeOff off{{5, 0, 0}, {5, 0, 0}, 3, 0.1, 1.3};
  const Net torn = sheet(&off);
  const std::size_t edge = nearest_of(whole, {5, 0, 0});
  EXPECT_NEAR(torn.rest()[edge].z, 1.3, 0.2);
  const auto state = std::make_unique<NetState>();
  state->reset(torn);
  EXPECT_EQ(state->energy_n_mm(torn), 0) << "it is as long as it lies";
}

/// The particle that is nearest to the middle, and the nearest to it.
std::array<std::size_t, 2> neighbours_of_the_middle(const Net& net) {
  const std::size_t middle = nearest_of(net, {0, 0, 0});
  std::size_t next = net.size();
  for (std::size_t i = 0; i < net.size(); ++i) {
    const auto far = [&](std::size_t k) { return distance(net.rest()[k], net.rest()[middle]); };
    if (i != middle && (next == net.size() || far(i) < far(next))) next = i;
  }
  return {middle, next};
}

TEST(YieldingNet, WhatIsCutOutBearsNothing) {
  const Net net = sheet();
  const auto state = std::make_unique<NetState>();
  state->reset(net);
  const Vec3 middle{0, 0, 0};
  for (std::size_t i = 0; i < net.size(); ++i) {
    if (distance(net.rest()[i], middle) < 2.5) state->cut(net, i);
  }
  state->cut(net, net.size());  // there is none: nothing happens
  Tip tip;
  tip.is_there = true;
  tip.radius_mm = 1;
  tip.at = {0, 0, -0.5};
  for (int tick = 0; tick < 100; ++tick) state->step(net, std::span<const Tip>(&tip, 1));
  EXPECT_EQ(state->force_on(0), (Vec3{})) << "a tip goes through the hole";
  for (std::size_t i = 0; i < net.size(); ++i) EXPECT_EQ(state->at(i), net.rest()[i]) << i;
  tip.hooked = nearest_of(net, middle);
  tip.at = {0, 0, 2};
  ASSERT_TRUE(state->is_cut(tip.hooked));
  state->step(net, std::span<const Tip>(&tip, 1));
  EXPECT_EQ(state->force_on(0), (Vec3{})) << "a hook finds nothing to hold";
}

TEST(YieldingNet, ATipOnItsOtherSideIsBorneAlike) {
  const Net net = sheet();
  const auto pressed = [&](double side) {
    const auto state = std::make_unique<NetState>();
    state->reset(net);
    double depth = 0;
    for (int tick = 0; tick < 2000; ++tick) {
      Tip tip;
      tip.is_there = true;
      tip.is_behind = side < 0;
      tip.radius_mm = 1;
      tip.at = {0, 0, side * (1.0 - depth)};
      state->step(net, std::span<const Tip>(&tip, 1));
      depth += 0.01 * (0.5 - side * state->force_on(0).z);
    }
    EXPECT_NEAR(state->force_on(0).z, side * 0.5, 0.01);
    EXPECT_LT(side * state->at(nearest_of(net, {0, 0, 0})).z, -0.1);
    return depth;
  };
  EXPECT_NEAR(pressed(-1), pressed(1), 1e-9);
}

TEST(YieldingNet, WhatIsLeftBesideACutIsSlacker) {
  const Net net = sheet();
  const auto [middle, next] = neighbours_of_the_middle(net);
  const auto lift_of_next = [&, next = next](NetState& state) {
    double lift = 0;
    for (int tick = 0; tick < 3000; ++tick) {
      Tip tip;
      tip.is_there = true;
      tip.hooked = next;
      tip.at = net.rest()[next] + Vec3{0, 0, lift};
      state.step(net, std::span<const Tip>(&tip, 1));
      lift += 0.01 * (0.5 + state.force_on(0).z);
    }
    return state.at(next).z;
  };
  const auto whole = std::make_unique<NetState>();
  whole->reset(net);
  const auto cut = std::make_unique<NetState>();
  cut->reset(net);
  cut->cut(net, middle);
  EXPECT_GT(lift_of_next(*cut), 1.05 * lift_of_next(*whole));
}

TEST(YieldingNet, CuttingAddsNoEnergyAndWhatIsLeftComesToRest) {
  const Net net = sheet();
  const auto state = std::make_unique<NetState>();
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Rng rng(seed);
    *state = {};
    state->reset(net);
    for (int tick = 0; tick < 100; ++tick) {
      Tip tip;
      tip.is_there = true;
      tip.radius_mm = 1;
      tip.at = {rng.uniform(-4, 4), rng.uniform(-4, 4), rng.uniform(-2, 1)};
      state->step(net, std::span<const Tip>(&tip, 1));
    }
    double energy = state->energy_n_mm(net);
    EXPECT_GT(energy, 0);
    int ticks = 0;
    while (!state->is_still() && ticks < 4000) {
      if (ticks % 20 == 0 && ticks < 200) {
        state->cut(net, rng.below(net.size()));
        ASSERT_LE(state->energy_n_mm(net), energy) << "seed " << seed << ", tick " << ticks;
        energy = state->energy_n_mm(net);
      }
      state->step(net, {});
      const double now = state->energy_n_mm(net);
      ASSERT_LE(now, energy) << "seed " << seed << ", tick " << ticks;
      energy = now;
      ++ticks;
    }
    EXPECT_LT(ticks, 2500) << "seed " << seed;
  }
}

TEST(YieldingNet, ReadBackAndCutAgainItGoesOnToTheSameBits) {
  const Net net = sheet();
  const auto state = std::make_unique<NetState>();
  state->reset(net);
  Tip tip;
  tip.is_there = true;
  tip.radius_mm = 1;
  tip.at = {1.5, 0.5, 0.2};
  const auto push = [&](NetState& pushed, int ticks) {
    for (int i = 0; i < ticks; ++i) pushed.step(net, std::span<const Tip>(&tip, 1));
  };
  push(*state, 20);
  const std::array<std::size_t, 2> taken = neighbours_of_the_middle(net);
  for (const std::size_t i : taken) {
    state->cut(net, i);
    push(*state, 15);
  }
  std::vector<double> written;
  NetState::visit(*state, net.size(), [&](const auto& field) {
    if constexpr (std::is_same_v<std::decay_t<decltype(field)>, Vec3>) {
      written.insert(written.end(), {field.x, field.y, field.z});
    } else {
      written.push_back(field ? 1.0 : 0.0);
    }
  });
  const auto again = std::make_unique<NetState>();
  again->reset(net);
  std::size_t from = 0;
  NetState::visit(*again, net.size(), [&](auto& field) {
    if constexpr (std::is_same_v<std::decay_t<decltype(field)>, Vec3>) {
      field = {written[from], written[from + 1], written[from + 2]};
      from += 3;
    } else {
      field = written[from++] != 0.0;
    }
  });
  for (const std::size_t i : taken) again->cut(net, i);
  push(*state, 50);
  push(*again, 50);
  for (std::size_t i = 0; i < net.size(); ++i) {
    const Vec3 a = state->at(i);
    const Vec3 b = again->at(i);
    EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0) << i;
  }
}

TEST(YieldingNet, ASheetWithoutFacetsHasNoParticlesAndStaysStill) {
  const Net none = net_of_sheet(TriangleMesh{}, {0, 0, 1}, kMaterial, 1);
  EXPECT_EQ(none.size(), 0U);
  const auto state = std::make_unique<NetState>();
  state->reset(none);
  Tip tip;
  tip.is_there = true;
  state->step(none, std::span<const Tip>(&tip, 1));
  EXPECT_TRUE(state->is_still());
  EXPECT_EQ(nearest_of(none, {0, 0, 0}), kMaxParticles);
}

}  // namespace
}  // namespace carpus::yielding
