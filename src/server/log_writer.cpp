// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/log_writer.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace carpus::server {

namespace {

/// How often a reader that does not read is looked at again [ms].
constexpr int kLookMs = 100;
/// Looks after the end before what waits is left unsaid.
constexpr int kLastLooks = 10;
/// What a pipe takes whole or not at all.
constexpr std::size_t kWholeBytes = 512;

}  // namespace

LogWriter::LogWriter(int file) : file_(file), thread_([this] { run(); }) {}

LogWriter::~LogWriter() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void LogWriter::write(std::string line) {
  {
    const std::lock_guard lock(mutex_);
    if (lines_.size() >= kMostLines) {
      ++dropped_;
      return;
    }
    if (dropped_ > 0) {
      lines_.push_back("carpus: " + std::to_string(std::exchange(dropped_, 0)) +
                       " lines were not written: nobody read them");
    }
    lines_.push_back(std::move(line));
  }
  changed_.notify_all();
}

void LogWriter::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || !lines_.empty(); });
    if (lines_.empty()) return;
    const std::string text = std::move(lines_.front()) + "\n";
    lines_.pop_front();
    lock.unlock();
    put(text);
    lock.lock();
  }
}

void LogWriter::put(const std::string& text) {
  std::size_t at = 0;
  for (int looks = 0; at < text.size();) {
    pollfd reader{file_, POLLOUT, 0};
    if (::poll(&reader, 1, kLookMs) <= 0) {
      const std::lock_guard lock(mutex_);
      if (stopping_ && ++looks >= kLastLooks) {
        lines_.clear();
        return;
      }
      continue;
    }
    const ssize_t written =
        ::write(file_, text.data() + at, std::min(kWholeBytes, text.size() - at));
    if (written < 0 && errno != EINTR && errno != EAGAIN) return;  // nobody is there
    if (written > 0) at += static_cast<std::size_t>(written);
  }
}

}  // namespace carpus::server
