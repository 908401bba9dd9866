// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What holds of every net that yields, whatever it is made of.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "core/rng.hpp"
#include "geometry/pose.hpp"
#include "yielding/net_state.hpp"

namespace carpus::yielding::test {

/// A tip of 1 mm that is pressed on by so much until it rests: how deep it is.
inline double depth_under(const Net& net, const Vec3& at, double newtons, NetState& state) {
  double depth = 0;
  for (int tick = 0; tick < 2000; ++tick) {
    Tip tip;
    tip.is_there = true;
    tip.radius_mm = 1;
    tip.at = at + Vec3{0, 0, 1.0 - depth};
    state.step(net, std::span<const Tip>(&tip, 1));
    depth += 0.01 * (newtons - state.force_on(0).z);
  }
  return depth;
}

/// Without input the energy never grows, from any state, and it rests within 2 s.
/// @param half_mm  of the net about its origin, in z = 0
inline void only_loses_energy_and_rests(const Net& net,
                                        const Pose<frame::Bone, frame::Bone>& first_from_second,
                                        double half_mm) {
  const auto state = std::make_unique<NetState>();
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    state->reset(net);
    state->lay(net, first_from_second);
    // Thrown about by two tips for a tenth of a second.
    for (int tick = 0; tick < 100; ++tick) {
      std::array<Tip, 2> tips;
      for (Tip& tip : tips) {
        tip.is_there = true;
        tip.radius_mm = rng.uniform(0.5, 2.0);
        tip.at = {rng.uniform(-half_mm, half_mm), rng.uniform(-half_mm, half_mm),
                  rng.uniform(-2, 1)};
        if (rng.uniform() < 0.2) tip.hooked = rng.below(net.size());
      }
      state->step(net, tips);
    }
    double energy = state->energy_n_mm(net);
    EXPECT_GT(energy, 0);
    int ticks = 0;
    while (!state->is_still() && ticks < 4000) {
      state->step(net, {});
      const double now = state->energy_n_mm(net);
      ASSERT_LE(now, energy) << "seed " << seed << ", tick " << ticks;
      energy = now;
      ++ticks;
    }
    EXPECT_LT(ticks, 2000) << "seed " << seed;
    EXPECT_EQ(energy, 0);
  }
}

}  // namespace carpus::yielding::test
