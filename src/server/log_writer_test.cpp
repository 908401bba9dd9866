// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/log_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <string>
#include <utility>

namespace carpus::server {
namespace {

struct Pipe {
  std::array<int, 2> ends{};
  Pipe() { EXPECT_EQ(::pipe(ends.data()), 0); }
  ~Pipe() {
    close_reader();
    ::close(ends[1]);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_reader() {
    if (ends[0] >= 0) ::close(std::exchange(ends[0], -1));
  }
};

TEST(LogWriter, WritesEveryLineInOrder) {
  Pipe pipe;
  {
    LogWriter log(pipe.ends[1]);
    for (int i = 0; i < 50; ++i) log.write("line " + std::to_string(i));
  }
  std::string text(4096, '\0');
  text.resize(static_cast<std::size_t>(::read(pipe.ends[0], text.data(), text.size())));
  EXPECT_THAT(text, ::testing::StartsWith("line 0\nline 1\n"));
  EXPECT_THAT(text, ::testing::EndsWith("line 49\n"));
}

TEST(LogWriter, AReaderThatStopsReadingHoldsUpNobody) {
  Pipe pipe;
  // Nobody ever reads: a writer that waited would wait for ever, at a line or at the end.
  LogWriter log(pipe.ends[1]);
  for (int i = 0; i < 5000; ++i) log.write(std::string(100, 'x'));
}

TEST(LogWriter, AReaderThatGoesAwayIsNoError) {
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  {
    Pipe pipe;
    LogWriter log(pipe.ends[1]);
    log.write("heard");
    pipe.close_reader();
    for (int i = 0; i < 100; ++i) log.write("not heard");
  }
  std::signal(SIGPIPE, before);
}

}  // namespace
}  // namespace carpus::server
