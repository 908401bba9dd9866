// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A program that is killed while it writes a case: the old one or the new one is there, whole, and
// what it left beside is cleared by the next that writes there.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <random>
#include <string>
#include <thread>

#include "case_io/atomic_folder.hpp"
#include "case_io/case_folder.hpp"
#include "case_io/small_case_test_support.hpp"

namespace carpus::case_io {
namespace {

namespace fs = std::filesystem;

class KilledWriter : public ::testing::Test {
 protected:
  KilledWriter() {
    std::string name = (fs::temp_directory_path() / "carpus-killed-XXXXXX").string();
    root_ = ::mkdtemp(name.data());
  }
  ~KilledWriter() override { fs::remove_all(root_); }
  [[nodiscard]] fs::path target() const { return root_ / "mine"; }
  [[nodiscard]] long entries() const {
    return std::distance(fs::directory_iterator(root_), fs::directory_iterator());
  }

  fs::path root_;
};

/// Writes one case over the other until it is killed.
[[noreturn]] void write_for_ever(const fs::path& target) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  cases::CaseData data = test::small_case();
  for (int i = 0;; ++i) {
    data.pseudonym = i % 2 == 0 ? "even" : "odd";
    write_case(data, target, Overwrite::Replace);
  }
}

TEST_F(KilledWriter, LeavesAWholeCaseAtAnyMoment) {
  const char* const is_long = std::getenv("CARPUS_LONG");
  const int moments = is_long != nullptr && *is_long != '\0' ? 1000 : 20;
  std::mt19937_64 random(1);
  write_case(test::small_case(), target());
  long most_entries = 0;
  for (int i = 0; i < moments; ++i) {
    const pid_t child = ::fork();
    if (child == 0) write_for_ever(target());
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 60'000));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const std::string found = read_case(target()).pseudonym;
    EXPECT_TRUE(found == "even" || found == "odd" || found == test::small_case().pseudonym)
        << found;
    most_entries = std::max(most_entries, entries());
  }
  EXPECT_LE(most_entries, 2) << "what earlier ones left is cleared by the next";
  write_case(test::small_case(), target(), Overwrite::Replace);
  EXPECT_EQ(entries(), 1);
}

/// The place of a program that is no more.
long dead_process() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return child;
}

TEST_F(KilledWriter, BetweenTwoRenamesLeavesTheOldCaseWhichIsPutBack) {
  // Where a file system cannot exchange two names, the old case waits beside for an instant.
  write_case(test::small_case(), target());
  fs::rename(target(), root_ / (".mine.partial-" + std::to_string(dead_process()) + "-old"));
  EXPECT_THROW(AtomicFolder(target(), Overwrite::Refuse), std::exception);
  EXPECT_EQ(read_case(target()).pseudonym, test::small_case().pseudonym);
  EXPECT_EQ(entries(), 1);
}

TEST_F(KilledWriter, OfARunningProgramNothingIsCleared) {
  const fs::path others = root_ / (".mine.partial-" + std::to_string(::getppid()));
  const fs::path foreign = root_ / ".mine.partial-notes";
  const fs::path contained = root_ / (".mine.partial-" + std::to_string(dead_process()));
  for (const fs::path& each : {others, foreign, contained}) fs::create_directory(each);
  const int lock = ::open(contained.c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  write_case(test::small_case(), target());
  EXPECT_TRUE(fs::exists(contained)) << "its number may be another container's";
  ::close(lock);
  EXPECT_TRUE(fs::exists(others));
  EXPECT_TRUE(fs::exists(foreign));
}

}  // namespace
}  // namespace carpus::case_io
