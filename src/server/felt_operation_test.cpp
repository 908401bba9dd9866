// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An operation felt through the whole virtual arm: world, hands, driver, firmware, motors,
// mechanics and a hand of flesh on one virtual clock, each a millisecond behind the other as in the
// station.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string_view>
#include <vector>

#include "core/allocation_test_support.hpp"
#include "core/counting_new_test_support.hpp"
#include "devices/arm_device.hpp"
#include "devices/fake_link_test_support.hpp"
#include "devices/virtual_unit.hpp"
#include "server/device_hands.hpp"
#include "simulation/operation_test_support.hpp"

namespace carpus::server {
namespace {

using devices::Nanoseconds;
using simulation::Driver;

class FeltOperation {
 public:
  explicit FeltOperation(const virtual_arm::HandModel& flesh)
      : unit_(firmware::Drive::Motor, 3), line_(std::make_shared<devices::FakeLine>()) {
    devices::store(unit_.calibration(), folder_.path());
    unit_.arm().on_byte = [this](std::uint8_t byte, double) { line_->to_host.push_back(byte); };
    unit_.arm().plant().set_hand(flesh);
    mean({});
    device_ = std::make_unique<devices::ArmDevice>(devices::fake_opener(line_), folder_.path());
    device_->open();
    op.aim({});
  }
  /// The instrument waits so far before the entry, and down is inward for the device.
  void begin(double before_mm) {
    op.hand().tip_in_patient = op.entry() - op.inward() * before_mm;
    op.hold(Driver::Off, 0, 200);
    DeviceView view;
    view.up_in_patient = -op.inward();
    view.right_in_patient = any_perpendicular(op.inward());
    view.is_used = true;
    view.revision = 1;
    hands.set_view(0, view);
    for (int i = 0; i < 800; ++i) tick();
    start_ = place();
    tip_start_ = op.item().tip_in_patient;
  }
  /// Where the hand of flesh means to be, from the middle of the workspace.
  void mean(const Vec3& place, const Vec3& velocity = {}) {
    unit_.arm().plant().set_intent({unit_.arm().size().centre + place, velocity});
  }
  void tick() {
    unit_.arm().run_to_us(unit_.arm().now_us() + 1000);
    const auto now = static_cast<Nanoseconds>(1e9 + unit_.arm().now_us() * 1000);
    (void)hands.exchange(0).wishes.take(wish);
    if (!foresees && length(op.now().hands[0].force_in_patient) == 0) wish.command.plane_count = 0;
    (void)devices::HostLoop::turn(*device_, now, wish, state);
    unit_.arm().send(line_->to_device);
    line_->to_device.clear();
    state.able = device_->capabilities();
    hands.exchange(0).states.publish(state);
    if (!is_passing) return;
    simulation::Input input;
    input.hands[0] = op.hand();
    input.hands[0].driver = driver;
    input.hands[1] = op.hand(1);
    hands.before_at(now, input, op.now());
    op.hand() = input.hands[0];
    op.step();
    hands.after_at(now, op.now());
  }
  [[nodiscard]] Vec3 place() { return unit_.arm().plant().tip() - unit_.arm().size().centre; }
  /// Of the hand beyond where it began, inward [mm].
  [[nodiscard]] double inward_mm() { return start_.z - place().z; }
  /// Of the tool's tip.
  [[nodiscard]] double tip_inward_mm() const {
    return dot(op.item().tip_in_patient - tip_start_, op.inward());
  }

