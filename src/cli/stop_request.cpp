// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/stop_request.hpp"

#include <csignal>

#include "cli/progress_line.hpp"

namespace carpus::cli {
namespace {

volatile std::sig_atomic_t is_asked = 0;

void note(int /*signal*/) { is_asked = 1; }

}  // namespace

StopRequest::StopRequest() {
  is_asked = 0;
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
}

StopRequest::~StopRequest() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

void StopRequest::show_or_stop(std::string_view stage, double fraction) {
  if (is_asked != 0) throw Stopped();
  show_progress(stage, fraction);
}

}  // namespace carpus::cli
