// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "trainee/scripted_trainee.hpp"

#include <algorithm>

#include "procedure/screw_catalogue.hpp"

namespace carpus::trainee {
namespace {

using simulation::CommandKind;
using simulation::Driver;
using simulation::Input;
using simulation::Snapshot;

constexpr double kStandoffMm = 18.0;       // from where the last straight approach starts
constexpr double kFirstStandoffMm = 45.0;  // where the hand waits during the survey
constexpr double kPressMm = 0.5;           // hand beyond the surface, so that the tip rests on it
constexpr Tick kMostTicks = 900000;        // 15 min: whoever has not finished by then gives up
constexpr Tick kEngageTicks = 2500;
constexpr Tick kPhaseTicks = 60000;
constexpr int kMostTries = 8;
constexpr double kGreatestPushN = 58.0;

Tick ticks_of(double seconds) { return static_cast<Tick>(seconds / kTickSeconds); }

BoneSolid solid_of(const cases::CaseData& data) {
  std::vector<const TriangleMesh*> fragments;
  for (const cases::Bone* part : cases::scaphoid_parts(data)) fragments.push_back(&part->surface);
  return BoneSolid(fragments);
}

Vec3 axis_direction(const cases::CaseData& data) {
  const auto& axis = data.scaphoid.central_axis;
  return normalized_or(axis.distal - axis.proximal, {0, 0, 1});
}

}  // namespace

ScriptedTrainee::ScriptedTrainee(const cases::CaseData& posed_case, Skill skill, std::uint64_t seed)
    : case_(posed_case),
      profile_(profile_of(skill)),
      rng_(seed * 2 + static_cast<std::uint64_t>(skill)),
      tremor_(profile_.tremor_mm, Rng(seed ^ 0x7265746Du)),
      scaphoid_(solid_of(posed_case)) {
  plan_line();
  hand_ = {planned_entry_ - planned_direction_ * kFirstStandoffMm, -planned_direction_};
  enter(Phase::Survey);
}

/// A unit vector across the axis, any way round: the larger of random tries is as even as needed.
Vec3 ScriptedTrainee::random_across() {
  const Vec3 axis = axis_direction(case_);
  Vec3 across;
  do {
    const Vec3 any{rng_.uniform(-1, 1), rng_.uniform(-1, 1), rng_.uniform(-1, 1)};
    across = any - axis * dot(any, axis);
  } while (squared_length(across) < 0.01);
  return normalized_or(across, any_perpendicular(axis));
}

/// Where the trainee believes that the axis runs, for this try.
void ScriptedTrainee::plan_line() {
  const auto& axis = case_.scaphoid.central_axis;
  planned_entry_ = axis.proximal + random_across() * (draw(profile_.entry_error_mm) * error_scale_);
  const Vec3 aim = axis.distal + random_across() * (draw(profile_.aim_error_mm) * error_scale_);
  planned_direction_ = normalized_or(aim - planned_entry_, axis_direction(case_));
  thrust_n_ = draw(profile_.drive_thrust_n);
  stop_depth_mm_ = -1.0;
}

void ScriptedTrainee::enter(Phase phase) {
  phase_ = phase;
  in_phase_ = 0;
  wait_ = ticks_of(draw(profile_.reaction_s));
  next_shot_ = 0;
  lean_n_ = 0.0;
  last_depth_mm_ = -1e9;
  plan_shots();
  if (phase == Phase::GoToStandoff) {
    start_move({planned_entry_ - planned_direction_ * kStandoffMm, -planned_direction_});
  } else if (phase == Phase::Approach) {
    start_move({planned_entry_ + planned_direction_ * (kPressMm + 1.0), -planned_direction_});
  } else if (phase == Phase::Insert) {
    bury_mm_ = draw(profile_.bury_mm);
  }
}

void ScriptedTrainee::start_move(const HandPose& target) {
  const double way = distance(hand_.tip, target.tip) + 40.0 * distance(hand_.shaft, target.shaft);
  move_ = MinimumJerkMove(hand_, target, ticks_of(0.3 + way / profile_.speed_mm_per_s));
  in_move_ = 0;
}

void ScriptedTrainee::plan_shots() {
  shots_.clear();
  if (phase_ == Phase::Survey) shots_ = {{0, 0}, {90, 0}};
  if (phase_ == Phase::Check || phase_ == Phase::Verify) {
    shots_ = {{0, 0}, {90, 0}};
    if (profile_.checks_oblique) shots_.insert(shots_.end(), {{45, 0}, {0, 30}});
  }
  if (shots_.empty()) return;
  for (int i = 0; i < profile_.repeated_shots; ++i) {
    shots_.push_back({rng_.uniform(-10, 10), 0});
  }
}

/// Takes the next planned picture, one each 0.8 s; true when all are taken.
bool ScriptedTrainee::shoot(Input& input) {
  constexpr Tick kBetweenShots = 800;
  if (next_shot_ >= shots_.size()) return true;
  if (in_phase_ % kBetweenShots == kBetweenShots - 1) {
    const PlannedShot& shot = shots_[next_shot_++];
    input.command = {CommandKind::TakeShot, 0, shot.rotation_deg, shot.tilt_deg};
  }
  return false;
}

/// Greatest distance of the line from the axis at its two ends, as the pictures show it [mm].
double ScriptedTrainee::offset_of_line(const Snapshot& now) const {
  const auto& axis = case_.scaphoid.central_axis;
  double greatest = 0;
  for (const Vec3& p : {axis.proximal, axis.distal}) {
    const Vec3 w = p - now.wire.entry_in_patient;
    greatest = std::max(greatest, length(cross(w, now.wire.direction_in_patient)));
  }
  return greatest;
}

void ScriptedTrainee::judge_line(const Snapshot& now) {
  if (offset_of_line(now) > profile_.noticed_error_mm && tries_ + 1 < profile_.most_passes) {
    ++tries_;
    error_scale_ *= profile_.learning;
    enter(Phase::Withdraw);
  } else {
    enter(Phase::Measure);
  }
}

/// What the state says about going on to the next phase.
void ScriptedTrainee::think(const Snapshot& now) {
  switch (phase_) {
    case Phase::GoToStandoff:
      if (move_.is_over(in_move_)) enter(Phase::Approach);
      return;
    case Phase::Approach:
      if (move_.is_over(in_move_) || (now.contact.touching && now.contact.depth_mm > kPressMm)) {
        enter(Phase::Engage);
      }
      return;
    case Phase::Engage:
      if (now.wire.engaged) {
        enter(Phase::Drive);
      } else if (in_phase_ > kEngageTicks) {  // skated or missed: look again, closer
        error_scale_ *= 0.7;
        plan_line();
        enter(++tries_ < kMostTries ? Phase::GoToStandoff : Phase::Finish);
      }
      return;
    case Phase::Drive:
      if (stop_depth_mm_ >= 0 && now.wire.depth_mm >= stop_depth_mm_) enter(Phase::Check);
      if (in_phase_ > kPhaseTicks) enter(Phase::Check);
      return;
    case Phase::Judge:
      return judge_line(now);
    case Phase::Withdraw:
      if (!now.wire.engaged) {
        hand_ = {now.tip_in_patient, now.shaft_in_patient};
        plan_line();
        enter(Phase::GoToStandoff);
      }
      return;
    case Phase::Insert:
      if (now.screw.buried_mm >= bury_mm_ || in_phase_ > kPhaseTicks) enter(Phase::Verify);
      return;
    default:
      return;
  }
}

void ScriptedTrainee::drill(const Snapshot& now, Input& input) {
  input.driver = Driver::Forward;
  lean(now.wire.depth_mm);
  input.thrust_n = std::min(kGreatestPushN, thrust_n_ + lean_n_);
  if (phase_ != Phase::Drive || now.wire.depth_mm <= 0.5) return;
  if (stop_depth_mm_ < 0) {  // how far to go on this line, as read off the pictures
    const auto chord = scaphoid_.chord_through(
        now.wire.entry_in_patient + now.wire.direction_in_patient, now.wire.direction_in_patient);
    const double length_mm = chord ? chord->leave_mm + 1.0 : 20.0;
    stop_depth_mm_ = std::max(8.0, length_mm - draw(profile_.stop_before_far_mm));
  }
  // Slower near the end, and just enough push to go on.
  if (stop_depth_mm_ - now.wire.depth_mm < 2.0) {
    input.thrust_n = std::min(input.thrust_n, now.resistance_n + 4.0 + lean_n_);
  }
}

/// Where nothing moves for a while, the hand pushes harder; once it moves, it eases off.
void ScriptedTrainee::lean(double depth_mm) {
  constexpr Tick kPatience = 200;
  constexpr double kMovedMm = 0.05;
  constexpr double kMoreN = 4.0;
  if (in_phase_ % kPatience != 0) return;
  if (depth_mm - last_depth_mm_ < kMovedMm) {
    lean_n_ = std::min(lean_n_ + kMoreN, kGreatestPushN);
  } else {
    lean_n_ = std::max(0.0, lean_n_ - kMoreN);
  }
  last_depth_mm_ = depth_mm;
}

void ScriptedTrainee::choose_screw(const Snapshot& now, Input& input) {
  const double measured = now.measured_mm > 0 ? now.measured_mm : now.wire.depth_mm;
  // The catalogue's rule deducts 4 mm; who deducts less chooses as if the bone were longer.
  const double read = measured + (procedure::kMeasuredMinusScrewMm - profile_.screw_deduction_mm);
  const int index = std::max(0, procedure::ideal_screw_index(procedure::screw_catalogue(), read));
  input.command = {CommandKind::SelectScrew, index, 0, 0};
}

void ScriptedTrainee::insert(const Snapshot& now, Input& input) {
  constexpr double kThrustN = 22.0;
  input.driver = Driver::Forward;
  lean(now.screw.advance_mm);
  input.thrust_n = std::min(kGreatestPushN, kThrustN + lean_n_);
  if (bury_mm_ - now.screw.buried_mm < 1.5) {
    input.thrust_n = std::min(input.thrust_n, now.resistance_n + 4.0 + lean_n_);
  }
}

/// What the hand does in this phase, once it has reacted.
void ScriptedTrainee::act(const Snapshot& now, Input& input) {
  switch (phase_) {
    case Phase::Survey:
      if (shoot(input)) enter(Phase::GoToStandoff);
      return;
    case Phase::Engage:
    case Phase::Drive:
      return drill(now, input);
    case Phase::Check:
      if (shoot(input)) enter(Phase::Judge);
      return;
    case Phase::Withdraw:
      input.driver = Driver::Reverse;
      return;
    case Phase::Measure:
      // A gauge beside a wire that is through the far cortex reads nothing: pull back a little.
      if (now.measured_mm >= 0 || in_phase_ > 4000) {
        enter(Phase::Choose);
      } else if (in_phase_ % 200 == 199) {
        input.command = {CommandKind::Measure, 0, 0, 0};
      } else if (in_phase_ > 600) {
        input.driver = Driver::Reverse;
      }
      return;
    case Phase::Choose:
      choose_screw(now, input);
      enter(Phase::Insert);
      return;
    case Phase::Insert:
      return insert(now, input);
    case Phase::Verify:
      if (shoot(input)) enter(Phase::Finish);
      return;
    case Phase::Finish:
      input.command = {CommandKind::Finish, 0, 0, 0};
      phase_ = Phase::Done;
      return;
    default:
      return;
  }
}

Input ScriptedTrainee::next(const Snapshot& now) {
  Input input;
  if (phase_ != Phase::Done) {
    ++total_;
    if (total_ > kMostTicks && phase_ != Phase::Finish) enter(Phase::Finish);
    think(now);
    if (wait_ > 0) {
      --wait_;
    } else {
      ++in_phase_;
      if (phase_ == Phase::GoToStandoff || phase_ == Phase::Approach) {
        hand_ = move_.at(++in_move_);
      }
      act(now, input);
    }
  }
  // Once the wire is in bone the hand rests on it; its tremor is held by the driver's guide.
  const bool is_held = now.wire.engaged;
  input.tip_in_patient = is_held ? now.tip_in_patient : hand_.tip + tremor_.next();
  input.shaft_in_patient = is_held ? now.shaft_in_patient : hand_.shaft;
  return input;
}

}  // namespace carpus::trainee
