// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An examination of a case whose pathology was prepared: what is wrong is that, whatever the seed,
// and stays so in its recording when the case's is changed.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "arthroscopy/make_lesions.hpp"
#include "arthroscopy/named_grades.hpp"
#include "core/amount_test_support.hpp"
#include "simulation/box_joint_test_support.hpp"
#include "simulation/lesions_of.hpp"
#include "simulation/recording.hpp"
#include "simulation/replay_player.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {
namespace {

using namespace box_joint;  // NOLINT(google-build-using-namespace)

const procedure::Procedure& examination() {
  static const procedure::Procedure kExamination = probing(true);
  return kExamination;
}

cases::PreparedPathology torn(const char* grade) {
  cases::PreparedPathology prepared;
  prepared.seed = 3;
  EXPECT_TRUE(
      set_grade(prepared.grades, arthroscopy::PathologyTable::generic(), "scapholunate", grade));
  return prepared;
}

cases::CaseData case_with(const std::optional<cases::PreparedPathology>& prepared) {
  cases::CaseData data = box_wrist_with_ligament();
  data.pathology = prepared;
  return data;
}

/// A probe pushes at the ligament through the tear, with two keyframes on the way.
Recording probed(const cases::CaseData& data) {
  World world(data, examination(), 9);
  Recorder recorder("test", fingerprint_of(data), world);
  Hand hand(world);
  enter(hand);
  for (const double up : {2.0, 4.0, 6.0}) {
    const std::size_t before = hand.inputs.size();
    hand.go(kMiddle + Vec3{0.5, 0.4, up}, 100);
    if (up == 2.0) {
      for (const Input& input : hand.inputs) recorder.append(input);
    } else {
      for (std::size_t i = before; i < hand.inputs.size(); ++i) recorder.append(hand.inputs[i]);
    }
    recorder.append_keyframe({recorder.tick(), world.write_state()});
  }
  return recorder.finished(world.now().state_hash);
}

const std::uint64_t kSeeds = carpus::test::amount<std::uint64_t>(5, 20, 200);

TEST(PreparedPathology, IsWhatAnExaminationFindsWhateverItsSeed) {
  const cases::CaseData data = case_with(torn("III"));
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const World world(data, examination(), seed);
    ASSERT_NE(world.lesions(), nullptr);
    EXPECT_EQ(world.lesions()->grades, torn("III").grades);
    EXPECT_EQ(world.now().prepared, torn("III"));
  }
  const cases::CaseData healthy = case_with(cases::PreparedPathology{});
  for (std::uint64_t seed = 1; seed < kSeeds; ++seed) {
    EXPECT_EQ(World(healthy, examination(), seed).lesions()->lesions.size(), 0U);
  }
}

TEST(PreparedPathology, OfARecordingThatNamesNoGradesIsTheSeeds) {
  const cases::CaseData data = case_with(std::nullopt);
  const auto& table = arthroscopy::PathologyTable::generic();
  for (std::uint64_t seed = 1; seed < kSeeds; ++seed) {
    const World world(data, examination(), seed);
    EXPECT_FALSE(world.prepared());
    const cases::Grades grades =
        arthroscopy::grades_by(seed, table, arthroscopy::Drawn::WithoutGrades);
    EXPECT_EQ(world.lesions()->grades[0], grades[0]);
    // Drawn once and kept, it is the very same wrist.
    const World kept(data, examination(), 99, procedure::Mode::Practice,
                     cases::PreparedPathology{grades, seed, true});
    EXPECT_EQ(kept.lesions()->grades, world.lesions()->grades);
    ASSERT_EQ(kept.lesions()->lesions.size(), world.lesions()->lesions.size());
    for (std::size_t i = 0; i < kept.lesions()->lesions.size(); ++i) {
      EXPECT_EQ(kept.lesions()->lesions[i].from, world.lesions()->lesions[i].from);
    }
  }
}

