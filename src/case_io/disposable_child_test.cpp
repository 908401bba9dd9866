// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/disposable_child.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

#include "case_io/detail/memory_room.hpp"
#include "case_io/detail/shared_array.hpp"
#include "core/error.hpp"
#include "core/is_sanitized.hpp"

namespace carpus::case_io {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using namespace std::chrono_literals;

/// What comes of such work, in words; "" where it is done.
std::string ending_of(const std::function<void()>& work, std::chrono::milliseconds deadline = 10s) {
  ChildTask task;
  task.subject = [](std::uint64_t) { return "scan.dcm"; };
  task.heap_bytes = std::uint64_t{64} << 20U;
  task.deadline = deadline;
  task.work = [&](std::atomic<std::uint64_t>&) { work(); };
  try {
    run_in_child(task);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(DisposableChild, HandsBackWhatItWroteIntoSharedMemory) {
  SharedArray<int> result(100000);
  EXPECT_EQ(ending_of([&] {
              for (std::size_t i = 0; i < result.values().size(); ++i) {
                result.values()[i] = static_cast<int>(i);
              }
            }),
            "");
  const std::vector<int> taken = result.take();
  for (std::size_t i = 0; i < taken.size(); ++i) ASSERT_EQ(taken[i], static_cast<int>(i));
}

TEST(DisposableChild, PassesOnAnErrorAsItWasThrown) {
  EXPECT_EQ(ending_of([] { throw IoError("a.dcm: is cut short"); }), "a.dcm: is cut short");
  EXPECT_THROW(
      {
        ChildTask task;
        task.subject = [](std::uint64_t) { return "scan.dcm"; };
        task.heap_bytes = std::uint64_t{64} << 20U;
        task.deadline = 10s;
        task.work = [](std::atomic<std::uint64_t>&) { throw InvalidInput("b"); };
        run_in_child(task);
      },
      InvalidInput);
  EXPECT_THAT(ending_of([] { throw std::runtime_error("odd"); }),
              AllOf(HasSubstr("scan.dcm"), HasSubstr("odd")));
}

TEST(DisposableChild, ACrashBecomesASentenceThatNamesTheFile) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGILL, SIGFPE}) {
    EXPECT_THAT(ending_of([&] { ::raise(signal); }),
                AllOf(HasSubstr("scan.dcm: its decoder crashed"), HasSubstr("copy it again")));
  }
  EXPECT_THAT(ending_of([] { std::abort(); }), HasSubstr("crashed"));
  EXPECT_THAT(ending_of([] { ::_exit(0); }), HasSubstr("crashed"));  // without its word, no result
}

TEST(DisposableChild, AHangEndsAtTheDeadline) {
  const auto began = std::chrono::steady_clock::now();
  EXPECT_THAT(ending_of(
                  [] {
                    volatile int turns = 0;
                    while (turns >= 0) turns = 1;
                  },
                  300ms),
              HasSubstr("scan.dcm: takes too long"));
  EXPECT_LT(std::chrono::steady_clock::now() - began, 5s);
}

TEST(DisposableChild, MayNotTakeMoreMemoryThanItWasGiven) {
  if (kIsSanitized) GTEST_SKIP() << "sanitizers map terabytes";
  EXPECT_THAT(ending_of([] {
                std::vector<std::vector<char>> all;
                for (int i = 0; i < 1000; ++i) all.emplace_back(std::size_t{1} << 20U, 'x');
              }),
              HasSubstr("scan.dcm: asks its decoder for more memory"));
}

TEST(DisposableChild, CanOpenNothingAndReachNobody) {
  const int held = ::open("/etc/hostname", O_RDONLY | O_CLOEXEC);
  EXPECT_EQ(ending_of([&] {
              if (::open("/etc/passwd", O_RDONLY) >= 0) throw IoError("opened a file");
              if (::open("/tmp/carpus_child_wrote", O_WRONLY | O_CREAT, 0600) >= 0) {
                throw IoError("made a file");
              }
              char byte = 0;
              if (::read(held, &byte, 1) >= 0)
                throw IoError("read from a descriptor of its parent");
              if (::fork() >= 0) throw IoError("made a process");
            }),
            "");
  ::close(held);
  EXPECT_FALSE(std::filesystem::exists("/tmp/carpus_child_wrote"));
  EXPECT_THAT(ending_of([] { (void)::socket(AF_INET, SOCK_STREAM, 0); }),
              HasSubstr("a system call that it may not make"));
  EXPECT_THAT(ending_of([] { ::kill(::getppid(), SIGTERM); }), HasSubstr("a system call"));
  EXPECT_THAT(ending_of([] { (void)::execl("/bin/true", "true", nullptr); }),
              HasSubstr("a system call"));
  EXPECT_THAT(ending_of([] {
                (void)::mmap(nullptr, 4096, PROT_READ | PROT_WRITE | PROT_EXEC,
                             MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
              }),
              HasSubstr("a system call"));
}

TEST(DisposableChild, WhatALibraryComplainsOfIsNoResult) {
  EXPECT_THAT(ending_of([] { std::fputs("Premature end of JPEG file\n", stderr); }),
              AllOf(HasSubstr("its decoder complains"), HasSubstr("Premature end of JPEG file")));
}

TEST(DisposableChild, TellsItsStepsInOrderAndNeverMoreThanThereAre) {
  std::vector<std::uint64_t> seen;
  ChildTask task;
  task.subject = [](std::uint64_t steps) { return "slice " + std::to_string(steps); };
  task.heap_bytes = std::uint64_t{64} << 20U;
  task.deadline = 10s;
  task.most_steps = 5;
  task.work = [](std::atomic<std::uint64_t>& steps) { steps = 1000000000; };
  task.watch = [&](std::uint64_t steps) { seen.push_back(steps); };
  run_in_child(task);
  EXPECT_EQ(seen, (std::vector<std::uint64_t>{1, 2, 3, 4, 5}));
  task.work = [](std::atomic<std::uint64_t>& steps) {
    steps = 3;
    std::abort();
  };
  task.watch = {};
  EXPECT_THAT(
      [&] {
        try {
          run_in_child(task);
        } catch (const Error& error) {
          return std::string(error.what());
        }
        return std::string();
      }(),
      HasSubstr("slice 3: its decoder crashed"));
}

TEST(DisposableChild, WorksWhileOtherThreadsHoldLocks) {
  if (kIsSanitized) GTEST_SKIP() << "a sanitizer's allocator is not made for a fork among threads";
  std::atomic<bool> is_over = false;
  std::vector<std::thread> busy;
  for (int i = 0; i < 3; ++i) {
    busy.emplace_back([&] {
      while (!is_over) std::vector<char>(1 << 16).resize(1 << 17);
    });
  }
  for (int i = 0; i < 100; ++i) {
    SharedArray<char> result(1);
    EXPECT_EQ(ending_of([&] { result.values()[0] = std::vector<char>(100000, 'c').back(); }), "");
    EXPECT_EQ(result.values()[0], 'c');
  }
  is_over = true;
  for (std::thread& t : busy) t.join();
}

TEST(MemoryRoom, RefusesWhatCannotBeHad) {
  EXPECT_GT(memory_room(), std::uint64_t{1} << 20U);
  require_memory(1, "v.nii");
  try {
    require_memory(std::uint64_t{1} << 50U, "v.nii");
    FAIL();
  } catch (const IoError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("v.nii: needs"), HasSubstr("MB are free")));
  }
}

}  // namespace
}  // namespace carpus::case_io
