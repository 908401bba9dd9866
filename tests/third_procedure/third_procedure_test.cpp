// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A trivial third procedure, declared here and nowhere else: its JSON, two predicates, an opening
// and a score. Played through the session, as a page does, to its score; recorded and replayed.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <iterator>
#include <string>

#include "procedure/procedure.hpp"
#include "session/held_input.hpp"
#include "session/page_input.hpp"
#include "session/score_message.hpp"
#include "session/session.hpp"
#include "simulation/operation_test_support.hpp"
#include "simulation/recording.hpp"
#include "simulation/world.hpp"

namespace carpus {
namespace {

using procedure::Situation;
using simulation::test::wrist;

bool has_looked(const Situation& now) noexcept { return !now.shots.empty(); }

bool is_touched(const Situation& now) noexcept {
  return now.hands[0].touches_target || now.hands[1].touches_target;
}

Vec3 middle_of(const cases::Bone& bone) {
  Vec3 sum;
  for (const Vec3& v : bone.surface.vertices) sum += v;
  return sum / static_cast<double>(bone.surface.vertices.size());
}

constexpr double kWaitingMm = 60.0;
const Vec3 kDorsal{0, 1, 0};  // of the synthetic wrist

procedure::Opening opening(const cases::CaseData& data) {
  procedure::Opening opening;
  opening.tip_in_target = middle_of(*cases::find_bone(data, BoneId::Lunate)) + kDorsal * kWaitingMm;
  opening.shaft_in_target = kDorsal;
  return opening;
}

procedure::ScoreReport score(const cases::CaseData& /*data*/,
                             const procedure::OperationRecord& record) {
  procedure::ScoreItem touched;
  touched.id = "lunate_touched";
  touched.label = "Lunate touched";
  touched.unit = "1";
  touched.points_possible = 100.0;
  touched.target = "touched";
  touched.reason = "That was all there was to do.";
  const bool is_done = (record.completed_steps & 2U) != 0;
  touched.value = is_done ? 1.0 : 0.0;
  touched.grade = is_done ? procedure::Grade::Good : procedure::Grade::Fail;
  touched.points = is_done ? touched.points_possible : 0.0;
  procedure::ScoreReport report;
  report.items = {touched};
  report.overall = touched.points;
  return report;
}

const procedure::Procedure& touch_the_lunate() {
  static const procedure::Procedure kDeclared = [] {
    constexpr std::array kPredicates{procedure::NamedPredicate{"has_looked", has_looked},
                                     procedure::NamedPredicate{"is_touched", is_touched}};
    std::ifstream file("tests/third_procedure/procedure.json");
    const std::string json{std::istreambuf_iterator<char>(file), {}};
    procedure::Procedure read =
        procedure::read_procedure(json, "touch_the_lunate/procedure.json", kPredicates);
    read.opening = opening;
    read.score = score;
    return read;
  }();
  return kDeclared;
}

/// A page that moves one hand, and a host that keeps what was done.
class Exercise {
 public:
  Exercise()
      : world_(wrist(), touch_the_lunate(), 1),
        session_(wrist(), touch_the_lunate(), world_.now()),
        source_(session::resting(world_.now())),
        recorder_("test", simulation::fingerprint_of(wrist()), touch_the_lunate(), 1) {}

  void move_to(const Vec3& tip) {
    protocol::Hand hand;
    hand.tip_mm = tip;
    hand.shaft = kDorsal;
    source_.hold(session_.take(hand));
    step({});
  }
  void step(const simulation::Command& command) {
    const simulation::Input input = source_.input(command);
    recorder_.append(input);
    world_.step(input);
    source_.passed();
  }
  void shoot() { step(session_.take(protocol::TakeShot{})); }
  void finish() {
    simulation::Command command;
    command.kind = simulation::CommandKind::Finish;
    step(command);
  }

  [[nodiscard]] const simulation::Snapshot& now() const { return world_.now(); }
  [[nodiscard]] protocol::Exercise described() const { return session_.exercise(); }
  [[nodiscard]] procedure::OperationRecord record() const { return world_.operation_record(); }
  [[nodiscard]] simulation::Recording recording() const {
    return recorder_.finished(world_.now().state_hash);
  }

 private:
  simulation::World world_;
  session::Session session_;
  session::InputSource source_;
  simulation::Recorder recorder_;
};

/// Down onto the lunate until the probe touches it.
void touch(Exercise& exercise) {
  const auto lunate = simulation::test::body_of(BoneId::Lunate);
  const Vec3 middle = middle_of(wrist().bones[lunate]);
  for (double above = kWaitingMm; above > 0 && !exercise.now().hands[0].touching; above -= 0.05) {
    const Point<frame::Bone> wanted{middle + kDorsal * above};
    exercise.move_to((exercise.now().patient_from_bone[lunate] * wanted).v);
  }
}

TEST(ThirdProcedure, IsPlayedThroughTheSessionToItsScore) {
  Exercise exercise;
  EXPECT_EQ(exercise.now().step, 0);
  exercise.shoot();
  EXPECT_EQ(exercise.now().completed_steps, 1U);
  EXPECT_EQ(exercise.now().step, 1);
  touch(exercise);
  EXPECT_EQ(exercise.now().hands[0].touched_body, simulation::test::body_of(BoneId::Lunate));
  EXPECT_EQ(exercise.now().completed_steps, 3U);
  exercise.finish();
  EXPECT_TRUE(exercise.now().finished);
  const procedure::ScoreReport report = touch_the_lunate().score(wrist(), exercise.record());
  EXPECT_EQ(report.overall, 100.0);
  const protocol::ScoreReport told = session::score_message(report);
  ASSERT_EQ(told.items.size(), 1U);
  EXPECT_EQ(told.items.front().id, "lunate_touched");
}

TEST(ThirdProcedure, NothingDoneEarnsNothing) {
  Exercise exercise;
  exercise.finish();
  EXPECT_EQ(touch_the_lunate().score(wrist(), exercise.record()).overall, 0.0);
}

TEST(ThirdProcedure, ThePageIsToldItsStepsAndTray) {
  const protocol::Exercise described = Exercise().described();
  EXPECT_EQ(described.procedure.id, "touch_the_lunate");
  ASSERT_EQ(described.steps.size(), 2U);
  EXPECT_EQ(described.steps[1].instruction, "Bring the probe's tip onto the lunate.");
  EXPECT_EQ(described.steps[1].instrument, "probe");
  EXPECT_EQ(described.tray, std::vector<std::string>{"probe"});
  EXPECT_EQ(described.views.size(), 1U);
}

TEST(ThirdProcedure, ItsRecordingReplaysToTheSameHash) {
  Exercise exercise;
  exercise.shoot();
  touch(exercise);
  exercise.finish();
  const auto decoded = simulation::decode(simulation::encode(exercise.recording()));
  ASSERT_TRUE(decoded.has_value()) << decoded.error();
  EXPECT_EQ(decoded->procedure, "touch_the_lunate");
  EXPECT_TRUE(simulation::replay(wrist(), touch_the_lunate(), *decoded).hash_matches);
}

TEST(ThirdProcedure, AHostOffersItBesideOthersByItsId) {
  const procedure::ProcedureList offered({&simulation::test::exercise(), &touch_the_lunate()});
  EXPECT_EQ(offered.find("touch_the_lunate"), &touch_the_lunate());
}

}  // namespace
}  // namespace carpus