TEST(PreparedPathology, WhatBeginsIsTheCasesElseDrawnAndNamedInItsRecording) {
  const cases::PreparedPathology seeds =
      arthroscopy::drawn_pathology(7, arthroscopy::PathologyTable::generic());
  EXPECT_EQ(pathology_to_begin_with(examination(), 7, {}), seeds);
  EXPECT_EQ(pathology_to_begin_with(examination(), 7, torn("III")), torn("III"));
  EXPECT_FALSE(pathology_to_begin_with(probe_alone(), 7, torn("III")));
}

TEST(PreparedPathology, ConcernsExaminationsAlone) {
  const cases::CaseData data = case_with(torn("IV"));
  const World world(data, probe_alone(), 1);
  EXPECT_EQ(world.lesions(), nullptr);
  EXPECT_FALSE(world.prepared());
  EXPECT_EQ(world.now().state_hash, World(case_with({}), probe_alone(), 1).now().state_hash);
}

TEST(PreparedPathology, ARecordingReplaysWhatItHadThoughTheCasesWasChanged) {
  const Recording recording = probed(case_with(torn("III")));
  const Result<Recording> stored = decode(encode(recording));
  ASSERT_TRUE(stored.has_value()) << stored.error();
  EXPECT_EQ(*stored, recording);
  for (const auto& since : {std::optional(torn("IV")), std::optional(cases::PreparedPathology{}),
                            std::optional<cases::PreparedPathology>()}) {
    const cases::CaseData data = case_with(since);
    const Replay again = replay(data, examination(), *stored);
    EXPECT_TRUE(again.hash_matches);
    EXPECT_TRUE(again.case_matches);
    ASSERT_TRUE(again.record.scope);
    EXPECT_EQ(again.record.scope->truth, torn("III").grades);

    ReplayPlayer player(data, examination(), std::make_shared<Recording>(*stored));
    ASSERT_TRUE(player.seek(player.length()));
    EXPECT_EQ(player.now().state_hash, recording.end_hash);
    ASSERT_TRUE(player.seek(1));
    EXPECT_EQ(player.now().prepared, torn("III"));

    World sought(data, examination(), 1);
    ASSERT_TRUE(seek(sought, *stored, stored->keyframes.front().tick - 1));
    ASSERT_TRUE(seek(sought, *stored, stored->tick_count()));
    EXPECT_EQ(sought.now().state_hash, recording.end_hash);
  }
}

TEST(PreparedPathology, ARecordingWithoutOneIsTheSeedsThoughTheCaseHasOneSince) {
  const Recording recording = probed(case_with({}));
  EXPECT_FALSE(recording.prepared);
  EXPECT_TRUE(replay(case_with(torn("IV")), examination(), recording).hash_matches);
  const std::vector<std::byte> bytes = encode(recording);
  EXPECT_EQ(static_cast<int>(bytes[8]), kRecordingFormat) << "older programs read it";
}

TEST(PreparedPathology, AReplayOfAnotherOneIsNoticed) {
  Recording recording = probed(case_with(torn("III")));
  recording.prepared = torn("IV");
  EXPECT_FALSE(replay(case_with({}), examination(), recording).hash_matches);
}

TEST(PreparedPathology, ARecordingOfAFindingThatThereIsNotIsRefusedByName) {
  std::vector<std::byte> bytes = encode(probed(case_with(torn("III"))));
  EXPECT_EQ(static_cast<int>(bytes[8]), kPreparedRecordingFormat);
  const std::string name = "scapholunate";
  const auto* const text = reinterpret_cast<const char*>(bytes.data());
  const std::size_t at = std::string_view(text, bytes.size()).find(name);
  ASSERT_NE(at, std::string_view::npos);
  bytes[at] = std::byte{'S'};
  const Result<Recording> decoded = decode(bytes);
  ASSERT_FALSE(decoded.has_value());
  EXPECT_NE(decoded.error().find("no finding 'Scapholunate'"), std::string::npos)
      << decoded.error();
}

}  // namespace
}  // namespace carpus::simulation
