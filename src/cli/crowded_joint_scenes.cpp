// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The scripted expert trims the disc. What it would not do is laid over its input: scope and tool
// lean on what they meet, the pull at the fingers sways. In an examination, where the expert probes
// one place after the other, a script of its own leads both hands instead.
#include "cli/crowded_joint_scenes.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "cli/crowded_joint.hpp"
#include "cli/tick_timing.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "simulation/world.hpp"
#include "trainee/arthroscopist.hpp"

namespace carpus::cli {
namespace {

using simulation::Input;
using simulation::Snapshot;
using simulation::World;

constexpr std::size_t kScope = 0;  // hands, as the scripted expert has them
constexpr std::size_t kTool = 1;
constexpr std::uint64_t kMostOperations = 12;

constexpr std::size_t kBites = 4;  // at least
constexpr std::size_t kBeforeBite = 20;
constexpr std::size_t kAfterBite = 100;

constexpr double kPullN = 69.0;
constexpr std::size_t kPullTicks = 2500;
constexpr double kPullS = static_cast<double>(kPullTicks) * kTickSeconds;
constexpr double kComesS = 1.5;  // of a hand on its way in, of the scope to what it leans on
constexpr double kPressS = 0.4;  // the probe stays on a place so long ...
constexpr double kGoS = 0.3;     // ... and takes so long from its portal's middle and to it again
constexpr double kPressMm = 1.3;
constexpr double kInsideMm = 2.0;
constexpr double kOutsideMm = 12.0;
constexpr double kPivotMm = 4.0;
constexpr std::size_t kSettlingTicks = 8000;  // all are in, and at it

bool is_in_joint(const Snapshot& now, std::size_t hand) {
  return now.scope.facts.is_in_joint[hand];
}

Vec3 distal_now(const cases::ArthroscopicMap& map, const Snapshot& now) {
  return (now.patient_from_bone[map.forearm] * Direction<frame::Bone>{map.distal}).v;
}

[[noreturn]] void throw_not_reached(const std::string& what) {
  throw InvalidInput("bench tick: on this case hands do not come to " + what);
}

/// A shaver runs, or a punch is open, which it is over what it is to bite.
bool is_at_work(const Snapshot& now) {
  const std::uint8_t held = now.hands[kTool].item;
  if (held >= simulation::kMaxItems) return false;
  const instruments::InstrumentIndex which = now.items[held].instrument;
  const auto all = instruments::catalogue();
  const bool has_bite = which < all.size() && all[which].bite;
  return now.scope.are_running[kTool] || (has_bite && !now.scope.are_closed[kTool]);
}

/// What the expert does, the scope leaning and the pull swaying.
class CrowdingExpert {
 public:
  CrowdingExpert(const World& world, std::uint64_t seed)
      : map_(*world.case_data().arthroscopy),
        hand_(world.case_data(), world.procedure(), trainee::Skill::Expert, seed) {
    hand_.examines(world.lesions());
  }
  [[nodiscard]] Input next(const Snapshot& now) {
    Input input = hand_.next(now);
    // A scope that leant while it is led elsewhere would be wedged between the bones.
    const bool is_working = is_in_joint(now, kScope) && is_in_joint(now, kTool) && is_at_work(now);
    const Vec3 distal = distal_now(map_, now);
    input.hands[kScope].tip_in_patient += leaning_[kScope].next(now, kScope, distal, is_working);
    input.hands[kTool].tip_in_patient += leaning_[kTool].next(now, kTool, -distal, is_working);
    if (is_in_joint(now, kTool)) {
      const double seconds = static_cast<double>(now.tick) * kTickSeconds;
      input.wrist.traction_n = unsteady_traction_n(input.wrist.traction_n, seconds);
    }
    return input;
  }
  [[nodiscard]] bool is_done() const noexcept { return hand_.is_done(); }

