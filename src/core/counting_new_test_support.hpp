// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Replaces the global operator new and delete by ones that count; the array forms call these. To be
// included by exactly one file of a test program.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

#include "core/allocation_test_support.hpp"

namespace {
thread_local bool g_count_allocations = false;
thread_local int g_allocations = 0;

void* counted(void* memory) {
  if (g_count_allocations) ++g_allocations;
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
}  // namespace

// Not inlined: the compiler would take malloc and free for a mismatch of new and free.
[[gnu::noinline]] void* operator new(std::size_t size) {
  return counted(std::malloc(size == 0 ? 1 : size));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(step, (size + step - 1) / step * step));
}
// Standard algorithms ask for their buffers this way.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  if (g_count_allocations) ++g_allocations;
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

namespace carpus::test {

void start_counting_allocations() noexcept {
  g_allocations = 0;
  g_count_allocations = true;
}
int stop_counting_allocations() noexcept {
  g_count_allocations = false;
  return g_allocations;
}

}  // namespace carpus::test
