// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/recording.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "arthroscopy/named_grades.hpp"
#include "core/state_hash.hpp"
#include "simulation/detail/bytes.hpp"

namespace carpus::simulation {
namespace {

using detail::Reader;
using detail::Writer;

constexpr std::string_view kMagic = "CARPREC1";
constexpr std::size_t kMostInstruments = 255;
constexpr std::size_t kMostKeyframes = kMaxRecordedTicks / 1000;
/// No ticks: the end of the runs.
constexpr std::size_t kRunsEndBytes = 4;
/// What is not runs or keyframes takes less, but for long names.
constexpr std::size_t kUsualHeadBytes = 4096;

std::uint64_t checksum_of(std::span<const std::byte> bytes) {
  StateHash hash;
  hash.add_bytes(bytes);
  return hash.value();
}

/// Reads the runs up to their end mark; the reason for refusing, or empty.
/// @param size  of the whole that they are part of.
std::string get_runs(Reader& in, std::size_t size, InputRuns& runs) {
  const auto read = runs.decode(in.rest(), size);
  if (!read) return read.error();
  (void)in.get_bytes(*read);
  (void)in.get(kRunsEndBytes);
  return in.is_spoilt() ? "recording: cut off among the inputs" : "";
}

std::string get_keyframes(Reader& in, std::vector<Keyframe>& keyframes) {
  const auto count = static_cast<std::size_t>(in.get(4));
  if (count > kMostKeyframes) return "recording: more keyframes than seconds";
  for (std::size_t i = 0; i < count; ++i) {
    const Tick tick = in.get(8);
    const auto size = static_cast<std::size_t>(in.get(4));
    const auto bytes = in.get_bytes(size);
    if (in.is_spoilt()) return "recording: cut off among the keyframes";
    if (!keyframes.empty() && tick <= keyframes.back().tick) {
      return "recording: keyframes out of order";
    }
    keyframes.push_back({tick, {bytes.begin(), bytes.end()}});
  }
  return {};
}

/// The reason for refusing, or empty. Numbers of instruments are those of this program's catalogue.
std::string get_instruments(Reader& in, std::vector<std::string>& ids) {
  const auto count = static_cast<std::size_t>(in.get(2));
  if (in.is_spoilt() || count > kMostInstruments) return "recording: cut off in the header";
  const auto catalogue = instruments::catalogue();
  for (std::size_t i = 0; i < count; ++i) {
    ids.push_back(in.get_text());
    if (in.is_spoilt()) return "recording: cut off in the header";
    if (i >= catalogue.size() || catalogue[i].id != ids.back()) {
      return "recording: its instrument '" + ids.back() +
             "' is not the one with that number here; use the program that recorded it";
    }
  }
  return {};
}

void put_prepared(Writer& out, const cases::PreparedPathology& prepared) {
  const auto named =
      arthroscopy::named_grades(prepared.grades, arthroscopy::PathologyTable::generic());
  out.put(prepared.seed, 8);
  out.put(prepared.is_drawn ? 1 : 0, 1);
  out.put(named.size(), 1);
  for (const arthroscopy::NamedGrade& each : named) {
    out.put(each.finding);
    out.put(each.grade);
  }
}

/// The reason for refusing, or empty.
std::string get_prepared(Reader& in, cases::PreparedPathology& prepared) {
  prepared.seed = in.get(8);
  const auto is_drawn = in.get(1);
  const auto count = static_cast<std::size_t>(in.get(1));
  if (is_drawn > 1 || count > cases::kMaxFindings) return "recording: unknown pathology";
  prepared.is_drawn = is_drawn == 1;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string finding = in.get_text();
    const std::string grade = in.get_text();
    if (in.is_spoilt()) return "recording: cut off in the header";
    const auto set =
        set_grade(prepared.grades, arthroscopy::PathologyTable::generic(), finding, grade);
    if (!set) return "recording: " + set.error() + "; use the program that recorded it";
  }
  return {};
}

}  // namespace

Recorder::Recorder(std::string program_version,
                   std::uint64_t case_fingerprint,
                   const procedure::Procedure& procedure,
                   std::uint64_t seed,
                   procedure::Mode mode) {
  recording_.program_version = std::move(program_version);
  recording_.case_fingerprint = case_fingerprint;
  recording_.procedure = procedure.id;
  recording_.mode = mode;
  recording_.seed = seed;
  for (const instruments::Instrument& instrument : instruments::catalogue()) {
    recording_.instruments.push_back(instrument.id);
  }
}

Recorder::Recorder(std::string program_version, std::uint64_t case_fingerprint, const World& world)
    : Recorder(std::move(program_version),
               case_fingerprint,
               world.procedure(),
               world.seed(),
               world.mode()) {
  recording_.prepared = world.prepared();
}

void Recorder::append_keyframe(Keyframe keyframe) {
  recording_.keyframes.push_back(std::move(keyframe));
}

Recording Recorder::finished(std::uint64_t end_hash) const& {
  Recording recording = recording_;
  recording.end_hash = end_hash;
  return recording;
}

Recording Recorder::finished(std::uint64_t end_hash) && {
  recording_.end_hash = end_hash;
  return std::move(recording_);
}

