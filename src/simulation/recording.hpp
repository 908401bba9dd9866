// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A recording: every tick's input, from which the whole operation can be replayed to the same
// bytes, and keyframes, from which any moment is reached.
//
// Layout, all little-endian: "CARPREC1"; u16 format version; text program version; u64 case
// fingerprint; text procedure; u8 way to operate; u64 seed; u16 count and texts: the ids of the
// instruments that commands name by number; of an examination that names what is wrong (format 7
// instead of 6) u64 seed, u8 whether drawn by it, u8 count and as often two texts: finding,
// grade; then runs (input_runs.hpp); u32 0; u64 ticks in all; u64 hash at the end; u32 keyframes,
// each u64 tick, u32 size, its bytes; u64 FNV-1a of all bytes before it. A text is u16 size and
// UTF-8. A still hand costs nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cases/case_data.hpp"
#include "core/result.hpp"
#include "procedure/procedure.hpp"
#include "procedure/score.hpp"
#include "simulation/input.hpp"
#include "simulation/input_runs.hpp"
#include "simulation/snapshot.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {

/// Recordings of older formats show their stored score only; decode() says why of each.
inline constexpr std::uint16_t kRecordingFormat = 6;
/// Of a wrist whose pathology it holds: every examination's that begins now. All others keep the
/// format that older programs read.
inline constexpr std::uint16_t kPreparedRecordingFormat = 7;

/// A keyframe stands this often.
inline constexpr Tick kKeyframeTicks = 10'000;

/// A world's state after a tick: World::write_state.
struct Keyframe {
  Tick tick = 0;
  std::vector<std::byte> state;
  bool operator==(const Keyframe&) const = default;
};

/// One exercise.
struct Recording {
  std::string program_version;
  std::uint64_t case_fingerprint = 0;
  std::string procedure;
  procedure::Mode mode = procedure::Mode::Practice;
  std::uint64_t seed = 0;
  std::vector<std::string> instruments;  ///< ids by number
  /// What was wrong in a wrist that was examined: the case's may have been changed since. None of
  /// an older one that had nothing prepared: its seed says.
  std::optional<cases::PreparedPathology> prepared;
  InputRuns runs;
  std::vector<Keyframe> keyframes;  ///< rising ticks
  std::uint64_t end_hash = 0;       ///< Snapshot::state_hash after the last tick

  [[nodiscard]] std::uint64_t tick_count() const noexcept { return runs.tick_count(); }
  bool operator==(const Recording&) const = default;
};

/// Collects inputs as they are stepped. `append` allocates now and then: keep it off the 1 kHz
/// thread.
class Recorder {
 public:
  Recorder(std::string program_version,
           std::uint64_t case_fingerprint,
           const procedure::Procedure& procedure,
           std::uint64_t seed,
           procedure::Mode mode = procedure::Mode::Practice);
  /// Of that world, before its first tick.
  Recorder(std::string program_version, std::uint64_t case_fingerprint, const World& world);
  /// Goes on with what was recorded before.
  explicit Recorder(Recording begun) : recording_(std::move(begun)) {}
  /// Takes the input as the world does, quantised.
  void append(const Input& input) { recording_.runs.push_back({input, 1}); }
  /// Of the world after the last input that was appended.
  void append_keyframe(Keyframe keyframe);
  [[nodiscard]] Tick tick() const noexcept { return recording_.tick_count(); }
  /// The recording with its end hash.
  [[nodiscard]] Recording finished(std::uint64_t end_hash) const&;
  [[nodiscard]] Recording finished(std::uint64_t end_hash) &&;

 private:
  Recording recording_;
};

/// What identifies a case to a recording: CT, surfaces, fields, hand motion, wrist frame and
/// landmarks, to the bit. Not the pathology that it has prepared: that is in the recording.
[[nodiscard]] std::uint64_t fingerprint_of(const cases::CaseData& data);

[[nodiscard]] std::vector<std::byte> encode(const Recording& recording);

/// Decodes untrusted bytes; never reads beyond them. Memory grows with the bytes that are there
/// (about as many again), never with what they claim. Refuses by name: another format, instruments
/// that this program does not have.
[[nodiscard]] Result<Recording> decode(std::span<const std::byte> bytes);

/// Outcome of a replay.
struct Replay {
  Snapshot last;                      ///< state after the last tick
  bool hash_matches = false;          ///< last.state_hash equals the recording's end hash
  bool case_matches = false;          ///< the case is the one that was recorded on
  procedure::OperationRecord record;  ///< for the score
};

/// Steps a new world through the recording, as fast as it can.
/// @param procedure  the one that the recording names.
/// @param see        is called after each tick.
[[nodiscard]] Replay replay(const cases::CaseData& data,
                            const procedure::Procedure& procedure,
                            const Recording& recording,
                            const std::function<void(const Snapshot&)>& see = {});

/// The same, and the score.
[[nodiscard]] procedure::ScoreReport score_recording(const cases::CaseData& data,
                                                     const procedure::Procedure& procedure,
                                                     const Recording& recording);

/// Brings a world to the state after `tick` (at most the last one): from the nearest keyframe
/// before it, or from the beginning. Refuses a keyframe that does not fit. A keyframe does not know
/// what undo would go back to: where one after it goes back beyond it, the state is another, which
/// its hash tells.
/// @param most_keyframes  only the first so many are used.
[[nodiscard]] Result<bool> seek(World& world,
                                const Recording& recording,
                                Tick tick,
                                std::size_t most_keyframes = SIZE_MAX);

}  // namespace carpus::simulation
