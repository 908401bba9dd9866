// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A wrist, a procedure and a hand for tests: the synthetic wrist flexed by a rotation without sine
// or cosine, five steps of no clinical meaning, and a hand that knows where the axis is.
#pragma once

#include <cmath>
#include <functional>
#include <string_view>
#include <utility>

#include "cases/synthetic_case_test_support.hpp"
#include "simulation/permission.hpp"
#include "simulation/recording.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation::test {

/// Flexion [rad] in which the synthetic wrist's radius is out of the way: cosine 4/5.
inline constexpr double kOpenFlexionRad = 0.6435011087932844;

/// All of the hand turns as one about a point near the capitate, by up to 36.87 degrees of flexion;
/// deviation does nothing; pronation turns about an axis along the forearm.
inline cases::HandMotion simple_motion() {
  cases::HandMotion motion;
  motion.limits.flexion_rad = {-kOpenFlexionRad, kOpenFlexionRad};
  motion.limits.radial_deviation_rad = {-0.3, 0.3};
  motion.limits.pronation_rad = {-1.0, 1.0};
  motion.limits.traction_n = {0, 100};
  motion.flexion_rad = {-kOpenFlexionRad, 0, kOpenFlexionRad};
  motion.deviation_rad = {-0.3, 0, 0.3};
  motion.reference.fill({-12, 0, -4});
  for (const double flexion : {-1.0, 0.0, 1.0}) {
    for (int deviation = 0; deviation < 3; ++deviation) {
      cases::HandMotionNode node;
      for (const anatomy::CarpalGroup group : anatomy::kMovingGroups) {
        node.groups[static_cast<std::size_t>(group)].quaternion = {
            flexion == 0.0 ? 1.0 : std::sqrt(0.9), -flexion * std::sqrt(0.1), 0, 0};
      }
      motion.nodes.push_back(node);
    }
  }
  motion.hand_axis = {0, 0, -1};
  motion.pronation_axis = {0, 0, 1};
  motion.pronation_centre = {-24, 4, 48};
  motion.pronation_rad = {-1.0, 1.0};
  motion.pronation_shift = {{}, {}};
  return motion;
}

inline const cases::CaseData& wrist() {
  static const cases::CaseData data = [] {
    cases::CaseData made = cases::test::synthetic_case();
    made.hand_motion = simple_motion();
    return made;
  }();
  return data;
}

inline std::uint8_t body_of(BoneId bone) {
  for (std::size_t i = 0; i < wrist().bones.size(); ++i) {
    if (wrist().bones[i].bone == bone) return static_cast<std::uint8_t>(i);
  }
  return kNoBody;
}

inline procedure::Opening open_flexed(const cases::CaseData& data) {
  procedure::Opening opening;
  opening.wrist.flexion_rad = kOpenFlexionRad;
  opening.tip_in_target = data.scaphoid.waist + Vec3{0, 80, 0};
  opening.shaft_in_target = {0, 1, 0};
  return opening;
}

namespace predicates {
inline bool touches(const procedure::Situation& now) noexcept {
  return now.hands[0].touches_target || now.hands[1].touches_target;
}
inline bool is_in(const procedure::Situation& now) noexcept {
  for (const auto& line : now.lines) {
    if (line.in_target) return true;
  }
  return false;
}
inline bool is_out(const procedure::Situation& now) noexcept { return !is_in(now); }
inline bool is_driven(const procedure::Situation& now) noexcept {
  for (const auto& line : now.lines) {
    if (line.in_target && line.depth_mm >= 0.6 * line.chord_mm) return true;
  }
  return false;
}
inline bool has_looked_since(const procedure::Situation& now) noexcept {
  return (now.completed_steps & 2U) != 0 && !now.recent_shots.empty();
}
inline bool is_measured(const procedure::Situation& now) noexcept {
  return now.gauge_reading_mm >= 0;
}
inline bool is_seated(const procedure::Situation& now) noexcept {
  for (const auto& line : now.lines) {
    if (line.in_target && line.buried_mm >= 0 &&
        instruments::catalogue()[line.instrument].work == instruments::Work::Thread) {
      return true;
    }
  }
  return false;
}
inline bool is_unseated(const procedure::Situation& now) noexcept { return !is_seated(now); }
inline procedure::ScoreReport score(const cases::CaseData&,
                                    const procedure::OperationRecord& record) {
  procedure::ScoreReport report;
  report.overall = record.finished ? 100 : 0;
  return report;
}
}  // namespace predicates

