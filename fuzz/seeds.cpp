// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Makes the seeds of formats of our own: a case's text, recordings, keyframes and journals of a
// small operation, without the checksums that their targets put behind them. Made for each run of
// the targets, not kept, so that they are always of today's formats.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "arthroscopy/named_grades.hpp"
#include "case_io/detail/case_json.hpp"
#include "case_io/detail/hand_motion_json.hpp"
#include "case_io/detail/structures_json.hpp"
#include "case_io/dicom_segmentation.hpp"
#include "case_io/lesson_file.hpp"
#include "case_io/pathology_file.hpp"
#include "case_io/small_case_test_support.hpp"
#include "case_io/small_tissue_test_support.hpp"
#include "case_io/soft_tissue_folder.hpp"
#include "case_io/trust_file.hpp"
#include "case_io/two_bones_test_support.hpp"
#include "checksum.hpp"
#include "protocol/bodies.hpp"
#include "records/journal_block.hpp"
#include "simulation/operation_test_support.hpp"

namespace {

namespace fs = std::filesystem;
using namespace carpus;
using namespace carpus::simulation;
using test::Operator;
using Bytes = std::vector<std::byte>;

constexpr std::size_t kChecksum = 8;

void write(const fs::path& file, std::span<const std::byte> bytes) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

void write_body(const fs::path& file, const Bytes& bytes) {
  write(file, std::span(bytes).first(bytes.size() - kChecksum));
}

void put(Bytes& out, std::uint64_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) out.push_back(static_cast<std::byte>(value >> (8 * i)));
}

void put(Bytes& out, std::span<const std::byte> bytes) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}

Bytes bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

/// As the target wants it: u16 size of the state, the state, what was cut, both without checksum.
void write_keyframe(const fs::path& file, const World& world) {
  const Bytes whole = world.write_state();
  const auto body = std::span(whole).first(whole.size() - kChecksum);
  const auto cuts_end = body.size() - kChecksum;
  for (std::size_t state = 0; state <= cuts_end; ++state) {
    const Bytes cuts = fuzz::with_checksum(body.subspan(state, cuts_end - state));
    if (!std::equal(cuts.begin(), cuts.end(), body.begin() + static_cast<std::ptrdiff_t>(state))) {
      continue;
    }
    Bytes seed;
    put(seed, state, 2);
    put(seed, body.first(cuts_end));
    return write(file, seed);
  }
}

void write_keyframes(const fs::path& folder) {
  Operator op;
  write_keyframe(folder / "opening", op.world());
  op.command(test::take("probe", 1));
  op.place_on_entry({});
  write_keyframe(folder / "touching", op.world());
  op.drive_to(0.5);
  op.command(test::shot(45));
  write_keyframe(folder / "drilling", op.world());
  op.look_live(20, 100);
  op.command(test::simple(CommandKind::PutDown));
  op.command(test::take("cannulated_drill"));
  write_keyframe(folder / "over_the_wire", op.world());
  op.hand().guidance = Guidance::Planned;
  op.command(test::simple(CommandKind::PutDown));
  op.command(test::take("guide_wire"));
  op.hand().tip_in_patient.x += 60;
  op.hold(Driver::Off, 0, 60);
  write_keyframe(folder / "in_flight", op.world());
}

/// What a station appends for these inputs, as blocks of the target's own form.
void write_journal(const fs::path& folder, const Recording& recording, const Bytes& keyframe) {
  std::vector<std::pair<std::uint8_t, Bytes>> blocks;
  protocol::RunningExercise head;
  head.origin = "0123456789abcdef0123456789abcdef";
  head.trainee = "Ada";
  head.started_at = "2026-01-02T03:04:05Z";
  blocks.emplace_back(1, bytes_of(protocol::serialize_stored_exercise(head)));
  Recording begun = recording;
  begun.runs = {};
  begun.keyframes.clear();
  blocks.emplace_back(5, encode(begun));
  blocks.emplace_back(4, bytes_of("a page's word"));
  RunEncoder encoder;
  Tick tick = 0;
  std::size_t i = 0;
  for (const InputRun& run : recording.runs) {
    encoder.put(run);
    tick += run.ticks;
    const bool is_last = ++i == recording.runs.size();
    if (i % 40 != 0 && !is_last) continue;
    Bytes part;
    put(part, tick, 8);
    put(part, 4711, 8);
    const Bytes runs = encoder.take();
    put(part, runs.size(), 4);
    put(part, runs);
    put(part, bytes_of(protocol::serialize_stored_events(
                  {{static_cast<std::int64_t>(tick), "shot_taken", "A picture"}})));
    blocks.emplace_back(2, part);
    if (!is_last) continue;
    Bytes state;
    put(state, tick, 8);
    put(state, keyframe);
    blocks.emplace_back(3, state);
  }
  Bytes raw = bytes_of(records::kJournalMagic);
  Bytes listed;
  for (const auto& [kind, content] : blocks) {
    put(raw, records::encode_journal_block(raw.size(), kind, content));
    const std::size_t listed_size = content.size() - (kind == 5 ? kChecksum : 0);
    put(listed, kind, 1);
    put(listed, listed_size, 2);
    put(listed, std::span(content).first(listed_size));
  }
  write(folder / "file", raw);
  write(folder / "blocks", listed);
}

