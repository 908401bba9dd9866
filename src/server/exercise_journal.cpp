// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/exercise_journal.hpp"

#include <string_view>
#include <utility>

namespace carpus::server {

namespace {

using Bytes = std::span<const std::byte>;

/// What a block holds. Numbers are of the file: never used twice.
enum class Kind : std::uint8_t {
  Head = 1,       ///< stored_exercise
  Part = 2,       ///< u64 tick and u64 state hash at its end, u32 size and bytes of runs, events
  Keyframe = 3,   ///< u64 tick, World::write_state
  Owner = 4,      ///< text
  Recording = 5,  ///< simulation::encode of it before the first tick
};

/// Bytes of a part before its runs.
constexpr std::size_t kPartHead = 20;

Bytes bytes_of(std::string_view text) { return std::as_bytes(std::span(text.data(), text.size())); }

std::string_view text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void put(std::vector<std::byte>& out, std::uint64_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) out.push_back(static_cast<std::byte>(value >> (8 * i)));
}

void put(std::vector<std::byte>& out, Bytes bytes) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}

std::uint64_t get(Bytes bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value |= static_cast<std::uint64_t>(bytes[at + i]) << (8 * i);
  }
  return value;
}

std::uint8_t number_of(Kind kind) { return static_cast<std::uint8_t>(kind); }

}  // namespace

ExerciseJournal::ExerciseJournal(const std::filesystem::path& file,
                                 const protocol::RunningExercise& head,
                                 const simulation::Recording& recording)
    : writer_({file, {}, 0}) {
  writer_.append(number_of(Kind::Head), bytes_of(protocol::serialize_stored_exercise(head)), 0);
  writer_.append(number_of(Kind::Recording), simulation::encode(recording), 0);
}

ExerciseJournal::ExerciseJournal(records::JournalPlace place,
                                 Tick tick,
                                 const simulation::Input& last)
    : writer_(std::move(place)), encoder_(last), tick_(tick), handed_over_(tick) {}

void ExerciseJournal::append(const simulation::Input& raw) {
  const simulation::Input input = simulation::quantised(raw);
  ++tick_;
  if (run_.ticks > 0 && run_.input == input) {
    ++run_.ticks;
    return;
  }
  if (run_.ticks > 0) encoder_.put(run_);
  run_ = {input, 1};
}

void ExerciseJournal::append(const std::vector<protocol::LoggedEvent>& events) {
  events_.insert(events_.end(), events.begin(), events.end());
}

void ExerciseJournal::append(const simulation::Keyframe& keyframe, std::uint64_t state_hash) {
  hand_over_now(state_hash);
  std::vector<std::byte> content;
  content.reserve(8 + keyframe.state.size());
  put(content, keyframe.tick, 8);
  put(content, Bytes(keyframe.state));
  writer_.append(number_of(Kind::Keyframe), content, tick_);
}

void ExerciseJournal::note_owner(const std::string& word) {
  if (word == owner_) return;
  owner_ = word;
  writer_.append(number_of(Kind::Owner), bytes_of(word), handed_over_);
}

void ExerciseJournal::hand_over(std::uint64_t state_hash) {
  const bool is_time = tick_ - handed_over_ >= kPartTicks ||
                       std::chrono::steady_clock::now() - handed_over_at_ >= kPartTime;
  if (is_time) hand_over_now(state_hash);
}

void ExerciseJournal::hand_over_now(std::uint64_t state_hash) {
  handed_over_at_ = std::chrono::steady_clock::now();
  if (tick_ == handed_over_ && events_.empty()) return;
  if (run_.ticks > 0) encoder_.put(std::exchange(run_, {}));
  const std::vector<std::byte> runs = encoder_.take();
  std::vector<std::byte> content;
  put(content, tick_, 8);
  put(content, state_hash, 8);
  put(content, runs.size(), 4);
  put(content, Bytes(runs));
  if (!events_.empty()) {
    put(content, bytes_of(protocol::serialize_stored_events(std::exchange(events_, {}))));
  }
  writer_.append(number_of(Kind::Part), content, tick_);
  handed_over_ = tick_;
}

Result<protocol::RunningExercise> read_head(const records::JournalContent& journal) {
  if (journal.blocks.empty() || journal.blocks.front().kind != number_of(Kind::Head)) {
    return Refusal{"its beginning was never written or is damaged"};
  }
  auto head = protocol::parse_stored_exercise(text_of(journal.blocks.front().content));
  if (!head) return Refusal{"its head cannot be read: " + head.error()};
  return head;
}

namespace {

/// One part's runs, and what else it says.
struct Part {
  Tick tick = 0;
  std::uint64_t state_hash = 0;
  Bytes runs;
  Bytes events;
};

Result<Part> read_part(Bytes content) {
  const Refusal cut{"a part of it is cut short"};
  if (content.size() < kPartHead) return cut;
  const auto size = static_cast<std::size_t>(get(content, 16, 4));
  if (size > content.size() - kPartHead) return cut;
  return Part{get(content, 0, 8), get(content, 8, 8), content.subspan(kPartHead, size),
              content.subspan(kPartHead + size)};
}

}  // namespace

Result<JournaledExercise> read_exercise(const records::JournalContent& journal) {
  auto head = read_head(journal);
  if (!head) return Refusal{head.error()};
  JournaledExercise exercise{std::move(head.value()), {}, {}, {}};
  if (journal.blocks.size() < 2 || journal.blocks[1].kind != number_of(Kind::Recording)) {
    return Refusal{"what it is a recording of was never written"};
  }
  auto begun = simulation::decode(journal.blocks[1].content);
  if (!begun) return Refusal{begun.error()};
  simulation::Recording& recording = exercise.recording;
  recording = std::move(begun.value());
  const auto whole_size = static_cast<std::size_t>(journal.sound_size);
  Tick tick = 0;
  for (const records::JournalBlock& block : journal.blocks) {
    const Bytes content = block.content;
    if (block.kind == number_of(Kind::Owner)) exercise.owner = text_of(content);
    if (block.kind == number_of(Kind::Keyframe) && content.size() >= 8 &&
        get(content, 0, 8) == tick &&
        (recording.keyframes.empty() || recording.keyframes.back().tick < tick)) {
      recording.keyframes.push_back({tick, {content.begin() + 8, content.end()}});
    }
    if (block.kind != number_of(Kind::Part)) continue;
    const auto part = read_part(content);
    if (!part) return Refusal{part.error()};
    tick = part->tick;
    recording.end_hash = part->state_hash;
    const auto read = recording.runs.decode(part->runs, whole_size);
    if (!read) return Refusal{read.error()};
    if (*read != part->runs.size()) return Refusal{"a part of it ends too early"};
    if (part->events.empty()) continue;
    auto log = protocol::parse_stored_events(text_of(part->events));
    if (!log) return Refusal{"its log cannot be read: " + log.error()};
    exercise.log.insert(exercise.log.end(), log->begin(), log->end());
  }
  // A part may tell of ticks whose inputs were to come with the next: they have not been.
  std::erase_if(exercise.log,
                [tick](const auto& event) { return static_cast<Tick>(event.tick) > tick; });
  if (recording.tick_count() != tick) return Refusal{"its parts do not follow each other"};
  return exercise;
}

}  // namespace carpus::server
