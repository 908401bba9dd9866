// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/recording.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/state_hash.hpp"
#include "simulation/detail/bytes.hpp"
#include "simulation/quantisation.hpp"

namespace carpus::simulation {
namespace {

using detail::Reader;
using detail::Writer;

constexpr std::string_view kMagic = "CARPREC1";
constexpr std::size_t kMostInstruments = 255;
constexpr std::size_t kMostKeyframes = kMaxRecordedTicks / 1000;

/// Bits of the mask of what changed: five a hand, then wrist, C-arm and command.
constexpr unsigned kBitsPerHand = 5;
constexpr unsigned kWristBit = kBitsPerHand * kHands;
constexpr unsigned kCArmBit = kWristBit + 1;
constexpr unsigned kCommandBit = kCArmBit + 1;
constexpr unsigned kAllBits = (1U << (kCommandBit + 1)) - 1;

/// An input as whole numbers: what is written, and what differs.
struct InputUnits {
  struct Hand {
    std::array<std::int64_t, 3> tip{};
    std::array<std::int64_t, 3> shaft{};
    std::int64_t thrust = 0;
    std::uint8_t driver = 0;
    std::uint8_t guidance = 0;
    bool operator==(const Hand&) const = default;
  };
  struct What {
    std::uint8_t kind = 0;
    std::uint8_t hand = 0;
    std::uint8_t index = 0;
    std::int64_t rotation = 0;
    std::int64_t tilt = 0;
    bool operator==(const What&) const = default;
  };
  std::array<Hand, kHands> hands;
  struct CArm {
    std::array<std::int64_t, 2> stand{};
    std::uint8_t pedal = 0;
    bool operator==(const CArm&) const = default;
  };
  std::array<std::int64_t, 4> wrist{};
  CArm c_arm;
  What command;
  bool operator==(const InputUnits&) const = default;
};

double from_units(std::int64_t units, double unit) { return static_cast<double>(units) * unit; }

InputUnits in_units(const Input& input) {
  InputUnits units;
  for (std::size_t h = 0; h < kHands; ++h) {
    const HandInput& hand = input.hands[h];
    InputUnits::Hand& out = units.hands[h];
    for (std::size_t i = 0; i < 3; ++i) {
      out.tip[i] = units_of(hand.tip_in_patient[i], kPositionUnitMm);
      out.shaft[i] = units_of(hand.shaft_in_patient[i], kDirectionUnit);
    }
    out.thrust = units_of(hand.thrust_n, kForceUnitN);
    out.driver = static_cast<std::uint8_t>(hand.driver);
    out.guidance = static_cast<std::uint8_t>(hand.guidance);
  }
  units.wrist = {units_of(input.wrist.flexion_rad, kAngleUnitRad),
                 units_of(input.wrist.radial_deviation_rad, kAngleUnitRad),
                 units_of(input.wrist.pronation_rad, kAngleUnitRad),
                 units_of(input.wrist.traction_n, kForceUnitN)};
  units.c_arm = {{units_of(input.c_arm.rotation_deg, kViewUnitDeg),
                  units_of(input.c_arm.tilt_deg, kViewUnitDeg)},
                 static_cast<std::uint8_t>(input.c_arm.pedal_is_down)};
  const Command& command = input.command;
  units.command = {static_cast<std::uint8_t>(command.kind), command.hand, command.index,
                   units_of(command.rotation_deg, kViewUnitDeg),
                   units_of(command.tilt_deg, kViewUnitDeg)};
  return units;
}

Input input_of(const InputUnits& units) {
  Input input;
  for (std::size_t h = 0; h < kHands; ++h) {
    const InputUnits::Hand& hand = units.hands[h];
    HandInput& out = input.hands[h];
    for (std::size_t i = 0; i < 3; ++i) {
      out.tip_in_patient[i] = from_units(hand.tip[i], kPositionUnitMm);
      out.shaft_in_patient[i] = from_units(hand.shaft[i], kDirectionUnit);
    }
    out.thrust_n = from_units(hand.thrust, kForceUnitN);
    out.driver = static_cast<Driver>(hand.driver);
    out.guidance = static_cast<Guidance>(hand.guidance);
  }
  input.wrist = {
      from_units(units.wrist[0], kAngleUnitRad), from_units(units.wrist[1], kAngleUnitRad),
      from_units(units.wrist[2], kAngleUnitRad), from_units(units.wrist[3], kForceUnitN)};
  input.c_arm = {from_units(units.c_arm.stand[0], kViewUnitDeg),
                 from_units(units.c_arm.stand[1], kViewUnitDeg), units.c_arm.pedal != 0};
  const InputUnits::What& command = units.command;
  input.command = {static_cast<CommandKind>(command.kind), command.hand, command.index,
                   from_units(command.rotation, kViewUnitDeg),
                   from_units(command.tilt, kViewUnitDeg)};
  return input;
}

unsigned changes(const InputUnits& a, const InputUnits& b) {
  unsigned mask = 0;
  for (unsigned h = 0; h < kHands; ++h) {
    const unsigned first = h * kBitsPerHand;
    if (a.hands[h].tip != b.hands[h].tip) mask |= 1U << first;
    if (a.hands[h].shaft != b.hands[h].shaft) mask |= 1U << (first + 1);
    if (a.hands[h].thrust != b.hands[h].thrust) mask |= 1U << (first + 2);
    if (a.hands[h].driver != b.hands[h].driver) mask |= 1U << (first + 3);
    if (a.hands[h].guidance != b.hands[h].guidance) mask |= 1U << (first + 4);
  }
  if (a.wrist != b.wrist) mask |= 1U << kWristBit;
  if (a.c_arm != b.c_arm) mask |= 1U << kCArmBit;
  if (a.command != b.command) mask |= 1U << kCommandBit;
  return mask;
}

template <std::size_t Count>
void put_differences(Writer& out,
                     const std::array<std::int64_t, Count>& now,
                     const std::array<std::int64_t, Count>& before) {
  for (std::size_t i = 0; i < Count; ++i) out.put_signed(now[i] - before[i]);
}

template <std::size_t Count>
void add_differences(Reader& in, std::array<std::int64_t, Count>& values) {
  // As unsigned: a hostile difference may wrap, never overflow.
  for (std::int64_t& value : values) {
    value = static_cast<std::int64_t>(static_cast<std::uint64_t>(value) +
                                      static_cast<std::uint64_t>(in.get_signed()));
  }
}

void put_run(Writer& out, const InputRun& run, const InputUnits& before, InputUnits& now) {
  now = in_units(run.input);
  const unsigned mask = changes(now, before);
  out.put(run.ticks, 4);
  out.put(mask, 2);
  for (unsigned h = 0; h < kHands; ++h) {
    const unsigned bits = mask >> (h * kBitsPerHand);
    const InputUnits::Hand& hand = now.hands[h];
    if ((bits & 1U) != 0) put_differences(out, hand.tip, before.hands[h].tip);
    if ((bits & 2U) != 0) put_differences(out, hand.shaft, before.hands[h].shaft);
    if ((bits & 4U) != 0) out.put_signed(hand.thrust - before.hands[h].thrust);
    if ((bits & 8U) != 0) out.put(hand.driver, 1);
    if ((bits & 16U) != 0) out.put(hand.guidance, 1);
  }
  if ((mask >> kWristBit & 1U) != 0) put_differences(out, now.wrist, before.wrist);
  if ((mask >> kCArmBit & 1U) != 0) {
    put_differences(out, now.c_arm.stand, before.c_arm.stand);
    out.put(now.c_arm.pedal, 1);
  }
  if ((mask >> kCommandBit & 1U) != 0) {
    out.put(now.command.kind, 1);
    out.put(now.command.hand, 1);
    out.put(now.command.index, 1);
    out.put_signed(now.command.rotation);
    out.put_signed(now.command.tilt);
  }
}

/// Reads what changed into `units`; false when a value names nothing.
bool get_changes(Reader& in, unsigned mask, InputUnits& units) {
  bool is_sound = true;
  for (unsigned h = 0; h < kHands; ++h) {
    const unsigned bits = mask >> (h * kBitsPerHand);
    InputUnits::Hand& hand = units.hands[h];
    if ((bits & 1U) != 0) add_differences(in, hand.tip);
    if ((bits & 2U) != 0) add_differences(in, hand.shaft);
    if ((bits & 4U) != 0) {
      std::array<std::int64_t, 1> thrust{hand.thrust};
      add_differences(in, thrust);
      hand.thrust = thrust[0];
    }
    if ((bits & 8U) != 0) hand.driver = static_cast<std::uint8_t>(in.get(1));
    if ((bits & 16U) != 0) hand.guidance = static_cast<std::uint8_t>(in.get(1));
    is_sound = is_sound && hand.driver <= static_cast<std::uint8_t>(Driver::Reverse) &&
               hand.guidance <= static_cast<std::uint8_t>(Guidance::Planned);
  }
  if ((mask >> kWristBit & 1U) != 0) add_differences(in, units.wrist);
  if ((mask >> kCArmBit & 1U) != 0) {
    add_differences(in, units.c_arm.stand);
    units.c_arm.pedal = static_cast<std::uint8_t>(in.get(1));
    is_sound = is_sound && units.c_arm.pedal <= 1;
  }
  if ((mask >> kCommandBit & 1U) != 0) {
    units.command.kind = static_cast<std::uint8_t>(in.get(1));
    units.command.hand = static_cast<std::uint8_t>(in.get(1));
    units.command.index = static_cast<std::uint8_t>(in.get(1));
    units.command.rotation = in.get_signed();
    units.command.tilt = in.get_signed();
    is_sound = is_sound && units.command.kind < kCommandKinds;
  }
  return is_sound;
}

std::uint64_t checksum_of(std::span<const std::byte> bytes) {
  StateHash hash;
  hash.add_bytes(bytes);
  return hash.value();
}

/// The most ticks that so many bytes may hold.
std::uint64_t most_ticks(std::size_t bytes) {
  return std::min(kMaxRecordedTicks, kTicksForNothing + kTicksForAByte * bytes);
}

/// Reads the runs up to their end mark; the reason for refusing, or empty.
/// @param size  of the whole that they are part of.
/// @param joins  a run that goes on with the input of the one before is one with it.
std::string get_runs(Reader& in, std::size_t size, bool joins, std::vector<InputRun>& runs) {
  InputUnits units = in_units(Input{});
  std::uint64_t ticks = 0;
  while (true) {
    const auto count = static_cast<std::uint32_t>(in.get(4));
    if (in.is_spoilt()) return "recording: cut off among the inputs";
    if (count == 0) return {};
    const auto mask = static_cast<unsigned>(in.get(2));
    if ((mask & ~kAllBits) != 0 || !get_changes(in, mask, units)) {
      return "recording: an input names a driver, command or field that does not exist";
    }
    if (in.is_spoilt()) return "recording: cut off among the inputs";
    ticks += count;
    if (ticks > kMaxRecordedTicks) return "recording: longer than 4 hours";
    if (ticks > most_ticks(size)) {
      return "recording: " + std::to_string(size) + " bytes that claim " +
             std::to_string(ticks / 1000) + " s or more; an exercise of that length takes more";
    }
    const Input input = input_of(units);
    if (joins && mask == 0 && !runs.empty() && runs.back().ticks <= UINT32_MAX - count) {
      runs.back().ticks += count;
    } else {
      runs.push_back({input, count});
    }
  }
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

}  // namespace

std::uint64_t Recording::tick_count() const noexcept {
  std::uint64_t ticks = 0;
  for (const InputRun& run : runs) ticks += run.ticks;
  return ticks;
}

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

Recorder::Recorder(Recording begun)
    : recording_(std::move(begun)), tick_(recording_.tick_count()) {}

void Recorder::append(const Input& raw) {
  // What comes back from the file is what the world was given, to the bit.
  const Input input = input_of(in_units(raw));
  ++tick_;
  if (!recording_.runs.empty() && recording_.runs.back().input == input &&
      recording_.runs.back().ticks < UINT32_MAX) {
    ++recording_.runs.back().ticks;
  } else {
    recording_.runs.push_back({input, 1});
  }
}

void Recorder::append_keyframe(Keyframe keyframe) {
  recording_.keyframes.push_back(std::move(keyframe));
}

Recording Recorder::finished(std::uint64_t end_hash) const {
  Recording recording = recording_;
  recording.end_hash = end_hash;
  return recording;
}

void RunEncoder::put(const InputRun& run) {
  Writer out;
  InputUnits now;
  put_run(out, run, in_units(before_), now);
  bytes_.insert(bytes_.end(), out.bytes().begin(), out.bytes().end());
  before_ = run.input;
}

std::vector<std::byte> RunEncoder::take() { return std::exchange(bytes_, {}); }

Result<std::vector<InputRun>> decode_runs(std::span<const std::byte> bytes,
                                          std::size_t whole_size) {
  std::vector<std::byte> ended(bytes.begin(), bytes.end());
  ended.insert(ended.end(), 4, std::byte{0});
  Reader in(ended);
  std::vector<InputRun> runs;
  std::string reason = get_runs(in, whole_size, true, runs);
  if (reason.empty() && in.at() != ended.size()) reason = "recording: inputs that end too early";
  if (!reason.empty()) return carpus::Refusal{std::move(reason)};
  return runs;
}

std::vector<std::byte> encode(const Recording& recording) {
  Writer out;
  for (const char c : kMagic) out.put(static_cast<std::uint64_t>(c), 1);
  out.put(kRecordingFormat, 2);
  out.put(recording.program_version);
  out.put(recording.case_fingerprint, 8);
  out.put(recording.procedure);
  out.put(static_cast<std::uint64_t>(recording.mode), 1);
  out.put(recording.seed, 8);
  out.put(recording.instruments.size(), 2);
  for (const std::string& id : recording.instruments) out.put(id);
  InputUnits before = in_units(Input{});
  InputUnits now;
  for (const InputRun& run : recording.runs) {
    put_run(out, run, before, now);
    before = now;
  }
  out.put(0, 4);
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
  if (format >= 1 && format <= 4) {
    return carpus::Refusal{"recording: format " + std::to_string(format) +
                           (format == 1   ? ", of a wrist that did not move"
                            : format == 2 ? ", of a C-arm without a pedal"
                            : format == 3 ? ", of a world that knew one way to operate"
                                          : ", of wires that did not bend") +
                           "; it cannot be replayed, its stored score can be shown"};
  }
  if (format != kRecordingFormat) {
    return carpus::Refusal{"recording: format " + std::to_string(format) + ", this program reads " +
                           std::to_string(kRecordingFormat) + "; use the program that recorded it"};
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
  if (reason.empty()) reason = get_runs(in, bytes.size(), false, recording.runs);
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
              const Recording& recording) {
  World world(data, procedure, recording.seed, recording.mode);
  for (const InputRun& run : recording.runs) {
    for (std::uint32_t i = 0; i < run.ticks; ++i) world.step(run.input);
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
    world = World(world.case_data(), world.procedure(), recording.seed, recording.mode);
  }
  Tick begin = 0;
  for (const InputRun& run : recording.runs) {
    const Tick end = begin + run.ticks;
    for (Tick t = begin > at ? begin : at; t < end && t < tick; ++t) world.step(run.input);
    begin = end;
  }
  return true;
}

}  // namespace carpus::simulation