 private:
  const cases::ArthroscopicMap& map_;
  trainee::ScriptedArthroscopist hand_;
  std::array<Leaning, simulation::kHands> leaning_;
};

std::vector<SceneTimes> time_shaving(const cases::CaseData& data,
                                     const procedure::Procedure& procedure,
                                     std::size_t ticks) {
  SceneTimes shaving{"all_shaving", {}};
  TicksAbout bites(kBeforeBite, kAfterBite);
  std::size_t taken = 0;
  const auto wants_more = [&] {
    return shaving.microseconds.size() < ticks || bites.at().size() < kBites;
  };
  for (std::uint64_t seed = 1; seed <= kMostOperations && wants_more(); ++seed) {
    World world(data, procedure, seed);
    CrowdingExpert hand(world, seed);
    while (!world.now().finished && !hand.is_done()) {
      const procedure::ScopeFacts before = world.now().scope.facts;
      const float us = timed_step(world, hand.next(world.now()));
      const Snapshot& now = world.now();
      const procedure::ShavingFacts& done = now.scope.facts.shaving;
      const std::size_t gone = done.ill_removed + done.sound_removed -
                               (before.shaving.ill_removed + before.shaving.sound_removed);
      bites.add(us, gone > 0 && now.scope.facts.punch.bites > before.punch.bites);
      if (!now.scope.are_running[kTool] || !is_in_joint(now, kTool) || !is_disc_moving(now) ||
          moving_ligaments(now) == 0 || !is_in_contact(now, kScope) ||
          shaving.microseconds.size() >= ticks) {
        continue;
      }
      shaving.microseconds.push_back(us);
      taken += gone;
    }
  }
  if (taken == 0) throw_not_reached("shave with the scope in contact");
  if (bites.at().empty()) throw_not_reached("bite anything off");
  return {std::move(shaving), {"bite", bites.at()}, {"about_a_bite", bites.about()}};
}

/// A place of the tour, and which way a hand is led on there.
struct Pressed {
  const char* point;
  double up = 0.0;  ///< distally
};

/// By which portals, what the scope leans on, what is probed in turn.
struct Probing {
  std::array<const char*, simulation::kHands> portals;
  Pressed leant_on;
  std::vector<Pressed> probed;
};

/// From where disc and ligaments are reached.
Probing in_radiocarpal() {
  return {{"4-5", "6R"},
          {"sl_ligament", 1.0},
          {{"disc", -1.0}, {"sl_ligament", 1.0}, {"disc", -1.0}, {"lt_ligament", 1.0}}};
}

/// Through the interval of a torn ligament to what is left of it, and to the interval's mouth.
Probing in_midcarpal() {
  return {{"MCR", "MCU"}, {"sl_gap", -1.0}, {{"lt_ligament", -0.5}, {"lt_gap", -1.0}}};
}

/// Under traction scope and probe go in. Then the scope leans on one place; the probe is led from
/// place to place, each time back through the middle of its portal. From the snapshots alone.
class ProbingToAndFro {
 public:
  ProbingToAndFro(const cases::CaseData& data,
                  const procedure::Procedure& procedure,
                  const Probing& plan)
      : map_(*data.arthroscopy), opening_(procedure.opening(data)), probe_(procedure.tray.back()) {
    ways_ = {cases::find_portal(map_, plan.portals[kScope]),
             cases::find_portal(map_, plan.portals[kTool])};
    const auto leant_on = stop_at(plan.leant_on);
    for (const Pressed& each : plan.probed) {
      if (const auto stop = stop_at(each)) stops_.push_back(*stop);
    }
    if (!leant_on || stops_.size() < plan.probed.size() || ways_[kScope] == nullptr ||
        ways_[kTool] == nullptr) {
      throw_not_reached(std::string(plan.probed.front().point) + " and " + plan.leant_on.point +
                        " at once");
    }
    leant_on_ = *leant_on;
  }
  [[nodiscard]] Input next(const Snapshot& now) {
    const std::size_t tick = ticks_++;
    const double seconds = static_cast<double>(tick) * kTickSeconds;
    Input input;
    input.wrist = opening_.wrist;
    input.wrist.traction_n = kPullN;
    if (tick == kPullTicks) input.command = {simulation::CommandKind::Take, kTool, probe_};
    const double led_s = seconds - kPullS;
    lead(input, now, kScope, coming_in(now, kScope, led_s / kComesS));
    lead(input, now, kTool, coming_in(now, kTool, led_s / kComesS - 1.0));
    const double working_s = led_s - 2.0 * kComesS;
    if (working_s < 0.0) return input;
    input.wrist.traction_n = unsteady_traction_n(kPullN, working_s);
    const Vec3 distal = distal_now(map_, now);
    const double share = std::min(working_s / kComesS, 1.0);
    const Vec3 to = place(leant_on_, now, distal);
    lead(input, now, kScope, in_hole(now, kScope) * (1.0 - share) + to * share);
    lead(input, now, kTool, probed(now, distal, working_s));
    return input;
  }

