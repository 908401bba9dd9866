// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// No tick allocates: the global operator new counts while the guard is on. The array forms call
// these.
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

void* counted(void* memory) {
  if (guard_is_on) ++guarded_allocations;
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
  return counted(std::malloc(size == 0 ? 1 : size));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(step, (size + step - 1) / step * step));
}
// Standard algorithms ask for their buffers this way.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  if (guard_is_on) ++guarded_allocations;
  return std::malloc(size == 0 ? 1 : size);
}
[[gnu::noinline]] void operator delete(void* memory, const std::nothrow_t& /*tag*/) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

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
