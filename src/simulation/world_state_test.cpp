// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A world's state as bytes: it comes back and goes on the same way, or is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "core/rng.hpp"
#include "core/state_hash.hpp"
#include "simulation/broken_wrist_test_support.hpp"
#include "simulation/detail/bytes.hpp"
#include "simulation/detail/operation_state.hpp"
#include "simulation/operation_test_support.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation {
namespace {

using test::Operator;
using test::wrist;

TEST(WorldState, ComesBackFromItsBytesAndGoesOnTheSameWay) {
  std::vector<Input> inputs;
  Operator op([&](const Input& input) { inputs.push_back(input); });
  test::operate(op);
  World whole(wrist(), test::exercise(), 1);
  World resumed(wrist(), test::exercise(), 1);
  const std::size_t cut = inputs.size() / 2;
  for (std::size_t i = 0; i < cut; ++i) whole.step(inputs[i]);
  const std::vector<std::byte> bytes = whole.write_state();
  EXPECT_LT(bytes.size(), std::size_t{1} << 20U);
  const auto taken = resumed.read_state(bytes);
  ASSERT_TRUE(taken.has_value()) << taken.error();
  EXPECT_EQ(resumed.now().tick, whole.now().tick);
  EXPECT_EQ(resumed.now().state_hash, whole.now().state_hash);
  EXPECT_EQ(resumed.now().items, whole.now().items);
  for (std::size_t i = cut; i < inputs.size(); ++i) {
    whole.step(inputs[i]);
    resumed.step(inputs[i]);
    ASSERT_EQ(resumed.now().state_hash, whole.now().state_hash) << "input " << i;
  }
}

TEST(WorldState, WhateverTicksLeaveIsTakenBack) {
  Rng rng(3);
  World world(wrist(), test::exercise(), 1);
  World other(wrist(), test::exercise(), 1);
  Input input;
  input.wrist = world.now().wrist;
  for (int tick = 0; tick < 6000; ++tick) {
    if (tick % 40 == 0) {  // wild hands, a wrist from corner to corner, any command
      for (std::size_t h = 0; h < kHands; ++h) {
        const ItemView& item = world.now().items[world.now().hands[h].item % kMaxItems];
        const double reach = rng.below(3) == 0 ? 1100.0 : 4.0;
        input.hands[h].tip_in_patient =
            item.tip_in_patient + Vec3{rng.uniform(-reach, reach), rng.uniform(-reach, reach),
                                       rng.uniform(-reach, reach)};
        input.hands[h].shaft_in_patient = {rng.normal(), rng.normal(), rng.normal()};
        input.hands[h].thrust_n = rng.uniform(-10, 700);
        input.hands[h].driver = static_cast<Driver>(rng.below(3));
        input.hands[h].guidance = static_cast<Guidance>(rng.below(2));
      }
      input.wrist = {rng.uniform(-0.7, 0.7), rng.uniform(-0.35, 0.35), rng.uniform(-1.1, 1.1),
                     rng.uniform(-20, 120)};
      input.c_arm = {rng.uniform(-200, 200), rng.uniform(-50, 50), rng.below(2) == 0};
    }
    input.command = {};
    if (tick % 30 == 7) {
      const auto kind = static_cast<CommandKind>(rng.below(kCommandKinds));
      if (kind != CommandKind::Finish) {
        input.command = {kind, static_cast<std::uint8_t>(rng.below(2)),
                         static_cast<std::uint8_t>(rng.below(16)), rng.uniform(-100, 100), 0};
      }
    }
    world.step(input);
    if (tick % 100 != 99) continue;
    const auto taken = other.read_state(world.write_state());
    ASSERT_TRUE(taken.has_value()) << "tick " << tick << ": " << taken.error();
    ASSERT_EQ(other.write_state(), world.write_state()) << "tick " << tick;
  }
}

TEST(WorldState, DamagedBytesAreRefusedAndChangeNothing) {
  Operator op;
  op.place_on_entry({});
  op.drive_to(5.0);
  const std::vector<std::byte> good = op.world().write_state();
  const std::uint64_t hash = op.now().state_hash;
  Rng rng(5);
  for (int i = 0; i < 300; ++i) {
    std::vector<std::byte> bad = good;
    if (i % 2 == 0) {
      bad.resize(rng.below(bad.size()));
    } else {
      bad[rng.below(bad.size())] ^= static_cast<std::byte>(1U << rng.below(8));
    }
    EXPECT_FALSE(op.world().read_state(bad).has_value());
  }
  EXPECT_EQ(op.now().state_hash, hash);
}

/// Reads the fields of a state and writes them, as write_state() does.
struct GetFields {
  detail::Reader& in;
  void operator()(double& value) const { value = in.get_double(); }
  void operator()(Vec3& v) const { v = {in.get_double(), in.get_double(), in.get_double()}; }
  template <typename T>
  void operator()(T& value) const {
    value = static_cast<T>(in.get(sizeof(T)));
  }
};
struct PutFields {
  detail::Writer& out;
  void operator()(double value) const { out.put(value); }
  void operator()(const Vec3& v) const {
    for (const double value : {v.x, v.y, v.z}) out.put(value);
  }
  template <typename T>
  void operator()(const T& value) const {
    out.put(static_cast<std::uint64_t>(value), sizeof(T));
  }
};

struct Forged {
  detail::Operated now;
  detail::Spent spent;
  procedure::Shot last_shot;
};

/// The same bytes with something changed, and the checksum that goes with it.
std::vector<std::byte> forged(const std::vector<std::byte>& good,
                              const std::function<void(Forged&)>& change) {
  const auto body = std::span(good).first(good.size() - 8);
  detail::Reader in(body);
  const GetFields get{in};
  Forged state;
  visit(state.now, get);
  visit(state.spent, get);
  std::vector<procedure::Shot> shots(state.spent.shot_count);
  for (procedure::Shot& shot : shots) detail::visit_shot(shot, get);
  state.last_shot = shots.back();
  change(state);
  shots.back() = state.last_shot;
  detail::Writer out;
  const PutFields put{out};
  visit(state.now, put);
  visit(state.spent, put);
  for (procedure::Shot& shot : shots) detail::visit_shot(shot, put);
  out.put(body.subspan(in.at()));
  StateHash hash;
  hash.add_bytes(out.bytes());
  out.put(hash.value(), 8);
  return out.bytes();
}

TEST(WorldState, ForgedBytesWithARightChecksumAreRefusedAndChangeNothing) {
  Operator op;
  op.command(test::take("probe", 1));
  op.place_on_entry({});
  op.drive_to(5.0);
  op.command(test::shot(45));
  op.look_live(20, 250);
  const std::vector<std::byte> good = op.world().write_state();
  ASSERT_EQ(forged(good, [](Forged&) {}), good);
  const std::uint64_t hash = op.now().state_hash;
  const auto wire = op.now().hands[0].item;
  const auto probe = op.now().hands[1].item;
  const std::vector<std::pair<const char*, std::function<void(Forged&)>>> forgeries{
      {"no such instrument", [&](Forged& f) { f.now.items[wire].instrument = 200; }},
      {"no such hand", [&](Forged& f) { f.now.items[wire].hand = 2; }},
      {"two hands hold it", [&](Forged& f) { f.now.held[1] = wire; }},
      {"a hand holds nothing that is there", [&](Forged& f) { f.now.held[1] = 9; }},
      {"held by a hand that does not know", [&](Forged& f) { f.now.held[0] = kNoItem; }},
      {"no such body", [&](Forged& f) { f.now.items[wire].body = 31; }},
      {"rides on itself", [&](Forged& f) { f.now.items[wire].wire = wire; }},
      {"rides on what is free", [&](Forged& f) { f.now.items[wire].wire = probe; }},
      {"no such hole", [&](Forged& f) { f.now.items[wire].hole = 7; }},
      {"no such pass", [&](Forged& f) { f.now.items[wire].pass = 63; }},
      {"crosses more than it can", [&](Forged& f) { f.now.items[wire].crossing_count = 5; }},
      {"crosses no body", [&](Forged& f) { f.now.items[wire].crossings[0].body = 77; }},
      {"a tip light years away", [&](Forged& f) { f.now.items[probe].tip.x = 1e300; }},
      {"no direction", [&](Forged& f) { f.now.items[wire].shaft = {}; }},
      {"a line without direction", [&](Forged& f) { f.now.items[wire].direction_in_bone = {}; }},
      {"endless travel", [&](Forged& f) { f.now.items[wire].travel_mm = 1e18; }},
      {"a hand in no phase", [](Forged& f) { f.spent.hands[0].plan.phase = HandPhase{4}; }},
      {"a hand faster than light", [](Forged& f) { f.spent.hands[1].plan.tip_velocity.z = 1e30; }},
      {"a driver that is none", [](Forged& f) { f.spent.hands[0].wish.driver = Driver{3}; }},
      {"a push of nobody", [](Forged& f) { f.spent.hands[0].wish.thrust_n = -5; }},
      {"touches no body", [](Forged& f) { f.spent.hands[1].touched_body = 40; }},
      {"a bone enlarged", [](Forged& f) { f.now.moved[0].w = 2; }},
      {"a whole bone out of its place", [](Forged& f) { f.now.moved[0].shift.x = 0.5; }},
      {"a body that there is not", [](Forged& f) { f.now.moved[kMaxBodies - 1].shift.x = 0.5; }},
      {"carried across the room", [](Forged& f) { f.now.carried.shift.y = 300; }},
      {"a track in no body", [](Forged& f) { f.now.tracks[0].body = 99; }},
      {"a track of no hole", [](Forged& f) { f.now.track_hole[0] = 40; }},
      {"a pass with no instrument", [](Forged& f) { f.spent.passes[0].instrument = 250; }},
      {"steps that there are not", [](Forged& f) { f.now.completed_steps |= 1U << 20U; }},
      {"more looks at a step than all", [](Forged& f) { f.now.shots_at_completion[0] = 900; }},
      {"looks that were not taken", [](Forged& f) { f.spent.looks += 3; }},
      {"a dose that was not given", [](Forged& f) { f.spent.pulses = 0; }},
      {"a dose of another voltage", [](Forged& f) { ++f.spent.dose_units; }},
      {"a tube that there is not", [](Forged& f) { f.spent.tube = procedure::kTubeSettings; }},
      {"declined, and it goes on", [](Forged& f) { f.spent.ended = 2; }},
      {"a shot from the future", [](Forged& f) { f.last_shot.tick = f.spent.tick + 1; }},
      {"a look of no kind", [](Forged& f) { f.last_shot.look = procedure::Look{9}; }},
      {"a pedal down without a look", [](Forged& f) { f.spent.live_ticks = 0xFFFFFFFF; }},
      {"a wrist beyond its limits", [](Forged& f) { f.spent.wrist.flexion_rad = 3; }},
      {"a C-arm that cannot stand so", [](Forged& f) { f.spent.c_arm.tilt_deg = 500; }},
      {"more undone than ticks", [](Forged& f) { f.spent.undos = 0x7FFFFFFF; }},
      {"more aids than ticks", [](Forged& f) { f.spent.aids_used = 0x7FFFFFFF; }},
      {"more passes than hands", [](Forged& f) { f.spent.pass_count += 0x7FFFFFFF; }},
      {"more wires broken than ticks", [](Forged& f) { f.spent.broken_wires = 0x7FFFFFFF; }},
      {"more threads stripped than ticks", [](Forged& f) { f.spent.stripped_screws = 0x7FFFFFFF; }},
      {"a tick after four hours", [](Forged& f) { f.spent.tick = ~std::uint64_t{0}; }},
  };
  for (const auto& [what, change] : forgeries) {
    const auto taken = op.world().read_state(forged(good, change));
    EXPECT_FALSE(taken.has_value()) << what;
    EXPECT_EQ(op.now().state_hash, hash) << what;
  }
  EXPECT_TRUE(op.world().read_state(good).has_value());
}

TEST(WorldState, AFragmentIsTakenBackNoFartherThanItsGapLetsIt) {
  const cases::CaseData& broken = test::broken_wrist();
  World world(broken, test::exercise(), 1);
  Input input;
  input.wrist = world.now().wrist;
  input.command = test::shot(45);
  world.step(input);
  const std::vector<std::byte> good = world.write_state();
  const auto proximal =
      std::find_if(broken.bones.begin(), broken.bones.end(),
                   [](const cases::Bone& bone) { return bone.part == BonePart::Proximal; });
  const auto fragment = static_cast<std::size_t>(proximal - broken.bones.begin());
  for (const auto& [mm, is_possible] : {std::pair{4.9, true}, std::pair{5.1, false}}) {
    const auto bytes = forged(good, [&](Forged& f) { f.now.moved[fragment].shift.z = mm; });
    EXPECT_EQ(world.read_state(bytes).has_value(), is_possible) << mm;
  }
}

}  // namespace
}  // namespace carpus::simulation
