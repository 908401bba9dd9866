// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/recording.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>
#include <utility>

#include "core/state_hash.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {
namespace {

constexpr std::string_view kMagic = "CARPREC1";

// What of an input changed since the tick before: bits of one byte.
constexpr std::uint8_t kTipChanged = 1;
constexpr std::uint8_t kShaftChanged = 2;
constexpr std::uint8_t kThrustChanged = 4;
constexpr std::uint8_t kDriverChanged = 8;
constexpr std::uint8_t kCommandChanged = 16;
constexpr std::uint8_t kAllChanges = 31;

class Writer {
 public:
  template <typename T>
  void put(T value) {
    static_assert(std::is_unsigned_v<T>);
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes_.push_back(static_cast<std::byte>(static_cast<std::uint64_t>(value) >> (8 * i)));
    }
  }
  void put(double value) { put(std::bit_cast<std::uint64_t>(value)); }
  void put(const Vec3& v) {
    put(v.x);
    put(v.y);
    put(v.z);
  }
  void put(std::string_view text) {
    for (const char c : text) bytes_.push_back(static_cast<std::byte>(c));
  }
  [[nodiscard]] std::vector<std::byte>& bytes() { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

/// Reads forward; the first read beyond the end spoils it, and every later one.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <typename T>
  T get() {
    std::uint64_t value = 0;
    if (!take(sizeof(T))) return T{};
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      value |= static_cast<std::uint64_t>(bytes_[at_ - sizeof(T) + i]) << (8 * i);
    }
    return static_cast<T>(value);
  }
  double get_double() { return std::bit_cast<double>(get<std::uint64_t>()); }
  Vec3 get_vec3() {
    const double x = get_double();
    const double y = get_double();
    return {x, y, get_double()};
  }
  std::string get_text(std::size_t size) {
    if (!take(size)) return {};
    std::string text(size, '\0');
    if (size > 0) std::memcpy(text.data(), bytes_.data() + at_ - size, size);
    return text;
  }
  [[nodiscard]] bool is_spoilt() const { return spoilt_; }
  [[nodiscard]] std::size_t at() const { return at_; }

 private:
  bool take(std::size_t size) {
    if (spoilt_ || bytes_.size() - at_ < size) {
      spoilt_ = true;
      return false;
    }
    at_ += size;
    return true;
  }
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  bool spoilt_ = false;
};

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same_bits(const Vec3& a, const Vec3& b) {
  return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}
bool same_bits(const Command& a, const Command& b) {
  return a.kind == b.kind && a.index == b.index && same_bits(a.rotation_deg, b.rotation_deg) &&
         same_bits(a.tilt_deg, b.tilt_deg);
}

/// Which fields differ, to the bit: NaN equals itself and -0 differs from 0, as replay must see
/// them.
std::uint8_t changes(const Input& a, const Input& b) {
  unsigned mask = 0;
  if (!same_bits(a.tip_in_patient, b.tip_in_patient)) mask |= kTipChanged;
  if (!same_bits(a.shaft_in_patient, b.shaft_in_patient)) mask |= kShaftChanged;
  if (!same_bits(a.thrust_n, b.thrust_n)) mask |= kThrustChanged;
  if (a.driver != b.driver) mask |= kDriverChanged;
  if (!same_bits(a.command, b.command)) mask |= kCommandChanged;
  return static_cast<std::uint8_t>(mask);
}

void put_run(Writer& out, const InputRun& run, const Input& previous) {
  const std::uint8_t mask = changes(run.input, previous);
  out.put(run.ticks);
  out.put(mask);
  if ((mask & kTipChanged) != 0) out.put(run.input.tip_in_patient);
  if ((mask & kShaftChanged) != 0) out.put(run.input.shaft_in_patient);
  if ((mask & kThrustChanged) != 0) out.put(run.input.thrust_n);
  if ((mask & kDriverChanged) != 0) out.put(static_cast<std::uint8_t>(run.input.driver));
  if ((mask & kCommandChanged) != 0) {
    const Command& command = run.input.command;
    out.put(static_cast<std::uint8_t>(command.kind));
    out.put(static_cast<std::uint32_t>(command.index));
    out.put(command.rotation_deg);
    out.put(command.tilt_deg);
  }
}

