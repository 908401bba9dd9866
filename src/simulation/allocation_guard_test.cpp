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
  test::Operator op(test::posed_wrist(), [&](const Input& input) { inputs.push_back(input); });
  op.command({CommandKind::TakeShot, 0, 0, 0});
  op.command({CommandKind::TakeShot, 0, 90, 0});
  op.place_on_entry({{3, 2, 1}, {}});
  op.place_on_entry({});
  op.drive_to(24.0);
  op.command({CommandKind::Measure, 0, 0, 0});
  op.command({CommandKind::SelectScrew, 3, 0, 0});
  op.hold(Driver::Forward, 30.0, 3000);
  op.command({CommandKind::Undo, 0, 0, 0});
  op.hold(Driver::Reverse, 0.0, 8000);
  op.command({CommandKind::Finish, 0, 0, 0});

  World world(test::posed_wrist(), procedure::ProcedureId::DorsalScaphoidFixation, 1);
  carpus::test::start_counting_allocations();
  for (const Input& input : inputs) world.step(input);
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
  EXPECT_EQ(world.now().state_hash, op.now().state_hash);
  EXPECT_GT(inputs.size(), 10000U);
}

}  // namespace
}  // namespace carpus::simulation
