// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// For tests of what must not allocate: counts the calls of operator new on this thread. One file of
// the test program includes core/counting_new_test_support.hpp as well.
#pragma once

namespace carpus::test {

/// Starts the count at zero.
void start_counting_allocations() noexcept;
/// Stops, and gives the number of allocations since the start.
[[nodiscard]] int stop_counting_allocations() noexcept;

}  // namespace carpus::test
