// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "core/counting_new_test_support.hpp"

namespace carpus::contact {
namespace {

TEST(AllocationGuard, CountsAnAllocation) {
  test::start_counting_allocations();
  auto* volatile number = new int(3);
  EXPECT_EQ(test::stop_counting_allocations(), 1);
  delete number;
}

}  // namespace
}  // namespace carpus::contact