/// Reads what changed into `input`; false when a value names nothing.
bool get_changes(Reader& in, std::uint8_t mask, Input& input) {
  if ((mask & kTipChanged) != 0) input.tip_in_patient = in.get_vec3();
  if ((mask & kShaftChanged) != 0) input.shaft_in_patient = in.get_vec3();
  if ((mask & kThrustChanged) != 0) input.thrust_n = in.get_double();
  if ((mask & kDriverChanged) != 0) {
    const auto driver = in.get<std::uint8_t>();
    if (driver > static_cast<std::uint8_t>(Driver::Reverse)) return false;
    input.driver = static_cast<Driver>(driver);
  }
  if ((mask & kCommandChanged) != 0) {
    const auto kind = in.get<std::uint8_t>();
    if (kind > static_cast<std::uint8_t>(CommandKind::Finish)) return false;
    input.command.kind = static_cast<CommandKind>(kind);
    input.command.index = static_cast<std::int32_t>(in.get<std::uint32_t>());
    input.command.rotation_deg = in.get_double();
    input.command.tilt_deg = in.get_double();
  }
  return true;
}

std::uint64_t checksum_of(std::span<const std::byte> bytes) {
  StateHash hash;
  hash.add_bytes(bytes);
  return hash.value();
}

/// Reads the runs up to their end mark; the reason for refusing, or empty.
std::string get_runs(Reader& in, std::vector<InputRun>& runs) {
  Input input;
  std::uint64_t ticks = 0;
  while (true) {
    const auto count = in.get<std::uint32_t>();
    if (in.is_spoilt()) return "recording: cut off among the inputs";
    if (count == 0) return {};
    const auto mask = in.get<std::uint8_t>();
    if ((mask & ~unsigned{kAllChanges}) != 0 || !get_changes(in, mask, input)) {
      return "recording: an input names a driver, command or field that does not exist";
    }
    if (in.is_spoilt()) return "recording: cut off among the inputs";
    ticks += count;
    if (ticks > kMaxRecordedTicks) return "recording: longer than 4 hours";
    runs.push_back({input, count});
  }
}

void add_vector(StateHash& hash, const Vec3& v) {
  for (std::size_t i = 0; i < 3; ++i) hash.add(v[i]);
}

void add_grid_geometry(StateHash& hash, const GridGeometry& geometry) {
  for (const int n : geometry.size) hash.add(static_cast<std::uint64_t>(n));
  for (std::size_t i = 0; i < 3; ++i) {
    hash.add(geometry.spacing[i]);
    hash.add(geometry.origin[i]);
    for (std::size_t j = 0; j < 3; ++j) hash.add(geometry.direction.rows[i][j]);
  }
}

/// Four voxels at a time: a CT has tens of millions of bytes.
template <typename T, typename Convert>
void add_values(StateHash& hash, std::span<const T> values, Convert convert) {
  constexpr std::size_t kPacked = 8 / sizeof(T);
  for (std::size_t i = 0; i < values.size(); i += kPacked) {
    std::uint64_t word = 0;
    for (std::size_t j = i; j < std::min(i + kPacked, values.size()); ++j) {
      word = (word << (8 * sizeof(T) % 64)) ^ convert(values[j]);
    }
    hash.add(word);
  }
}

}  // namespace

std::uint64_t Recording::tick_count() const noexcept {
  std::uint64_t ticks = 0;
  for (const InputRun& run : runs) ticks += run.ticks;
  return ticks;
}

Recorder::Recorder(std::string program_version,
                   std::uint64_t case_fingerprint,
                   procedure::ProcedureId procedure,
                   std::uint64_t seed) {
  recording_.program_version = std::move(program_version);
  recording_.case_fingerprint = case_fingerprint;
  recording_.procedure = procedure;
  recording_.seed = seed;
}

void Recorder::append(const Input& input) {
  if (!recording_.runs.empty() && changes(recording_.runs.back().input, input) == 0 &&
      recording_.runs.back().ticks < UINT32_MAX) {
    ++recording_.runs.back().ticks;
  } else {
    recording_.runs.push_back({input, 1});
  }
}

Recording Recorder::finished(std::uint64_t end_hash) const {
  Recording recording = recording_;
  recording.end_hash = end_hash;
  return recording;
}

