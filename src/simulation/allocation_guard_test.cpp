// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// No tick allocates: the global operator new counts while the guard is on.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <vector>

#include "simulation/operation_test_support.hpp"
#include "simulation/world.hpp"

namespace {
std::atomic<bool> guard_is_on{false};
std::atomic<std::size_t> guarded_allocations{0};

void* counted_allocation(std::size_t size) {
  if (guard_is_on) ++guarded_allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) { return counted_allocation(size); }
void* operator new[](std::size_t size) { return counted_allocation(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace carpus::simulation {
namespace {

TEST(AllocationGuard, CountsWhatItShould) {
  guarded_allocations = 0;
  guard_is_on = true;
  auto* volatile number = new int(3);
  guard_is_on = false;
  delete number;
  EXPECT_EQ(guarded_allocations, 1U);
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
  guarded_allocations = 0;
  guard_is_on = true;
  for (const Input& input : inputs) world.step(input);
  guard_is_on = false;
  EXPECT_EQ(guarded_allocations, 0U);
  EXPECT_EQ(world.now().state_hash, op.now().state_hash);
  EXPECT_GT(inputs.size(), 10000U);
}

}  // namespace
}  // namespace carpus::simulation
