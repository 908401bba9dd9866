// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// No tick allocates.
#include <gtest/gtest.h>

#include <vector>

#include "core/counting_new_test_support.hpp"
#include "simulation/operation_test_support.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {
namespace {

TEST(AllocationGuard, CountsWhatItShould) {
  carpus::test::start_counting_allocations();
  auto* volatile number = new int(3);
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 1);
  delete number;
}

TEST(AllocationGuard, AWholeOperationAllocatesNothing) {
  std::vector<Input> inputs;
  test::Operator op([&](const Input& input) { inputs.push_back(input); });
  test::operate(op);
  op.command(test::simple(CommandKind::Undo));
  op.command(test::simple(CommandKind::Undo));
  op.command(test::simple(CommandKind::Finish));
  ASSERT_TRUE(op.now().finished);

  World world(test::wrist(), test::exercise(), 1);
  carpus::test::start_counting_allocations();
  for (const Input& input : inputs) world.step(input);
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
  EXPECT_EQ(world.now().state_hash, op.now().state_hash);
  EXPECT_GT(inputs.size(), 10000U);
}

}  // namespace
}  // namespace carpus::simulation