/// Enter, drive, look, measure, seat a screw. All instruments are on its tray.
inline const procedure::Procedure& exercise() {
  static const procedure::Procedure made = [] {
    procedure::Procedure p;
    p.id = "test_exercise";
    p.title = "Test exercise";
    p.target = BoneId::Scaphoid;
    for (std::size_t i = 0; i < instruments::catalogue().size(); ++i) {
      p.tray.push_back(static_cast<InstrumentIndex>(i));
    }
    std::swap(p.tray.front(), p.tray[*instruments::instrument_of("guide_wire")]);
    using namespace predicates;
    p.steps = {{"touch", "Touch", "", {}, &touches, nullptr, false},
               {"drive", "Drive", "", {}, &is_driven, &is_out, false},
               {"look", "Look", "", {}, &has_looked_since, &is_out, false},
               {"measure", "Measure", "", {}, &is_measured, &is_out, false},
               {"screw", "Screw", "", {}, &is_seated, &is_unseated, true}};
    p.decline.reasons = {{"flexed", "It is flexed"}, {"worn", "It is worn"}};
    p.opening = &open_flexed;
    p.score = &score;
    return p;
  }();
  return made;
}

inline std::uint8_t instrument(std::string_view id) {
  return instruments::instrument_of(id).value();
}

inline Command take(std::string_view id, std::uint8_t hand = 0) {
  return {CommandKind::Take, hand, instrument(id), 0, 0};
}
inline Command shot(double rotation_deg, double tilt_deg = 0) {
  return {CommandKind::TakeShot, 0, 0, rotation_deg, tilt_deg};
}
inline Command simple(CommandKind kind, std::uint8_t hand = 0) { return {kind, hand, 0, 0, 0}; }

inline bool is_done(const Snapshot& now, unsigned step) {
  return (now.completed_steps >> step & 1U) != 0;
}

inline bool has_event(const Snapshot& snapshot, EventKind kind) {
  for (std::size_t i = 0; i < snapshot.event_count; ++i) {
    if (snapshot.events[i].kind == kind) return true;
  }
  return false;
}

inline Refusal refusal_in(const Snapshot& snapshot) {
  for (std::size_t i = 0; i < snapshot.event_count; ++i) {
    if (snapshot.events[i].kind == EventKind::Refused) {
      return static_cast<Refusal>(snapshot.events[i].detail);
    }
  }
  return Refusal::None;
}

/// Where and how a wire goes in, relative to the central axis.
struct Aim {
  Vec3 entry_offset_mm;   ///< added to the axis' proximal end, frame Bone
  Vec3 distal_offset_mm;  ///< added to its distal end
};

/// Works with its first hand; the second waits far off.
class Operator {
 public:
  /// @param listener  called with every input before it is stepped.
  explicit Operator(std::function<void(const Input&)> listener = {},
                    const cases::CaseData& data = wrist())
      : data_(data), world_(data, exercise(), 1), listener_(std::move(listener)) {
    input_.wrist = world_.now().wrist;
    input_.hands[1].tip_in_patient = {0, 150, 0};
    input_.hands[1].shaft_in_patient = {0, 1, 0};
    aim({});
    hand().tip_in_patient = entry_ - inward_ * 25.0;
    hold(Driver::Off, 0.0, 20);
  }

  /// Turns the plan into Patient, with the wrist as it is held now.
  void aim(const Aim& aim) {
    const auto& axis = data_.scaphoid.central_axis;
    const auto& pose = world_.now().patient_from_bone[body_of(BoneId::Scaphoid)];
    const Vec3 entry = axis.proximal + aim.entry_offset_mm;
    entry_ = (pose * Point<frame::Bone>{entry}).v;
    const Vec3 distal = axis.distal + aim.distal_offset_mm;
    inward_ = (pose * Direction<frame::Bone>{normalized_or(distal - entry, {0, 0, 1})}).v;
    hand().shaft_in_patient = -inward_;
  }

