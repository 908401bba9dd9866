// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/capped_run.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <exception>

#include "core/error.hpp"

namespace carpus::bench::detail {
namespace {

[[noreturn]] void be_the_child(const Caps& caps,
                               const std::function<void(void*)>& work,
                               void* result,
                               std::size_t size,
                               int out) {
  const rlimit memory{caps.memory_bytes, caps.memory_bytes};
  setrlimit(RLIMIT_AS, &memory);
  alarm(caps.seconds);
  const int nowhere = open("/dev/null", O_WRONLY);  // peers explain degenerate input at length
  if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);
  try {
    work(result);
    _exit(write(out, result, size) == static_cast<ssize_t>(size) ? 0 : 1);
  } catch (const std::exception&) {
    _exit(1);
  }
}

}  // namespace

bool run_in_child(const Caps& caps,
                  const std::function<void(void*)>& work,
                  void* result,
                  std::size_t size) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw IoError("carpus-bench: no pipe for a child process");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw IoError("carpus-bench: no child process; is the machine out of memory?");
  if (child == 0) {
    close(ends[0]);
    be_the_child(caps, work, result, size, ends[1]);
  }
  close(ends[1]);
  std::size_t received = 0;
  while (received < size) {
    const ssize_t n = read(ends[0], static_cast<char*>(result) + received, size - received);
    if (n <= 0) break;
    received += static_cast<std::size_t>(n);
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  return received == size && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace carpus::bench::detail
