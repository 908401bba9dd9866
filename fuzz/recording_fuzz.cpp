// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as a recording, behind them the checksum that a forger would make, and as the runs of a
// journal's part: refused in words, or a recording that comes back from its own bytes.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "checksum.hpp"
#include "refusals.hpp"
#include "simulation/recording.hpp"

namespace {

using namespace carpus;
using simulation::Recording;

/// Some 60 bytes of memory may come of one (recording.hpp).
void require_bounded(const std::vector<simulation::InputRun>& runs, std::size_t bytes) {
  fuzz::require(runs.size() <= bytes / 6);
  std::uint64_t ticks = 0;
  for (const simulation::InputRun& run : runs) ticks += run.ticks;
  fuzz::require(ticks <= simulation::kMaxRecordedTicks);
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
  const auto runs = simulation::decode_runs(bytes, size);
  if (runs) require_bounded(*runs, size + 4);
  return 0;
}