 private:
  struct Stop {
    Vec3 at;  ///< frame Bone of `body`
    std::uint8_t body = 0;
    double up = 0.0;  ///< which way is out of the joint there
  };
  [[nodiscard]] std::optional<Stop> stop_at(const Pressed& pressed) const {
    for (const cases::TourPoint& each : map_.points) {
      if (each.id == pressed.point) return Stop{each.at, each.body, pressed.up};
    }
    return std::nullopt;
  }
  static Vec3 place(const Stop& stop, const Snapshot& now, const Vec3& distal) {
    return (now.patient_from_bone[stop.body] * Point<frame::Bone>{stop.at}).v +
           distal * (stop.up * kPressMm);
  }
  /// On a hand's way in, so far beyond the skin of its portal.
  [[nodiscard]] Vec3 on_way(const Snapshot& now, std::size_t hand, double deep_mm) const {
    const cases::Portal& way = *ways_[hand];
    const Vec3 at = way.skin + way.inwards * deep_mm;
    return (now.patient_from_bone[way.body] * Point<frame::Bone>{at}).v;
  }
  [[nodiscard]] Vec3 in_hole(const Snapshot& now, std::size_t hand) const {
    return on_way(now, hand, ways_[hand]->capsule_mm + kInsideMm);
  }
  [[nodiscard]] Vec3 coming_in(const Snapshot& now, std::size_t hand, double share) const {
    const double whole_mm = kOutsideMm + ways_[hand]->capsule_mm + kInsideMm;
    return on_way(now, hand, std::clamp(share, 0.0, 1.0) * whole_mm - kOutsideMm);
  }
  [[nodiscard]] Vec3 probed(const Snapshot& now, const Vec3& distal, double seconds) const {
    const double turns = seconds / (kPressS + 2.0 * kGoS);
    const auto turn = static_cast<std::size_t>(turns);
    const double at_s = (turns - static_cast<double>(turn)) * (kPressS + 2.0 * kGoS);
    const Vec3 middle = in_hole(now, kTool);
    const Vec3 to = place(stops_[turn % stops_.size()], now, distal);
    if (at_s < kGoS) return middle + (to - middle) * (at_s / kGoS);
    if (at_s < kGoS + kPressS) return to;
    return to + (middle - to) * ((at_s - kGoS - kPressS) / kGoS);
  }
  /// Through the hole in the skin, once it is deep in it.
  void lead(Input& input, const Snapshot& now, std::size_t hand, const Vec3& tip) const {
    const cases::Portal& way = *ways_[hand];
    const Vec3 inwards = (now.patient_from_bone[way.body] * Direction<frame::Bone>{way.inwards}).v;
    const Vec3 to_skin = on_way(now, hand, 0.0) - tip;
    const bool is_deep = -dot(to_skin, inwards) > kPivotMm;
    input.hands[hand].tip_in_patient = tip;
    input.hands[hand].shaft_in_patient = is_deep ? normalized_or(to_skin, -inwards) : -inwards;
  }

  const cases::ArthroscopicMap& map_;
  procedure::Opening opening_;
  instruments::InstrumentIndex probe_;
  std::array<const cases::Portal*, simulation::kHands> ways_{};
  Stop leant_on_;
  std::vector<Stop> stops_;
  std::size_t ticks_ = 0;
};

/// All is ill of which a tick takes notice, no ligament torn: whole sheets cost most.
cases::PreparedPathology much_wrong() {
  cases::PreparedPathology wrong;
  wrong.grades = {2, 2, 1, 2, 2, 2, 2, 2, 2, 1};
  wrong.seed = 1;
  return wrong;
}

/// The same, and the lunotriquetral ligament torn so that a probe passes (Geissler III).
cases::PreparedPathology torn() {
  cases::PreparedPathology wrong = much_wrong();
  wrong.grades[1] = 3;
  return wrong;
}

/// In the midcarpal joint, in and out of an interval, at whose end the ligament yields.
SceneTimes time_interval(const cases::CaseData& data,
                         const procedure::Procedure& procedure,
                         std::size_t ticks) {
  World world(data, procedure, 1, procedure::Mode::Practice, torn());
  SceneTimes probing{"interval_probed", {}};
  ProbingToAndFro probe(data, procedure, in_midcarpal());
  for (std::size_t i = 0; i < kSettlingTicks; ++i) world.step(probe.next(world.now()));
  std::size_t yielding = 0;
  for (std::size_t i = 0; i < 4 * ticks && probing.microseconds.size() < ticks; ++i) {
    const float us = timed_step(world, probe.next(world.now()));
    yielding += moving_ligaments(world.now());
    if (is_in_contact(world.now(), kTool)) probing.microseconds.push_back(us);
  }
  if (yielding == 0) throw_not_reached("press a ligament from its midcarpal side");
  return probing;
}

std::vector<SceneTimes> time_probing(const cases::CaseData& data,
                                     const procedure::Procedure& procedure,
                                     std::size_t ticks) {
  World world(data, procedure, 1, procedure::Mode::Practice, much_wrong());
  SceneTimes probing{"all_probing", {}};
  ProbingToAndFro probe(data, procedure, in_radiocarpal());
  for (std::size_t i = 0; i < kSettlingTicks; ++i) world.step(probe.next(world.now()));
  for (std::size_t i = 0; i < 4 * ticks && probing.microseconds.size() < ticks; ++i) {
    const float us = timed_step(world, probe.next(world.now()));
    const Snapshot& now = world.now();
    if (is_disc_moving(now) && moving_ligaments(now) > 0 && is_in_contact(now, kScope) &&
        is_in_contact(now, kTool)) {
      probing.microseconds.push_back(us);
    }
  }
  if (2 * probing.microseconds.size() < ticks) throw_not_reached("press disc and ligament at once");
  return {std::move(probing), time_interval(data, procedure, ticks)};
}

}  // namespace

std::vector<SceneTimes> time_crowded_joints(const cases::CaseData& data,
                                            const procedure::Procedure& procedure,
                                            std::size_t ticks) {
  const bool trims_disc = procedure.shaving && procedure.shaving->disc;
  if (!trims_disc && !procedure.examines) return {};
  if (data.arthroscopy == nullptr) (void)procedure.opening(data);  // says why not, and what to do
  if (data.arthroscopy == nullptr) throw InvalidInput("bench tick: the case has no soft tissue");
  return (trims_disc ? time_shaving : time_probing)(data, procedure, ticks);
}

}  // namespace carpus::cli