  const Snapshot& place_on_entry(const Aim& plan) {
    aim(plan);
    for (double away = 25.0; away > -0.4; away -= 0.05) {
      hand().tip_in_patient = entry_ - inward_ * away;
      hold(Driver::Off, 0.0, 1);
    }
    return hold(Driver::Off, 0.0, 100);
  }

  const Snapshot& hold(Driver driver, double thrust_n, int ticks) {
    hand().driver = driver;
    hand().thrust_n = thrust_n;
    for (int i = 0; i < ticks; ++i) step();
    return world_.now();
  }

  /// What the first hand holds.
  [[nodiscard]] const ItemView& item() const {
    static const ItemView kNothing;
    const std::uint8_t held = world_.now().hands[0].item;
    return held < kMaxItems ? world_.now().items[held] : kNothing;
  }

  const Snapshot& drive_to(double depth_mm) {
    for (int i = 0; i < 100000 && item().depth_mm < depth_mm; ++i) {
      hold(Driver::Forward, 30.0, 1);
    }
    return hold(Driver::Off, 0.0, 1);
  }
  const Snapshot& bury(double buried_mm) {
    for (int i = 0; i < 100000 && item().buried_mm < buried_mm; ++i) hold(Driver::Forward, 30.0, 1);
    return hold(Driver::Off, 0.0, 1);
  }

  const Snapshot& command(const Command& command) {
    input_.command = command;
    step();
    input_.command = {};
    return world_.now();
  }

  /// With the foot pedal down.
  const Snapshot& look_live(double rotation_deg, int ticks) {
    input_.c_arm = {rotation_deg, 0.0, true};
    hold(Driver::Off, 0.0, ticks);
    input_.c_arm.pedal_is_down = false;
    return hold(Driver::Off, 0.0, 1);
  }

  /// Holds the wrist so until it is there.
  const Snapshot& bend(const WristPose& pose, int ticks = 3000) {
    input_.wrist = pose;
    return hold(Driver::Off, 0.0, ticks);
  }

  [[nodiscard]] HandInput& hand(std::size_t which = 0) { return input_.hands[which]; }
  [[nodiscard]] const Snapshot& now() const { return world_.now(); }
  [[nodiscard]] World& world() { return world_; }
  [[nodiscard]] const Vec3& entry() const { return entry_; }
  [[nodiscard]] const Vec3& inward() const { return inward_; }

  void step() {
    if (listener_) listener_(input_);
    world_.step(input_);
  }

 private:
  const cases::CaseData& data_;
  World world_;
  Input input_;
  Vec3 entry_;
  Vec3 inward_;
  std::function<void(const Input&)> listener_;
};

/// The whole of it, with everything that a world can do: for replay and allocation.
inline void operate(Operator& op, std::string_view screw = "acutrak_standard_1994_20") {
  op.command(shot(0));
  op.command(shot(90));
  op.place_on_entry({{3, 2, 1}, {}});
  op.place_on_entry({});
  op.drive_to(8.0);
  op.hold(Driver::Reverse, 0.0, 2000);  // out again: the next pass meets the old track
  op.place_on_entry({{0.4, 0.3, 0}, {0.5, 0, 0}});
  op.drive_to(24.0);
  op.command(shot(45));
  op.look_live(20, 250);
  op.bend({kOpenFlexionRad - 0.1, 0.1, 0.2, 20.0}, 400);
  op.command(take("depth_gauge", 1));
  op.command(simple(CommandKind::ReadGauge, 1));
  op.command(simple(CommandKind::PutDown, 1));
  op.command(take("probe", 1));
  op.command(take("cannulated_drill"));
  op.drive_to(12.0);
  op.hold(Driver::Reverse, 0.0, 6000);
  op.command(take(screw));
  op.bury(1.0);
  op.command(simple(CommandKind::PutDown));
  op.command(shot(0, 30));
}

}  // namespace carpus::simulation::test
