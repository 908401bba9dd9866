// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the tests of this module share: a folder that vanishes, an attempt, a full disk.
#pragma once

#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "records/attempt.hpp"

namespace carpus::records::testing {

/// A folder of its own that is removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "carpus-records-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return path_ / name;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// While it lives, no file of this process may grow beyond a size: what a full disk does.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &old_limit_);
    rlimit limit = old_limit_;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit old_limit_{};
  void (*old_handler_)(int) = nullptr;
};

/// A finished attempt whose recording has `bytes` bytes of every value.
[[nodiscard]] inline Attempt make_attempt(const std::string& trainee, std::size_t bytes = 1000) {
  Attempt attempt;
  attempt.summary.trainee = trainee;
  attempt.summary.case_name = "demo wrist";
  attempt.summary.case_fingerprint = "00ff00ff00ff00ff";
  attempt.summary.case_simulated = true;
  attempt.summary.procedure = "dorsal_scaphoid_fixation";
  attempt.summary.input_device = "mouse";
  attempt.summary.started_at = "2026-01-31T12:00:00.000Z";
  attempt.summary.ended_at = "2026-01-31T12:05:00.250Z";
  attempt.summary.outcome = Outcome::Finished;
  attempt.summary.overall = 87.25;
  attempt.summary.duration_ticks = 300250;
  attempt.summary.final_hash = "0123456789abcdef";
  attempt.score_json = R"({"overall":87.25})";
  attempt.events_json = R"([{"tick":5,"kind":"touched_bone","text":"scaphoid"}])";
  for (std::size_t i = 0; i < bytes; ++i) {
    attempt.recording.push_back(static_cast<std::byte>(i * 7919 >> 3));
  }
  return attempt;
}

}  // namespace carpus::records::testing
