// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A page without a host: its texts go through a session into a world, in a plain loop, and every
// message that comes back is read as the page reads it.
#include "session/session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <string>
#include <variant>
#include <vector>

#include "simulation/operation_test_support.hpp"

namespace carpus::session {
namespace {

using simulation::test::exercise;
using simulation::test::wrist;
using ::testing::HasSubstr;

class Page {
 public:
  Page()
      : world_(wrist(), exercise(), 1),
        session_(wrist(), exercise(), world_.now()),
        source_(resting(world_.now())) {}

  /// Says it as text; returns why the session refuses it, empty when it does not.
  std::string say(const protocol::PageMessage& message) {
    const auto parsed = protocol::parse_page_message(protocol::serialize(message));
    if (!parsed) return parsed.error();
    return std::visit([this](const auto& m) { return take(m); }, *parsed);
  }

  /// Time passes; the page is told the state at the end, and all events.
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      simulation::Command command;
      if (!commands_.empty()) {
        command = commands_.front();
        commands_.pop_front();
      }
      const simulation::Snapshot& now = world_.step(source_.input(command));
      source_.passed();
      for (std::size_t e = 0; e < now.event_count; ++e) {
        events.push_back(session_.describe(now.events[e]));
      }
    }
    update(false);
  }

  void update(bool paused) {
    received.clear();
    HostState host;
    host.paused = paused;
    for (const protocol::HostMessage& message : session_.update(world_.now(), host)) {
      const auto parsed = protocol::parse_host_message(protocol::serialize(message));
      ASSERT_TRUE(parsed.has_value()) << parsed.error();
      received.push_back(*parsed);
      if (const auto* s = std::get_if<protocol::Snapshot>(&*parsed)) snapshot = *s;
      if (const auto* a = std::get_if<protocol::Actions>(&*parsed)) actions = *a;
      if (const auto* t = std::get_if<protocol::Tissue>(&*parsed)) tissue = *t;
    }
  }

  void hold(const Vec3& tip, const Vec3& shaft, double thrust_n, protocol::Driver driver) {
    protocol::Hand hand;
    hand.tip_mm = tip;
    hand.shaft = shaft;
    hand.thrust_n = thrust_n;
    hand.driver = driver;
    EXPECT_EQ(say(hand), "");
  }

  [[nodiscard]] bool has_event(const std::string& kind) const {
    for (const auto& event : events) {
      if (event.kind == kind) return true;
    }
    return false;
  }
  template <typename Message>
  [[nodiscard]] std::size_t count() const {
    std::size_t found = 0;
    for (const auto& message : received) found += std::holds_alternative<Message>(message) ? 1 : 0;
    return found;
  }
  [[nodiscard]] const protocol::Item& held() const {
    static const protocol::Item kNothing;
    for (const protocol::Item& item : snapshot.items) {
      if (item.hand == 0) return item;
    }
    return kNothing;
  }
  [[nodiscard]] simulation::World& world() { return world_; }
  [[nodiscard]] Session& session() { return session_; }

  std::vector<protocol::HostMessage> received;  ///< with the last update
  std::vector<protocol::LoggedEvent> events;
  protocol::Snapshot snapshot;
  protocol::Actions actions;
  protocol::Tissue tissue;

 private:
  std::string take(const protocol::Hand& message) {
    source_.hold(session_.take(message));
    return {};
  }
  std::string take(const protocol::Wrist& message) {
    source_.hold(session_.take(message));
    return {};
  }
  std::string take(const protocol::CArm& message) {
    source_.hold(session_.take(message));
    return {};
  }
  std::string take(const protocol::Pedal& message) {
    source_.hold(session_.take(message));
    return {};
  }
  std::string take(const protocol::Act& message) {
    const auto command = session_.take(message);
    if (!command) return command.error();
    commands_.push_back(*command);
    return {};
  }
  std::string take(const protocol::TakeShot& message) {
    commands_.push_back(session_.take(message));
    return {};
  }
  template <typename Message>
  std::string take(const Message&) {
    return "not the session's";
  }

  simulation::World world_;
  Session session_;
  InputSource source_;
  std::deque<simulation::Command> commands_;
};

protocol::Act act(protocol::ActionId id, std::int64_t hand = 0) {
  protocol::Act message;
  message.id = id;
  message.hand = hand;
  return message;
}

protocol::Act take(const std::string& instrument, std::int64_t hand = 0) {
  protocol::Act message = act(protocol::ActionId::Take, hand);
  message.instrument = instrument;
  return message;
}

