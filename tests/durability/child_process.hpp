// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Processes that may end at any moment, and how many of these moments a test tries.
#pragma once

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>

namespace carpus::durability {

/// Whether more moments are asked for.
inline bool is_long() {
  const char* const value = std::getenv("CARPUS_LONG");
  return value != nullptr && *value != '\0';
}

/// A child process that ends with what `work` returns.
template <typename Work>
pid_t start(Work&& work) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  int status = 1;
  try {
    status = work();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "child: %s\n", error.what());
  }
  ::_exit(status);
}

/// Its exit status; minus the signal that ended it.
inline int wait_for(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace carpus::durability