std::uint64_t fingerprint_of(const cases::CaseData& posed_case) {
  StateHash hash;
  hash.add(static_cast<std::uint64_t>(posed_case.side));
  add_grid_geometry(hash, posed_case.ct.geometry());
  add_values(hash, posed_case.ct.values(),
             [](std::int16_t v) { return std::uint64_t{static_cast<std::uint16_t>(v)}; });
  for (const cases::Bone& bone : posed_case.bones) {
    hash.add(static_cast<std::uint64_t>(bone.label));
    for (const Vec3& v : bone.surface.vertices) add_vector(hash, v);
    add_vector(hash, bone.patient_from_bone.translation);
    for (const Vec3& row : bone.patient_from_bone.rotation.rows) add_vector(hash, row);
    add_grid_geometry(hash, bone.distance_field.geometry());
    add_values(hash, bone.distance_field.values(),
               [](float v) { return std::uint64_t{std::bit_cast<std::uint32_t>(v)}; });
  }
  add_vector(hash, posed_case.wrist_from_patient.translation);
  for (const Vec3& row : posed_case.wrist_from_patient.rotation.rows) add_vector(hash, row);
  const cases::ScaphoidLandmarks& scaphoid = posed_case.scaphoid;
  for (const Vec3& end :
       {scaphoid.central_axis.proximal, scaphoid.central_axis.distal,
        scaphoid.longest_line.proximal, scaphoid.longest_line.distal, scaphoid.waist}) {
    add_vector(hash, end);
  }
  hash.add(scaphoid.central_radius_mm);
  return hash.value();
}

std::vector<std::byte> encode(const Recording& recording) {
  Writer out;
  out.put(kMagic);
  out.put(kRecordingFormat);
  const std::string_view version = std::string_view(recording.program_version).substr(0, UINT8_MAX);
  out.put(static_cast<std::uint8_t>(version.size()));
  out.put(version);
  out.put(recording.case_fingerprint);
  out.put(static_cast<std::uint8_t>(recording.procedure));
  out.put(recording.seed);
  Input previous;
  for (const InputRun& run : recording.runs) {
    put_run(out, run, previous);
    previous = run.input;
  }
  out.put(std::uint32_t{0});
  out.put(recording.tick_count());
  out.put(recording.end_hash);
  out.put(checksum_of(out.bytes()));
  return std::move(out.bytes());
}

Result<Recording> decode(std::span<const std::byte> bytes) {
  Reader in(bytes);
  if (in.get_text(kMagic.size()) != kMagic) {
    return Refusal{"recording: this is no Carpus recording"};
  }
  const auto format = in.get<std::uint16_t>();
  if (in.is_spoilt()) return Refusal{"recording: cut off in the header"};
  if (format != kRecordingFormat) {
    return Refusal{"recording: format " + std::to_string(format) + ", this program reads " +
                   std::to_string(kRecordingFormat) + "; use the program that recorded it"};
  }
  Recording recording;
  recording.program_version = in.get_text(in.get<std::uint8_t>());
  recording.case_fingerprint = in.get<std::uint64_t>();
  const auto procedure = in.get<std::uint8_t>();
  recording.seed = in.get<std::uint64_t>();
  if (in.is_spoilt()) return Refusal{"recording: cut off in the header"};
  if (procedure != static_cast<std::uint8_t>(procedure::ProcedureId::DorsalScaphoidFixation)) {
    return Refusal{"recording: of a procedure that this program does not know"};
  }
  if (std::string reason = get_runs(in, recording.runs); !reason.empty()) {
    return Refusal{std::move(reason)};
  }
  const auto ticks = in.get<std::uint64_t>();
  recording.end_hash = in.get<std::uint64_t>();
  const std::size_t checked = in.at();
  const auto checksum = in.get<std::uint64_t>();
  if (in.is_spoilt()) return Refusal{"recording: cut off at the end"};
  if (in.at() != bytes.size()) return Refusal{"recording: bytes after its end"};
  if (ticks != recording.tick_count() || checksum != checksum_of(bytes.first(checked))) {
    return Refusal{"recording: damaged, its checksum does not match"};
  }
  return recording;
}

Replay replay(const cases::CaseData& posed_case, const Recording& recording) {
  World world(posed_case, recording.procedure, recording.seed);
  for (const InputRun& run : recording.runs) {
    for (std::uint32_t i = 0; i < run.ticks; ++i) world.step(run.input);
  }
  Replay result;
  result.last = world.now();
  result.hash_matches = result.last.state_hash == recording.end_hash;
  result.case_matches = fingerprint_of(posed_case) == recording.case_fingerprint;
  result.record = world.operation_record();
  return result;
}

procedure::ScoreReport score_recording(const cases::CaseData& posed_case,
                                       const Recording& recording) {
  return procedure::score_operation(posed_case, replay(posed_case, recording).record);
}

}  // namespace carpus::simulation
