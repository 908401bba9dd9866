// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A world's state as bytes: it comes back and goes on the same way, or is refused.
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "core/rng.hpp"
#include "simulation/operation_test_support.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {
namespace {

using test::Operator;
using test::wrist;

TEST(WorldState, ComesBackFromItsBytesAndGoesOnTheSameWay) {
  std::vector<Input> inputs;
  Operator op([&](const Input& input) { inputs.push_back(input); });
  test::operate(op);
  World whole(wrist(), test::exercise(), 1);
  World resumed(wrist(), test::exercise(), 1);
  const std::size_t cut = inputs.size() / 2;
  for (std::size_t i = 0; i < cut; ++i) whole.step(inputs[i]);
  const std::vector<std::byte> bytes = whole.write_state();
  EXPECT_LT(bytes.size(), std::size_t{1} << 20U);
  const auto taken = resumed.read_state(bytes);
  ASSERT_TRUE(taken.has_value()) << taken.error();
  EXPECT_EQ(resumed.now().tick, whole.now().tick);
  EXPECT_EQ(resumed.now().state_hash, whole.now().state_hash);
  EXPECT_EQ(resumed.now().items, whole.now().items);
  for (std::size_t i = cut; i < inputs.size(); ++i) {
    whole.step(inputs[i]);
    resumed.step(inputs[i]);
    ASSERT_EQ(resumed.now().state_hash, whole.now().state_hash) << "input " << i;
  }
}

TEST(WorldState, DamagedBytesAreRefusedAndChangeNothing) {
  Operator op;
  op.place_on_entry({});
  op.drive_to(5.0);
  const std::vector<std::byte> good = op.world().write_state();
  const std::uint64_t hash = op.now().state_hash;
  Rng rng(5);
  for (int i = 0; i < 300; ++i) {
    std::vector<std::byte> bad = good;
    if (i % 2 == 0) {
      bad.resize(rng.below(bad.size()));
    } else {
      bad[rng.below(bad.size())] ^= static_cast<std::byte>(1U << rng.below(8));
    }
    EXPECT_FALSE(op.world().read_state(bad).has_value());
  }
  EXPECT_EQ(op.now().state_hash, hash);
}

}  // namespace
}  // namespace carpus::simulation