cases::Lesson small_lesson() {
  cases::Lesson lesson;
  lesson.title = "A waist";
  lesson.history = "fell";
  lesson.goal = "fix it";
  lesson.size = "average";
  lesson.reason = "no corridor";
  lesson.right_answer = cases::RightAnswer::Decline;
  lesson.decline_for = {"no_corridor"};
  lesson.expert = cases::ExpertProof{"dorsal_scaphoid_fixation", 3, true, 90};
  return lesson;
}

/// As a case's folder has it.
std::string small_tissue_text(const fs::path& beside) {
  const fs::path folder = beside / "small_case";
  fs::create_directories(folder);
  std::ofstream(folder / "case.json") << "{}";
  case_io::write_soft_tissue(case_io::test::small_tissue(), case_io::test::small_case(), folder);
  std::ifstream file(folder / case_io::kSoftTissueFolder / "soft_tissue.json", std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(file), {});
  fs::remove_all(folder);
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  const fs::path corpus = argv[1];
  const cases::CaseData small = case_io::test::small_case();
  write(corpus / "case_json" / "whole", bytes_of(case_io::case_json_text(small)));
  write(corpus / "hand_motion" / "whole",
        bytes_of(case_io::hand_motion_text(case_io::test::small_table())));
  write(corpus / "structures" / "whole",
        bytes_of(case_io::structures_text(case_io::test::small_structures())));
  const case_io::Trust trust{
      {{"lunate", 0.98, false, ""}, {"scaphoid_distal", 0.31, true, "it is hollow"}},
      {"the hamate is cut off by the edge of the scan"}};
  write(corpus / "trust" / "whole", bytes_of(case_io::trust_text(trust, "seed")));
  write(corpus / "lesson" / "whole", bytes_of(case_io::lesson_text(small_lesson())));
  write(corpus / "pathology" / "whole",
        bytes_of(case_io::pathology_text(
            arthroscopy::drawn_pathology(7, arthroscopy::PathologyTable::generic()))));
  write(corpus / "label_names" / "whole", bytes_of(R"({"radius": 1, "scaphoid_distal": 2})"));
  write(corpus / "soft_tissue" / "whole", bytes_of(small_tissue_text(corpus)));
  fs::create_directories(corpus / "dicom_segmentation");
  case_io::write_dicom_segmentation(corpus / "dicom_segmentation" / "two_bones",
                                    case_io::test::two_bones().view(),
                                    {{3, "scaphoid"}, {9, "capitate"}}, {"seed", true, "carpus"});
  write_keyframes(corpus / "keyframe");
  Recorder recorder("0.1.0", 4711, test::exercise(), 7);
  Operator op([&](const Input& input) { recorder.append(input); });
  op.place_on_entry({});
  op.command(test::shot(30, -5));
  op.look_live(20, 40);
  const Keyframe keyframe{recorder.tick(), op.world().write_state()};
  const Recording plain = recorder.finished(op.now().state_hash);
  write_body(corpus / "recording" / "operation", encode(plain));
  recorder.append_keyframe({recorder.tick(), Bytes(64)});
  write_body(corpus / "recording" / "with_keyframe", encode(recorder.finished(1)));
  Recording still = plain;
  still.runs = {{plain.runs.back().input, 60'000}};
  write_body(corpus / "recording" / "still", encode(still));
  Recording bomb = Recorder("", 0, test::exercise(), 0).finished(0);
  bomb.instruments.clear();
  bomb.runs = {{Input{}, kMaxRecordedTicks}};
  write_body(corpus / "recording" / "few_bytes_that_claim_hours", encode(bomb));
  RunEncoder encoder;
  for (const InputRun& run : plain.runs) encoder.put(run);
  write(corpus / "recording" / "runs", encoder.take());
  write_journal(corpus / "journal", plain, keyframe.state);
  return 0;
}
