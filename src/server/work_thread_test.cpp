// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/work_thread.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <vector>

namespace carpus::server {
namespace {

TEST(WorkThread, DoesEverythingInOrderBeforeItEnds) {
  std::vector<int> done;
  {
    WorkThread thread(100);
    for (int i = 0; i < 100; ++i) {
      while (!thread.post([&done, i] { done.push_back(i); })) std::this_thread::yield();
    }
  }
  ASSERT_EQ(done.size(), 100U);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(done[static_cast<std::size_t>(i)], i);
}

TEST(WorkThread, TakesNoMoreThanMayWait) {
  std::promise<void> go;
  std::promise<void> begun;
  std::atomic<int> done{0};
  {
    WorkThread thread(2);
    ASSERT_TRUE(thread.post([&] {
      begun.set_value();
      go.get_future().wait();
    }));
    begun.get_future().wait();
    EXPECT_TRUE(thread.post([&] { ++done; }));
    EXPECT_TRUE(thread.post([&] { ++done; }));
    EXPECT_FALSE(thread.post([&] { ++done; }));
    go.set_value();
  }
  EXPECT_EQ(done, 2);
}

}  // namespace
}  // namespace carpus::server
