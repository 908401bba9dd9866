// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A recording: every tick's input, from which the whole operation can be replayed to the same
// bytes, and keyframes, from which any moment is reached.
//
// Layout, all little-endian: "CARPREC1"; u16 format version; text program version; u64 case
// fingerprint; text procedure; u64 seed; u16 count and texts: the ids of the instruments that
// commands name by number; then runs: u32 ticks (not 0), u16 mask of what changed, the changed
// fields as signed differences in the units of quantisation.hpp, seven bits a byte; u32 0; u64
// ticks in all; u64 hash at the end; u32 keyframes, each u64 tick, u32 size, its bytes; u64 FNV-1a
// of all bytes before it. A text is u16 size and UTF-8. A still hand costs nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "core/result.hpp"
#include "procedure/procedure.hpp"
#include "procedure/score.hpp"
#include "simulation/input.hpp"
#include "simulation/snapshot.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {

/// 1 was of a world of one wire, 2 of a C-arm without a pedal, 3 of one way to operate; such
/// recordings show their stored score only.
inline constexpr std::uint16_t kRecordingFormat = 5;

/// Longest exercise that is recorded: 4 hours. Bounds what decoding untrusted bytes may allocate.
inline constexpr std::uint64_t kMaxRecordedTicks = 4ULL * 3600 * 1000;

/// What decoding believes: so much stillness for nothing, and so many ticks for each byte. A
/// keyframe every ten seconds weighs far more; a few bytes that claim hours are refused by name.
inline constexpr std::uint64_t kTicksForNothing = 120'000;
inline constexpr std::uint64_t kTicksForAByte = 100;

/// A keyframe stands this often.
inline constexpr Tick kKeyframeTicks = 10'000;

/// Ticks in which the input did not change.
struct InputRun {
  Input input;
  std::uint32_t ticks = 0;
  bool operator==(const InputRun&) const = default;
};

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
  std::vector<InputRun> runs;
  std::vector<Keyframe> keyframes;  ///< rising ticks
  std::uint64_t end_hash = 0;       ///< Snapshot::state_hash after the last tick

  [[nodiscard]] std::uint64_t tick_count() const noexcept;
  bool operator==(const Recording&) const = default;
};

/// Collects inputs as they are stepped. `append` may allocate: keep it off the 1 kHz thread, or
/// `reserve` first (a moving hand needs one run a tick).
class Recorder {
 public:
  Recorder(std::string program_version,
           std::uint64_t case_fingerprint,
           const procedure::Procedure& procedure,
           std::uint64_t seed,
           procedure::Mode mode = procedure::Mode::Practice);
  /// Goes on with what was recorded before.
  explicit Recorder(Recording begun);
  void reserve(std::size_t runs) { recording_.runs.reserve(runs); }
  /// Takes the input as the world does, quantised.
  void append(const Input& input);
  /// Of the world after the last input that was appended.
  void append_keyframe(Keyframe keyframe);
  [[nodiscard]] Tick tick() const noexcept { return tick_; }
  /// The recording with its end hash.
  [[nodiscard]] Recording finished(std::uint64_t end_hash) const;

 private:
  Recording recording_;
  Tick tick_ = 0;
};

/// What identifies a case to a recording: CT, surfaces, fields, hand motion, wrist frame and
/// landmarks, to the bit.
[[nodiscard]] std::uint64_t fingerprint_of(const cases::CaseData& data);

/// Runs to bytes as a recording holds them, a part at a time: each as what changed since the one
/// before. The parts put together are a recording's runs without their end.
class RunEncoder {
 public:
  /// @param before  the input that the next run is compared with.
  explicit RunEncoder(const Input& before = {}) : before_(before) {}
  void put(const InputRun& run);
  /// What was put since the last call.
  [[nodiscard]] std::vector<std::byte> take();

 private:
  Input before_;
  std::vector<std::byte> bytes_;
};

/// The runs of an encoder's parts, untrusted; refuses by name as `decode` does. A run that the end
/// of a part had cut is one again.
/// @param whole_size  of the file that they are of: with its keyframes it vouches for their length.
[[nodiscard]] Result<std::vector<InputRun>> decode_runs(std::span<const std::byte> bytes,
                                                        std::size_t whole_size);

[[nodiscard]] std::vector<std::byte> encode(const Recording& recording);

/// Decodes untrusted bytes; never reads beyond them. Memory grows with the bytes that are there (at
/// most some 60 for one), never with what they claim. Refuses by name: another format, instruments
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
[[nodiscard]] Replay replay(const cases::CaseData& data,
                            const procedure::Procedure& procedure,
                            const Recording& recording);

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