/// Puts the wire on the axis' proximal end and drives it by so much.
void drive_wire(Page& page, double depth_mm) {
  const auto& axis = wrist().scaphoid.central_axis;
  const auto& pose =
      page.world().now().patient_from_bone[simulation::test::body_of(BoneId::Scaphoid)];
  const Vec3 entry = (pose * Point<frame::Bone>{axis.proximal}).v;
  const Vec3 inward =
      (pose * Direction<frame::Bone>{normalized_or(axis.distal - axis.proximal, {0, 0, 1})}).v;
  for (double away = 25.0; away > -0.4; away -= 1.0) {
    page.hold(entry - inward * away, -inward, 0, protocol::Driver::Off);
    page.run(20);
  }
  for (int i = 0; i < 2000 && page.held().depth_mm < depth_mm; ++i) {
    page.hold(entry - inward * -0.4, -inward, 30, protocol::Driver::Forward);
    page.run(20);
  }
  page.hold(entry - inward * -0.4, -inward, 0, protocol::Driver::Off);
  page.run(20);
}

TEST(Session, PageOperatesWithoutAHost) {
  Page page;
  page.run(1);
  EXPECT_EQ(page.held().instrument, "guide_wire");
  drive_wire(page, 20.0);
  EXPECT_TRUE(page.has_event("entered_bone"));
  EXPECT_GE(page.held().depth_mm, 20.0);
  EXPECT_TRUE(page.held().in_target);
  EXPECT_EQ(page.held().body, "scaphoid");
  ASSERT_EQ(page.tissue.tracks.size(), 1U);
  EXPECT_EQ(page.tissue.tracks[0].body, "scaphoid");

  EXPECT_EQ(page.say(take("depth_gauge", 1)), "");
  EXPECT_EQ(page.say(act(protocol::ActionId::ReadGauge, 1)), "");
  page.run(5);
  EXPECT_TRUE(page.snapshot.gauge_reading_mm.has_value());
  EXPECT_EQ(page.say(protocol::TakeShot{}), "");
  EXPECT_EQ(page.say(act(protocol::ActionId::Finish)), "");
  page.run(5);
  EXPECT_EQ(page.snapshot.shots, 1);
  EXPECT_TRUE(page.snapshot.finished);
  EXPECT_EQ(page.snapshot.step, static_cast<std::int64_t>(exercise().steps.size()));
  EXPECT_EQ(page.events.back().kind, "finished");
}

TEST(Session, EveryActionThatIsNotAllowedIsRefusedWithTheReasonThatWasTold) {
  Page page;
  page.run(1);
  std::size_t refused = 0;
  const protocol::Actions told = page.actions;
  for (const protocol::Action& action : told.actions) {
    EXPECT_EQ(action.reason.empty(), action.allowed) << action.label;
    if (action.allowed) continue;
    protocol::Act message;
    message.id = action.id;
    message.hand = std::max<std::int64_t>(0, action.hand);
    if (!action.instrument.empty()) message.instrument = action.instrument;
    if (action.item >= 0) message.item = action.item;
    if (action.id == protocol::ActionId::Judge) message.displaced = true;
    page.events.clear();
    EXPECT_EQ(page.say(message), "");
    page.run(1);
    ASSERT_EQ(page.events.size(), 1U) << action.label;
    EXPECT_EQ(page.events[0].kind, "refused");
    EXPECT_EQ(page.events[0].text, action.reason) << action.label;
    ++refused;
  }
  EXPECT_GT(refused, 4U);
}

TEST(Session, WireInAnotherBoneIsNotCalledOutsideOfBone) {
  Page page;
  page.run(1);
  page.say(take("cannulated_drill"));
  page.run(1);
  EXPECT_THAT(page.events.back().text, HasSubstr("no wire lies in the bone that is operated on"));
}

TEST(Session, TellsPosesTissueAndActionsOnlyWhenTheyChanged) {
  Page page;
  page.run(1);
  EXPECT_EQ(page.count<protocol::Actions>(), 1U);
  EXPECT_EQ(page.count<protocol::Tissue>(), 1U);
  ASSERT_TRUE(page.snapshot.bodies.has_value());
  EXPECT_EQ(page.snapshot.bodies->size(), wrist().bones.size());
  page.run(50);
  EXPECT_EQ(page.received.size(), 1U);
  EXPECT_FALSE(page.snapshot.bodies.has_value());
  protocol::Wrist bent;
  bent.flexion_deg = page.snapshot.wrist.flexion_deg - 10;
  page.say(bent);
  page.run(50);
  EXPECT_TRUE(page.snapshot.bodies.has_value());
  EXPECT_EQ(page.count<protocol::Actions>(), 0U);
  page.session().forget_what_was_sent();
  page.update(false);
  EXPECT_EQ(page.received.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<protocol::Snapshot>(page.received.back()));
  EXPECT_TRUE(page.snapshot.bodies.has_value());
}

TEST(Session, PosesSentArePosesOfTheWorld) {
  Page page;
  page.run(1);
  const auto& sent = *page.snapshot.bodies;
  const simulation::Snapshot& now = page.world().now();
  for (std::size_t body = 0; body < sent.size(); ++body) {
    const auto& q = sent[body].quaternion;
    const Vec3 v{q[1], q[2], q[3]};
    for (const Vec3& x : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{-3, 20, 7}}) {
      const Vec3 turned = x + 2.0 * cross(v, cross(v, x) + q[0] * x) + sent[body].translation_mm;
      EXPECT_LT(distance(turned, (now.patient_from_bone[body] * Point<frame::Bone>{x}).v), 1e-9);
    }
  }
}

