// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether scans may be shown: not while an assessed operation runs, to anybody, for whoever watches
// can tell who operates.
#pragma once

#include <atomic>

namespace carpus::server {

/// Set in the network's thread, asked in any.
class TruthGate {
 public:
  void close(bool on) noexcept { is_closed_.store(on); }
  [[nodiscard]] bool is_closed() const noexcept { return is_closed_.load(); }

 private:
  std::atomic<bool> is_closed_{false};
};

}  // namespace carpus::server
