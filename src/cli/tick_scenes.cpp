// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/tick_scenes.hpp"

#include <malloc.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "cli/crowded_joint_scenes.hpp"
#include "cli/tick_timing.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "core/version.hpp"
#include "instruments/instrument.hpp"
#include "simulation/recording.hpp"
#include "simulation/world.hpp"
#include "trainee/arthroscopist.hpp"
#include "trainee/attempt.hpp"
#include "trainee/portal_maker.hpp"
#include "trainee/scripted_trainee.hpp"

namespace carpus::cli {
namespace {

using simulation::CommandKind;
using simulation::Input;
using simulation::Snapshot;
using simulation::World;

constexpr int kWarmUpTicks = 200;
/// Operations after which a scene that a scripted trainee should reach is given up.
constexpr std::uint64_t kMostOperations = 12;

double heap_mib() {
  const struct mallinfo2 info = ::mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd) / (1024.0 * 1024.0);
}

/// A scene whose input is a function of time.
template <typename Script>
SceneTimes scene(const char* name, World& world, std::size_t ticks, Script&& script) {
  SceneTimes times{name, {}};
  times.microseconds.reserve(ticks);
  Input input = at_rest(world.now());
  for (int i = 0; i < kWarmUpTicks; ++i) world.step(input);
  for (std::size_t i = 0; i < ticks; ++i) {
    script(static_cast<double>(i) * kTickSeconds, input);
    times.microseconds.push_back(timed_step(world, input));
    input.command = {};
  }
  return times;
}

/// Middle of the target and its greatest distance from it, where it is now.
struct TargetPlace {
  Vec3 centre;
  double radius_mm = 0.0;
};

TargetPlace place_of(const cases::CaseData& data, BoneId target, const Snapshot& now) {
  TargetPlace place;
  double count = 0;
  for (const int pass : {0, 1}) {
    for (std::size_t body = 0; body < data.bones.size(); ++body) {
      if (data.bones[body].bone != target) continue;
      for (const Vec3& vertex : data.bones[body].surface.vertices) {
        const Vec3 at = (now.patient_from_bone[body] * Point<frame::Bone>{vertex}).v;
        if (pass == 0) {
          place.centre += at;
          count += 1;
        } else {
          place.radius_mm = std::max(place.radius_mm, distance(at, place.centre));
        }
      }
    }
    if (pass == 0) place.centre = place.centre / std::max(count, 1.0);
  }
  return place;
}

/// A point of the target's frame in Patient, where its first part is now.
Vec3 place_in(const cases::CaseData& data, BoneId target, const Snapshot& now, const Vec3& point) {
  std::size_t body = 0;
  while (body + 1 < data.bones.size() && data.bones[body].bone != target) ++body;
  return (now.patient_from_bone[body] * Point<frame::Bone>{point}).v;
}

/// An instrument of the tray that only touches, else the first.
instruments::InstrumentIndex toucher(const procedure::Procedure& procedure) {
  const auto all = instruments::catalogue();
  for (const instruments::InstrumentIndex index : procedure.tray) {
    const instruments::Instrument& each = all[index];
    if (each.work == instruments::Work::None && !each.is_gauge && !each.is_sleeve) return index;
  }
  return procedure.tray.front();
}

/// In which the wrist comes to where it is wanted.
constexpr int kPosingTicks = 3000;

/// Two instruments press on the target from where the first hand waits, and slide.
SceneTimes two_hands(const cases::CaseData& data,
                     const procedure::Procedure& procedure,
                     std::size_t ticks) {
  World world(data, procedure, 1);
  Input hold = at_rest(world.now());
  // Where the operator poses the wrist, an unposed one keeps a hand from the target.
  const procedure::Opening opening = procedure.opening(data);
  hold.wrist = opening.wrist;
  for (int i = 0; i < kPosingTicks; ++i) world.step(hold);
  const TargetPlace target = place_of(data, procedure.target, world.now());
  const Vec3 waits = place_in(data, procedure.target, world.now(), opening.tip_in_target);
  const Vec3 out = normalized_or(waits - target.centre, {0, 0, 1});
  const Vec3 side = any_perpendicular(out);
  const Vec3 along = cross(out, side);
  const auto shafts =
      std::array{normalized_or(out + side * 0.7, out), normalized_or(out - side * 0.7, out)};
  const auto press = [&](double seconds, Input& input) {
    for (std::size_t hand = 0; hand < simulation::kHands; ++hand) {
      const double sign = hand == 0 ? 1.0 : -1.0;
      const double angle = 2.0 * kPi * seconds * (hand == 0 ? 0.7 : 0.9);
      input.hands[hand].tip_in_patient = target.centre + out * (0.5 * target.radius_mm) +
                                         side * (sign * (3.0 + std::cos(angle))) +
                                         along * (3.0 * std::sin(angle));
      input.hands[hand].shaft_in_patient = shafts[hand];
      input.hands[hand].thrust_n = 5.0;
    }
  };
  Input input = at_rest(world.now());
  for (const std::uint8_t hand : {std::uint8_t{0}, std::uint8_t{1}}) {
    input.command = {CommandKind::Take, hand, toucher(procedure)};
    world.step(input);
    input.command = {};
  }
  for (int i = 0; i < 1000; ++i) {
    press(0.0, input);
    world.step(input);
  }
  std::size_t touched = 0;
  SceneTimes times = scene("two_hands_in_contact", world, ticks, [&](double seconds, Input& now) {
    press(seconds, now);
    touched += world.now().hands[0].touching && world.now().hands[1].touching ? 1 : 0;
  });
  if (2 * touched < ticks) {
    throw InvalidInput("bench tick: two hands do not reach the target on this case");
  }
  return times;
}

SceneTimes wrist_moving(const cases::CaseData& data,
                        const procedure::Procedure& procedure,
                        std::size_t ticks) {
  World world(data, procedure, 1);
  // About how the operation begins, by less than what would catch the instrument between bones:
  // then it holds the wrist, and there is nothing to measure.
  const simulation::WristPose open = world.now().wrist;
  // The instrument is pressed on the target wherever the wrist takes it.
  const TargetPlace target = place_of(data, procedure.target, world.now());
  const Vec3 out = normalized_or(world.now().items[0].tip_in_patient - target.centre, {0, 0, 1});
  std::size_t body = 0;
  while (body + 1 < data.bones.size() && data.bones[body].bone != procedure.target) ++body;
  const auto bone_from_patient = world.now().patient_from_bone[body].inverse();
  const Point<frame::Bone> pressed =
      bone_from_patient * Point<frame::Patient>{target.centre + out * (0.5 * target.radius_mm)};
  const Direction<frame::Bone> shaft = bone_from_patient * Direction<frame::Patient>{out};
  std::size_t moved = 0;
  simulation::WristPose before = world.now().wrist;
  SceneTimes times = scene("wrist_moving", world, ticks, [&](double seconds, Input& input) {
    const double turn = 2.0 * kPi * seconds;
    input.wrist = {open.flexion_rad + 0.2 * std::sin(0.3 * turn),
                   open.radial_deviation_rad + 0.1 * std::sin(0.4 * turn),
                   open.pronation_rad + 0.4 * std::sin(0.2 * turn),
                   open.traction_n + 30.0 * (1.0 - std::cos(0.1 * turn))};
    const auto& patient_from_bone = world.now().patient_from_bone[body];
    input.hands[0].tip_in_patient = (patient_from_bone * pressed).v;
    input.hands[0].shaft_in_patient = (patient_from_bone * shaft).v;
    moved += world.now().wrist == before ? 0 : 1;
    before = world.now().wrist;
  });
  if (2 * moved < ticks) throw InvalidInput("bench tick: the wrist does not move on this case");
  return times;
}

/// Whether this tick's input drives an instrument that works so, in bone.
bool drives(const Snapshot& now, const Input& input, instruments::Work work) {
  const auto all = instruments::catalogue();
  for (std::size_t hand = 0; hand < simulation::kHands; ++hand) {
    const std::uint8_t held = now.hands[hand].item;
    if (held >= simulation::kMaxItems || now.items[held].instrument >= all.size()) continue;
    if (input.hands[hand].driver == simulation::Driver::Forward &&
        now.items[held].body != simulation::kNoBody &&
        all[now.items[held].instrument].work == work) {
      return true;
    }
  }
  return false;
}

/// Ticks of whole operations, sorted by what was driven; afterwards back to before the last bone
/// was removed.
void operate(const cases::CaseData& data,
             const procedure::Procedure& procedure,
             std::size_t ticks,
             TickBench& bench) {
  SceneTimes drilling{"drilling", {}};
  SceneTimes screwing{"screw_going_in", {}};
  const auto wants = [ticks](const SceneTimes& times) { return times.microseconds.size() < ticks; };
  for (std::uint64_t seed = 1; seed <= kMostOperations && (wants(drilling) || wants(screwing));
       ++seed) {
    World world(data, procedure, seed);
    trainee::ScriptedTrainee hand(data, procedure, trainee::Skill::Expert, seed);
    while (!world.now().finished && !hand.is_done()) {
      const Input input = hand.next(world.now());
      if (input.command.kind == CommandKind::Finish) break;
      const bool is_drilling = drives(world.now(), input, instruments::Work::Drill);
      const bool is_screwing = drives(world.now(), input, instruments::Work::Thread);
      const float us = timed_step(world, input);
      if (is_drilling && wants(drilling)) drilling.microseconds.push_back(us);
      if (is_screwing && wants(screwing)) screwing.microseconds.push_back(us);
    }
    Input undo = at_rest(world.now());
    undo.command = {CommandKind::Undo};
    while (world.now().can_undo && !world.now().finished) {
      bench.costs.undo_us = std::max(bench.costs.undo_us, double{timed_step(world, undo)});
    }
    bench.unresolved_contacts += world.faults().unresolved_contacts;
  }
  for (SceneTimes* times : {&drilling, &screwing}) {
    if (times->microseconds.empty()) {
      throw InvalidInput("bench tick: the scripted expert does not come to " + times->scene +
                         " on this case");
    }
    bench.scenes.push_back(std::move(*times));
  }
}

/// Operations of the scripted arthroscopist, of which the ticks count in which the scope looks into
/// a joint, those in which the disc yields besides, and those in which a shaver runs.
void look_round(const cases::CaseData& data,
                const procedure::Procedure& procedure,
                std::size_t ticks,
                TickBench& bench) {
  SceneTimes looking{"scope_in_joint", {}};
  SceneTimes yielding{"disc_yields", {}};
  SceneTimes shaving{"shaving", {}};
  const bool shaves = procedure.shaving.has_value();
  SceneTimes ligament{"ligament_yields", {}};
  SceneTimes both{"disc_and_ligament", {}};
  const auto wants = [ticks](const SceneTimes& times) { return times.microseconds.size() < ticks; };
  for (std::uint64_t seed = 1;
       seed <= kMostOperations && (wants(looking) || wants(yielding) || (shaves && wants(shaving)));
       ++seed) {
    World world(data, procedure, seed);
    trainee::ScriptedArthroscopist hand(data, procedure, trainee::Skill::Expert, seed);
    hand.examines(world.lesions());
    while (!world.now().finished && !hand.is_done()) {
      const Input input = hand.next(world.now());
      const float us = timed_step(world, input);
      const Snapshot& now = world.now();
      const bool shaves_now = now.scope.are_running[0] || now.scope.are_running[1];
      const bool is_disc = !now.sheets[0].is_still;
      const bool is_ligament = std::any_of(
          now.sheets.begin() + 1, now.sheets.begin() + std::max<std::size_t>(1, now.sheet_count),
          [](const simulation::SheetView& sheet) { return !sheet.is_still; });
      if (shaves_now) {
        if (wants(shaving)) shaving.microseconds.push_back(us);
      } else if (is_disc && is_ligament) {
        if (wants(both)) both.microseconds.push_back(us);
      } else if (is_ligament) {
        if (wants(ligament)) ligament.microseconds.push_back(us);
      } else if (is_disc && wants(yielding)) {
        yielding.microseconds.push_back(us);
      } else if (now.scope.facts.is_in_joint[0] && wants(looking)) {
        looking.microseconds.push_back(us);
      }
    }
    bench.unresolved_contacts += world.faults().unresolved_contacts;
  }
  for (SceneTimes* times : {&looking, &yielding, &ligament, &both, &shaving}) {
    if (!times->microseconds.empty()) bench.scenes.push_back(std::move(*times));
  }
}

/// Portals made by the scripted hand: what it feels, marks and cuts on the skin, and what goes
/// through it.
void make_portals(const cases::CaseData& data,
                  const procedure::Procedure& procedure,
                  std::size_t ticks,
                  TickBench& bench) {
  SceneTimes on{"on_skin", {}};
  SceneTimes under{"under_skin", {}};
  const auto wants = [ticks](const SceneTimes& times) { return times.microseconds.size() < ticks; };
  for (std::uint64_t seed = 1; seed <= kMostOperations && (wants(on) || wants(under)); ++seed) {
    World world(data, procedure, seed);
    trainee::ScriptedPortalMaker hand(data, procedure, trainee::Skill::Expert, seed);
    while (!world.now().finished && !hand.is_done()) {
      const float us = timed_step(world, hand.next(world.now()));
      const simulation::SkinView& skin = world.now().skin;
      const bool is_under = std::ranges::any_of(skin.under_mm, [](double mm) { return mm > 0.0; });
      const bool is_on = std::ranges::any_of(
          skin.feels, [](const auto& feels) { return feels.felt != simulation::Felt::Nothing; });
      if (is_under && wants(under)) under.microseconds.push_back(us);
      if (is_on && wants(on)) on.microseconds.push_back(us);
    }
    bench.unresolved_contacts += world.faults().unresolved_contacts;
  }
  for (SceneTimes* times : {&on, &under}) {
    if (!times->microseconds.empty()) bench.scenes.push_back(std::move(*times));
  }
}

void cost_of_exercise(const cases::CaseData& data,
                      const procedure::Procedure& procedure,
                      ExerciseCosts& costs) {
  std::array<double, 5> set_up{};
  for (double& ms : set_up) {
    const double heap = heap_mib();
    const double before = processor_us();
    const World world(data, procedure, 1);
    ms = (processor_us() - before) / 1000.0;
    costs.memory_mib = std::max(costs.memory_mib, heap_mib() - heap);
  }
  std::sort(set_up.begin(), set_up.end());
  costs.set_up_ms = set_up[set_up.size() / 2];
  const trainee::Attempt attempt =
      trainee::operate(data, procedure, trainee::Skill::Expert, 1, kProgramVersion);
  const double simulated_s = static_cast<double>(attempt.recording.tick_count()) * kTickSeconds;
  const double before = processor_us();
  (void)simulation::replay(data, procedure, attempt.recording);
  costs.replay_speed = simulated_s / ((processor_us() - before) * 1e-6);
  costs.recording_bytes_per_s =
      static_cast<double>(simulation::encode(attempt.recording).size()) / simulated_s;
}

}  // namespace

TickBench time_ticks(const cases::CaseData& data,
                     const procedure::Procedure& procedure,
                     std::size_t ticks) {
  TickBench bench;
  {
    World world(data, procedure, 1);
    bench.scenes.push_back(scene("quiet", world, ticks, [](double, Input&) {}));
  }
  if (trainee::is_arthroscopy(procedure)) {
    look_round(data, procedure, ticks, bench);
    for (SceneTimes& times : time_crowded_joints(data, procedure, ticks)) {
      bench.scenes.push_back(std::move(times));
    }
    cost_of_exercise(data, procedure, bench.costs);
    return bench;
  }
  if (procedure.making) {
    make_portals(data, procedure, ticks, bench);
    cost_of_exercise(data, procedure, bench.costs);
    return bench;
  }
  bench.scenes.push_back(two_hands(data, procedure, ticks));
  bench.scenes.push_back(wrist_moving(data, procedure, ticks));
  operate(data, procedure, ticks, bench);
  cost_of_exercise(data, procedure, bench.costs);
  return bench;
}

}  // namespace carpus::cli
