// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/journal_watch.hpp"

namespace carpus::server {

JournalWatch::Verdict JournalWatch::look(const std::optional<records::JournalProgress>& on_disk,
                                         Tick collected,
                                         Clock::time_point now) {
  if (!on_disk) return {};
  const bool is_behind = collected > on_disk->safe + kMostBehind;
  if (!is_behind) behind_since_.reset();
  if (is_behind && !behind_since_) behind_since_ = now;
  std::string problem = on_disk->problem;
  if (problem.empty() && is_behind && now - *behind_since_ > kMostWait) {
    problem = "The disk has taken nothing for some seconds";
  }
  Verdict verdict{is_behind && problem.empty(), {}};
  if (problem == said_) return verdict;
  // A disk that is merely slow to come back is not well yet.
  if (problem.empty() && is_behind) return verdict;
  verdict.word = problem.empty() ? "What is being done is kept on disk again." : problem;
  said_ = problem;
  return verdict;
}

}  // namespace carpus::server