TEST(Session, PausedStateAsksForNoForce) {
  Page page;
  page.run(1);
  simulation::Snapshot pushed = page.world().now();
  pushed.hands[0].force_in_patient = {0, 3, 0};
  HostState host;
  const BodyNames bodies(wrist());
  EXPECT_EQ(snapshot_message(pushed, host, bodies).hands[0].force_n, (Vec3{0, 3, 0}));
  host.paused = true;
  EXPECT_EQ(snapshot_message(pushed, host, bodies).hands[0].force_n, Vec3{});
}

TEST(Session, LettingGoStopsDriversAndLeavesEverythingWhereItIs) {
  Page page;
  page.run(1);
  page.hold({1, 2, 3}, {0, 0, 1}, 30, protocol::Driver::Forward);
  const HeldInput held = page.session().let_go();
  EXPECT_EQ(held.hands[0].driver, simulation::Driver::Off);
  EXPECT_EQ(held.hands[0].thrust_n, 0.0);
  EXPECT_EQ(held.hands[0].tip_in_patient, page.world().now().items[0].tip_in_patient);
  EXPECT_EQ(held.wrist, page.world().now().wrist);
}

TEST(Session, ExerciseIsAllThatAPageNeedsToShowIt) {
  Page page;
  const protocol::HostMessage message = page.session().exercise();
  const auto parsed = protocol::parse_host_message(protocol::serialize(message));
  ASSERT_TRUE(parsed.has_value()) << parsed.error();
  const auto& told = std::get<protocol::Exercise>(*parsed);
  EXPECT_EQ(told.procedure.id, "test_exercise");
  EXPECT_EQ(told.steps.size(), exercise().steps.size());
  EXPECT_EQ(told.tray.size(), told.instruments.size());
  EXPECT_EQ(told.tray.front(), "guide_wire");
  EXPECT_FALSE(told.instruments.front().parts.empty());
  ASSERT_EQ(told.bodies.size(), wrist().bones.size());
  for (const protocol::Body& body : told.bodies) {
    EXPECT_EQ(body.is_target, body.name == "scaphoid");
    EXPECT_FALSE(body.label.empty());
  }
  EXPECT_LT(told.wrist_limits.flexion_deg.low, told.wrist_limits.flexion_deg.high);
  for (const double limit : {told.wrist_limits.flexion_deg.low, told.wrist_limits.flexion_deg.high,
                             told.wrist_limits.pronation_deg.high}) {
    EXPECT_EQ(limit, std::round(1000 * limit) / 1000);
  }
}

TEST(Session, ActionsThatLackSomethingAreRefusedByName) {
  Page page;
  EXPECT_THAT(page.say(act(protocol::ActionId::Take)), HasSubstr("needs an instrument"));
  EXPECT_THAT(page.say(take("spoon")), HasSubstr("no instrument 'spoon'"));
  EXPECT_THAT(page.say(act(protocol::ActionId::PickUp)), HasSubstr("needs an item"));
  EXPECT_THAT(page.say(act(protocol::ActionId::TakeShot)), HasSubstr("take_shot"));
}

TEST(Session, CArmStaysInTheRoomAndThePedalIsLetGoWhenNothingIsHeardOfIt) {
  Page page;
  page.run(10);
  EXPECT_EQ(page.say(protocol::CArm{45, 10, protocol::AngleReference::HeldForearm}), "");
  EXPECT_EQ(page.say(protocol::Pedal{true}), "");
  page.run(100);
  EXPECT_TRUE(page.snapshot.c_arm.live);
  EXPECT_NEAR(page.snapshot.c_arm.rotation_deg, 45, 0.02);
  EXPECT_NEAR(page.snapshot.c_arm.tilt_deg, 10, 0.02);
  page.update(true);
  EXPECT_FALSE(page.snapshot.c_arm.live) << "while time stands still no tube is on";
  page.run(2000);
  EXPECT_FALSE(page.snapshot.c_arm.live) << "nothing was heard of it for 2 s";
  EXPECT_EQ(page.snapshot.shots, 1);
  EXPECT_TRUE(page.has_event("live_ended"));
  EXPECT_THAT(page.events.back().text, HasSubstr("2.0 s")) << page.events.back().text;

  protocol::Wrist wrist;
  wrist.flexion_deg = page.snapshot.wrist.flexion_deg;
  wrist.pronation_deg = 20;
  EXPECT_EQ(page.say(wrist), "");
  page.run(2000);
  EXPECT_NEAR(page.snapshot.c_arm.rotation_deg, 25, 0.1) << "the forearm turned under it";
}

}  // namespace
}  // namespace carpus::session
