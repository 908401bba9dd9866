// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Ctrl+C during long work: it ends at its next report of progress, and says that nothing is left
// behind.
#pragma once

#include <string_view>

#include "core/error.hpp"

namespace carpus::cli {

/// Whoever works asked to be stopped.
class Stopped : public Error {
 public:
  Stopped() : Error("stopped as asked; nothing was written") {}
};

/// While it lives, Ctrl+C (SIGINT) and SIGTERM are noted instead of ending the program. One at a
/// time.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  /// A core/progress.hpp reporter: shows progress. @throws Stopped where that was asked for.
  static void show_or_stop(std::string_view stage, double fraction);
};

}  // namespace carpus::cli