std::vector<std::byte> encode(const Recording& recording) {
  Writer out;
  std::size_t size = kUsualHeadBytes + recording.runs.encoded_size();
  for (const Keyframe& keyframe : recording.keyframes) size += 12 + keyframe.state.size();
  out.bytes().reserve(size);
  for (const char c : kMagic) out.put(static_cast<std::uint64_t>(c), 1);
  out.put(recording.prepared ? kPreparedRecordingFormat : kRecordingFormat, 2);
  out.put(recording.program_version);
  out.put(recording.case_fingerprint, 8);
  out.put(recording.procedure);
  out.put(static_cast<std::uint64_t>(recording.mode), 1);
  out.put(recording.seed, 8);
  out.put(recording.instruments.size(), 2);
  for (const std::string& id : recording.instruments) out.put(id);
  if (recording.prepared) put_prepared(out, *recording.prepared);
  recording.runs.encode_to(out.bytes());
  out.put(0, kRunsEndBytes);
  out.put(recording.tick_count(), 8);
  out.put(recording.end_hash, 8);
  out.put(recording.keyframes.size(), 4);
  for (const Keyframe& keyframe : recording.keyframes) {
    out.put(keyframe.tick, 8);
    out.put(keyframe.state.size(), 4);
    out.put(std::span<const std::byte>(keyframe.state));
  }
  out.put(checksum_of(out.bytes()), 8);
  return std::move(out.bytes());
}

Result<Recording> decode(std::span<const std::byte> bytes) {
  Reader in(bytes);
  for (const char c : kMagic) {
    if (in.get(1) != static_cast<std::uint64_t>(c) || in.is_spoilt()) {
      return carpus::Refusal{"recording: this is no Carpus recording"};
    }
  }
  const auto format = in.get(2);
  if (in.is_spoilt()) return carpus::Refusal{"recording: cut off in the header"};
  if (format >= 1 && format <= 5) {
    return carpus::Refusal{"recording: format " + std::to_string(format) +
                           (format == 1   ? ", of a wrist that did not move"
                            : format == 2 ? ", of a C-arm without a pedal"
                            : format == 3 ? ", of a world that knew one way to operate"
                            : format == 4 ? ", of wires that did not bend"
                                          : ", of fractures that were not judged") +
                           "; it cannot be replayed, its stored score can be shown"};
  }
  if (format != kRecordingFormat && format != kPreparedRecordingFormat) {
    return carpus::Refusal{"recording: format " + std::to_string(format) + ", this program reads " +
                           std::to_string(kRecordingFormat) + " and " +
                           std::to_string(kPreparedRecordingFormat) +
                           "; use the program that recorded it"};
  }
  Recording recording;
  recording.program_version = in.get_text();
  recording.case_fingerprint = in.get(8);
  recording.procedure = in.get_text();
  const auto mode = in.get(1);
  if (mode >= procedure::kModeCount) return carpus::Refusal{"recording: unknown way to operate"};
  recording.mode = static_cast<procedure::Mode>(mode);
  recording.seed = in.get(8);
  std::string reason = get_instruments(in, recording.instruments);
  if (reason.empty() && format == kPreparedRecordingFormat) {
    reason = get_prepared(in, recording.prepared.emplace());
  }
  if (reason.empty()) reason = get_runs(in, bytes.size(), recording.runs);
  if (!reason.empty()) return carpus::Refusal{std::move(reason)};
  const auto ticks = in.get(8);
  recording.end_hash = in.get(8);
  if (in.is_spoilt()) return carpus::Refusal{"recording: cut off at the end"};
  reason = get_keyframes(in, recording.keyframes);
  if (!reason.empty()) return carpus::Refusal{std::move(reason)};
  const std::size_t checked = in.at();
  const auto checksum = in.get(8);
  if (in.is_spoilt()) return carpus::Refusal{"recording: cut off at the end"};
  if (in.at() != bytes.size()) return carpus::Refusal{"recording: bytes after its end"};
  if (ticks != recording.tick_count() || checksum != checksum_of(bytes.first(checked))) {
    return carpus::Refusal{"recording: damaged, its checksum does not match"};
  }
  return recording;
}

Replay replay(const cases::CaseData& data,
              const procedure::Procedure& procedure,
              const Recording& recording,
              const std::function<void(const Snapshot&)>& see) {
  World world(data, procedure, recording.seed, recording.mode, recording.prepared);
  for (const InputRun& run : recording.runs) {
    for (std::uint32_t i = 0; i < run.ticks; ++i) {
      world.step(run.input);
      if (see) see(world.now());
    }
  }
  Replay result;
  result.last = world.now();
  result.hash_matches = result.last.state_hash == recording.end_hash;
  result.case_matches = fingerprint_of(data) == recording.case_fingerprint;
  result.record = world.operation_record();
  return result;
}

procedure::ScoreReport score_recording(const cases::CaseData& data,
                                       const procedure::Procedure& procedure,
                                       const Recording& recording) {
  return procedure.score(data, replay(data, procedure, recording).record);
}

Result<bool> seek(World& world, const Recording& recording, Tick tick, std::size_t most_keyframes) {
  const Keyframe* nearest = nullptr;
  for (std::size_t i = 0; i < std::min(recording.keyframes.size(), most_keyframes); ++i) {
    if (recording.keyframes[i].tick <= tick) nearest = &recording.keyframes[i];
  }
  Tick at = 0;
  if (nearest != nullptr) {
    const Result<bool> taken = world.read_state(nearest->state);
    if (!taken) return taken;
    at = nearest->tick;
    if (world.now().tick != at) {
      return carpus::Refusal{"recording: a keyframe is not of the tick that it names"};
    }
  } else {
    world = World(world.case_data(), world.procedure(), recording.seed, recording.mode,
                  recording.prepared);
  }
  for (auto run = recording.runs.at(at); run != recording.runs.end() && at < tick; ++run) {
    const Tick end = std::min<Tick>(run.begin_tick() + run->ticks, tick);
    for (; at < end; ++at) world.step(run->input);
  }
  return true;
}

}  // namespace carpus::simulation