  devices::TemporaryFolder folder_;
  devices::VirtualUnit unit_;
  std::shared_ptr<devices::FakeLine> line_;
  std::unique_ptr<devices::ArmDevice> device_;
  simulation::test::Operator op;
  DeviceHands hands;
  devices::TimedCommand wish;
  devices::LoopState state;
  Driver driver = Driver::Off;
  bool foresees = true;
  bool is_passing = true;
  Vec3 start_;
  Vec3 tip_start_;
};

const virtual_arm::HandModel& hand(std::string_view name) {
  for (const auto& one : virtual_arm::kHandModels) {
    if (one.name == name) return one;
  }
  return virtual_arm::kReleasedHand;
}

/// At this speed onto bone: how deep the hand gets in the first 15 ms, and when it is told.
struct FirstTouch {
  double deepest_mm = 0;
  double first_force_ms = -1;
};
FirstTouch touch(double mm_per_s, bool foresees) {
  FeltOperation felt(hand("pen_grip"));
  felt.foresees = foresees;
  felt.begin(2.5);
  double surface_mm = 0;  // where the world stops the tip
  std::vector<double> depths;
  std::vector<double> forces;
  double way = 0;
  for (int ms = 0; ms < 300; ++ms) {
    way = std::min(way + mm_per_s / 1000, 8.0);
    felt.mean({0, 0, -way}, {0, 0, way < 8 ? -mm_per_s : 0});
    felt.tick();
    depths.push_back(felt.inward_mm());
    forces.push_back(felt.state.device.force_n.z);
    surface_mm = std::max(surface_mm, felt.tip_inward_mm());
  }
  FirstTouch result;
  int began = -1;
  for (int ms = 0; ms < 300; ++ms) {
    const double depth = depths[static_cast<std::size_t>(ms)] - surface_mm;
    if (began < 0 && depth > 0) began = ms;
    if (began < 0 || ms > began + 15) continue;
    result.deepest_mm = std::max(result.deepest_mm, depth);
    if (result.first_force_ms < 0 && forces[static_cast<std::size_t>(ms)] > 0.3)
      result.first_force_ms = ms - began;
  }
  EXPECT_GE(began, 0);
  return result;
}

TEST(FeltOperation, TheFirstTouchIsTheDevicesOwn) {
  const double mm_per_s = 200;
  const FirstTouch late = touch(mm_per_s, false);
  const FirstTouch early = touch(mm_per_s, true);
  std::printf(
      "first touch at %.0f mm/s: %.2f mm deep, felt after %.0f ms; told only when it touches: "
      "%.2f mm, %.0f ms\n",
      mm_per_s, early.deepest_mm, early.first_force_ms, late.deepest_mm, late.first_force_ms);
  // The drawn tip of 114 g goes on for a moment, whoever knows of the bone.
  EXPECT_LT(early.deepest_mm, 0.96 * late.deepest_mm);
  EXPECT_LE(early.first_force_ms, 3);
  EXPECT_GE(late.first_force_ms, early.first_force_ms + 2);
}

TEST(FeltOperation, TheCortexIsOpenedByWhatTheHandPressesAndThenGivesWay) {
  FeltOperation felt(hand("firm"));
  felt.begin(2);
  felt.driver = Driver::Forward;
  double way = 0;
  double entry = 0;
  double thrust = 0;
  double behind = 1e9;
  double shake = 0;
  for (int ms = 0; ms < 6000; ++ms) {
    // A hand that goes on evenly, and waits where it has pressed as much as it will.
    if (felt.state.device.force_n.z < 6.5) way += 0.004;
    felt.mean({0, 0, -way});
    felt.tick();
    const simulation::ItemView& item = felt.op.item();
    if (item.body == simulation::kNoBody) continue;
    const double force = felt.state.device.force_n.z;
    if (item.depth_mm < 1.5) {
      entry = std::max(entry, force);
      thrust = std::max(thrust, felt.op.hand().thrust_n);
      shake = std::max(shake, felt.wish.command.vibration_n);
    }
    if (item.depth_mm > 4) behind = std::min(behind, force);
    if (item.depth_mm > 8) break;
  }
  std::printf(
      "drilling: %.1f N felt at the entry (thrust %.0f N, shake %.2f N), %.1f N behind it\n", entry,
      thrust, shake, behind);
  EXPECT_GT(thrust, 12) << "subchondral bone asks for 15 to 40 N";
  EXPECT_LT(thrust, 45);
  EXPECT_LT(entry, 6.5) << "within what the device can give";
  EXPECT_LT(behind, 0.75 * entry);
  EXPECT_GT(shake, 0.06);
}

TEST(FeltOperation, NothingIsAskedForWhileTimeStandsStill) {
  FeltOperation felt(hand("pen_grip"));
  felt.begin(1);
  felt.mean({0, 0, -8});
  for (int ms = 0; ms < 300; ++ms) felt.tick();
  EXPECT_GT(felt.state.asked_force_n.z, 0.5);
  felt.is_passing = false;
  for (int ms = 0; ms < 5; ++ms) felt.tick();
  for (int ms = 0; ms < 150; ++ms) {
    felt.tick();
    EXPECT_EQ(felt.state.asked_force_n, Vec3{}) << ms;
  }
  EXPECT_LT(length(felt.state.device.force_n), 0.3);
  felt.is_passing = true;
  for (int ms = 0; ms < 300; ++ms) felt.tick();
  EXPECT_LT(length(felt.state.asked_force_n), 0.5) << "it goes on from where the hand is";
}

TEST(FeltOperation, TakesNoMemoryInATick) {
  FeltOperation felt(hand("pen_grip"));
  felt.begin(1);
  felt.mean({0, 0, -8});
  int allocations = 0;
  for (int ms = 0; ms < 100; ++ms) {
    felt.driver = ms > 50 ? Driver::Forward : Driver::Off;
    simulation::Input input;
    input.hands[0] = felt.op.hand();
    felt.tick();
    const auto now = static_cast<Nanoseconds>(1e9 + felt.unit_.arm().now_us() * 1000);
    simulation::test::Operator& op = felt.op;
    carpus::test::start_counting_allocations();
    felt.hands.before_at(now, input, op.now());
    felt.hands.after_at(now, op.now());
    allocations += carpus::test::stop_counting_allocations();
  }
  EXPECT_EQ(allocations, 0);
}

}  // namespace
}  // namespace carpus::server
