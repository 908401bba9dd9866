// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A recording: every tick's input, from which the whole operation can be replayed to the same
// bytes.
//
// Layout, all little-endian: "CARPREC1"; u16 format version; u8 length + program version; u64 case
// fingerprint; u8 procedure; u64 seed; then runs: u32 ticks (not 0), u8 mask of what changed, the
// changed fields as exact bits; u32 0; u64 ticks in all; u64 hash at the end; u64 FNV-1a of all
// bytes before it. A still hand costs nothing, a moving one 24 bytes a tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "core/result.hpp"
#include "procedure/procedure_id.hpp"
#include "procedure/score.hpp"
#include "simulation/input.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::simulation {

inline constexpr std::uint16_t kRecordingFormat = 1;

/// Longest exercise that is recorded: 4 hours. Bounds what decoding untrusted bytes may allocate.
inline constexpr std::uint64_t kMaxRecordedTicks = 4ULL * 3600 * 1000;

/// Ticks in which the input did not change.
struct InputRun {
  Input input;
  std::uint32_t ticks = 0;
  bool operator==(const InputRun&) const = default;
};

/// One exercise.
struct Recording {
  std::string program_version;
  std::uint64_t case_fingerprint = 0;
  procedure::ProcedureId procedure = procedure::ProcedureId::DorsalScaphoidFixation;
  std::uint64_t seed = 0;
  std::vector<InputRun> runs;
  std::uint64_t end_hash = 0;  ///< Snapshot::state_hash after the last tick

  [[nodiscard]] std::uint64_t tick_count() const noexcept;
  bool operator==(const Recording&) const = default;
};

/// Collects inputs as they are stepped. `append` may allocate: keep it off the 1 kHz thread, or
/// `reserve` first (a moving hand needs one run a tick).
class Recorder {
 public:
  Recorder(std::string program_version,
           std::uint64_t case_fingerprint,
           procedure::ProcedureId procedure,
           std::uint64_t seed);
  void reserve(std::size_t runs) { recording_.runs.reserve(runs); }
  void append(const Input& input);
  /// The recording with its end hash.
  [[nodiscard]] Recording finished(std::uint64_t end_hash) const;

 private:
  Recording recording_;
};

/// What identifies a posed case to a recording: CT, surfaces, poses,
/// fields, wrist frame and landmarks, to the bit.
[[nodiscard]] std::uint64_t fingerprint_of(const cases::CaseData& posed_case);

[[nodiscard]] std::vector<std::byte> encode(const Recording& recording);

/// Decodes untrusted bytes; never reads beyond them. Memory grows with the bytes that are there (at
/// most some 25 for one), never with what they claim.
[[nodiscard]] Result<Recording> decode(std::span<const std::byte> bytes);

/// Outcome of a replay.
struct Replay {
  Snapshot last;                      ///< state after the last tick
  bool hash_matches = false;          ///< last.state_hash equals the recording's end hash
  bool case_matches = false;          ///< the case is the one that was recorded on
  procedure::OperationRecord record;  ///< for the score
};

/// Steps a new world through the recording, as fast as it can.
[[nodiscard]] Replay replay(const cases::CaseData& posed_case, const Recording& recording);

/// The same, and the score.
[[nodiscard]] procedure::ScoreReport score_recording(const cases::CaseData& posed_case,
                                                     const Recording& recording);

}  // namespace carpus::simulation
