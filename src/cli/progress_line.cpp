// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/progress_line.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace carpus::cli {

void show_progress(std::string_view stage, double fraction) {
  static const bool kIsTerminal = ::isatty(STDERR_FILENO) == 1;
  static std::string shown;
  if (!kIsTerminal && stage == shown) return;
  shown = stage;
  const int percent = static_cast<int>(std::lround(100 * fraction));
  std::fprintf(stderr, "%s[%3d %%] %-24.*s%s", kIsTerminal ? "\r" : "", percent,
               static_cast<int>(stage.size()), stage.data(),
               kIsTerminal && fraction < 1 ? "" : "\n");
  std::fflush(stderr);
}

}  // namespace carpus::cli
