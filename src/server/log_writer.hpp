// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Lines for the person who runs a station, written in a thread of their own: a reader that stops
// reading, or goes away, holds up nobody.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <string>
#include <thread>

namespace carpus::server {

class LogWriter {
 public:
  /// Lines that may wait for a reader; further ones are counted and said later.
  static constexpr std::size_t kMostLines = 1000;

  /// @param file  a descriptor that outlives it. SIGPIPE must be ignored.
  explicit LogWriter(int file);
  /// Writes what waits, as far as a reader takes it without waiting long.
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// From any thread; never waits.
  void write(std::string line);

 private:
  void run();
  void put(const std::string& text);

  int file_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> lines_;
  std::size_t dropped_ = 0;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace carpus::server
