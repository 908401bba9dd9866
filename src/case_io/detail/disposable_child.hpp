// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Work on foreign bytes in a process of its own, which may fail in any way: crash, hang, run out of
// memory, be taken over. It has no descriptor but a pipe for complaints, can open nothing, and ends
// with its work. docs/decisions/0032-foreign-bytes-in-a-child.md says why a fork and no program.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace carpus::case_io {

struct ChildTask {
  /// What `steps` counts so far, in words: the file that a message names.
  std::function<std::string(std::uint64_t steps)> subject;
  std::uint64_t heap_bytes = 0;          ///< that the work may ask for
  std::chrono::milliseconds deadline{};  ///< by the clock on the wall, and of processor time
  /// Runs in the child; its result goes into a SharedArray. Counts its steps. An exception of
  /// core/error.hpp comes out of run_in_child as it was.
  std::function<void(std::atomic<std::uint64_t>& steps)> work;
  std::uint64_t most_steps = 0;  ///< more are not believed
  /// Told in the parent of each step that is done; may be empty.
  std::function<void(std::uint64_t steps)> watch;
};

/// How long a reader may take: 20 s, and the time that the slowest disk and decoder need.
[[nodiscard]] std::chrono::milliseconds time_for(std::uint64_t bytes);

/// @throws what the work threw; IoError naming the subject where it crashed, hung, ran out of
/// memory or tried what it may not, and where a library complained on its standard error.
void run_in_child(const ChildTask& task);

}  // namespace carpus::case_io
