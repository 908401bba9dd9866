// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as a recording, behind them the checksum that a forger would make, and as the runs of a
// journal's part: refused in words, or a recording that comes back from its own bytes.
#include <cstddef>
#include <cstdint>
#include <span>

#include "checksum.hpp"
#include "refusals.hpp"
#include "simulation/recording.hpp"

namespace {

using namespace carpus;
using simulation::Recording;

/// No more bytes come of some, and what is decoded in passing is what was counted.
void require_bounded(const simulation::InputRuns& runs, std::size_t bytes) {
  fuzz::require(runs.size() <= bytes / 6 && runs.encoded_size() <= bytes);
  std::uint64_t ticks = 0;
  std::size_t count = 0;
  for (const simulation::InputRun& run : runs) {
    fuzz::require(run.ticks > 0 && run.input == simulation::quantised(run.input));
    ticks += run.ticks;
    ++count;
  }
  fuzz::require(count == runs.size() && ticks == runs.tick_count());
  fuzz::require(ticks <= simulation::kMaxRecordedTicks);
  if (ticks > 0) fuzz::require(*runs.at(ticks - 1) == runs.back());
}

void require_comes_back(const Recording& recording) {
  const auto again = simulation::decode(simulation::encode(recording));
  // Shorter by what was written in more bytes than it takes, it may claim too much for them.
  if (!again) return fuzz::require(recording.tick_count() > simulation::kTicksForNothing);
  fuzz::require(again->tick_count() == recording.tick_count());
  fuzz::require(again->keyframes == recording.keyframes);
  fuzz::require(simulation::encode(*again) == simulation::encode(recording));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  const auto forged = fuzz::with_checksum(bytes);
  const auto recording = simulation::decode(forged);
  if (recording) {
    ++fuzz::accepted;
    require_bounded(recording->runs, size);
    require_comes_back(*recording);
  } else {
    fuzz::require(!recording.error().empty());
  }
  simulation::InputRuns runs;
  const auto read = runs.decode(bytes, size);
  if (read) fuzz::require(*read <= size);
  require_bounded(runs, size);
  return 0;
}
