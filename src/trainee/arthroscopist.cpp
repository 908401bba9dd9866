// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The whole way is planned when traction has opened the joint, and gone task by task.
#include "trainee/arthroscopist.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cases/joint_under_block.hpp"
#include "core/error.hpp"
#include "simulation/questions.hpp"

namespace carpus::trainee {
namespace {

using simulation::CommandKind;

constexpr std::uint8_t kScope = 0;  // hands
constexpr std::uint8_t kProbe = 1;
constexpr double kOutsideMm = 12.0;
constexpr double kInsideMm = 2.0;  // beyond the capsule, to begin with
constexpr double kAcrossMm = 3.0;
constexpr double kGivesWay = 0.004;  // of what is pressed, a tick
constexpr Tick kPullTicks = 2500;
constexpr Tick kLeastMoveTicks = 150;
constexpr double kTurnDegPerTick = 0.12;
constexpr Tick kTurnEvery = 10;

double wrapped(double deg) { return deg > 180 ? deg - 360 : (deg < -180 ? deg + 360 : deg); }

Tick ticks_of(double s) { return static_cast<Tick>(std::max(0.0, s) / kTickSeconds); }

}  // namespace

bool is_arthroscopy(const procedure::Procedure& procedure) {
  return !procedure.tray.empty() &&
         instruments::catalogue()[procedure.tray.front()].optic.has_value();
}

ScopeSkill scope_skill_of(Skill skill) noexcept {
  ScopeSkill result;
  if (skill == Skill::Middle) {
    result = {50.0, 9.0,  0.1,  0.5,  10.0, 9.0, 1.3, 1,   0.06, 1.2, 2.5,
              0.7,  0.82, 0.65, 0.07, 0.05, 3,   0.3, 5.5, 0.8,  0.7, 0.3};
  } else if (skill == Skill::Novice) {
    result = {40.0, 7.0, 0.2, 1.2,  22.0, 24.0, 1.05, 2,   0.2, 3.0, 6.0,
              1.0,  0.6, 0.4, 0.14, 0.15, 4,    0.6,  9.0, 0.3, 0.3, 0.8};
  }
  return result;
}

ScriptedArthroscopist::ScriptedArthroscopist(const cases::CaseData& data,
                                             const procedure::Procedure& procedure,
                                             Skill skill,
                                             std::uint64_t seed,
                                             const cases::ArthroscopicMap* map)
    : data_(data),
      procedure_(procedure),
      map_([&]() -> const cases::ArthroscopicMap& {
        if (map != nullptr) return *map;
        if (data.arthroscopy == nullptr) (void)procedure.opening(data);  // says why not
        if (data.arthroscopy == nullptr) throw InvalidInput("the case has no soft tissue");
        return *data.arthroscopy;
      }()),
      skill_(scope_skill_of(skill)),
      rng_(seed),
      tremor_(skill_.tremor_mm, Rng(seed + 1)),
      opening_(procedure.opening(data)),
      asked_(simulation::questions_of(procedure)),
      tool_(procedure.tray.back()) {
  for (const instruments::InstrumentIndex each : procedure.tray) {
    if (procedure.shaving && instruments::catalogue()[each].bite) punch_ = tool_ = each;
  }
  const auto& optic = instruments::catalogue()[procedure.tray.front()].optic;
  lens_ = {optic->view_angle_deg, optic->field_deg};
  wrist_ = opening_.wrist;
  wrist_.traction_n = skill_.traction_n;
  for (const cases::Bone& bone : data.bones) {
    poses_.push_back(cases::pose_under_block(data.hand_motion, bone.bone, wrist_));
    const bool bounds_joint = bone.bone <= BoneId::Hamate && bone.bone != BoneId::Pisiform;
    if (!bounds_joint || bone.distance_field.values().empty()) continue;
    bones_.emplace_back(&bone, poses_.back().inverse());
  }
}

Vec3 ScriptedArthroscopist::error(double mm) {
  return {rng_.normal() * mm, rng_.normal() * mm, rng_.normal() * mm};
}

void ScriptedArthroscopist::go(std::uint8_t hand, const HandPose& to, double dwell_s) {
  Task task;
  task.hand = hand;
  task.to = to;
  task.shaft_turn_deg = planned_turn_deg_;
  task.camera_turn_deg = tilt_deg_;
  task.dwell = ticks_of(dwell_s);
  tasks_.push_back(task);
  planned_[hand] = to.tip;
}

void ScriptedArthroscopist::look(std::uint8_t portal, const View& view, double error_share) {
  planned_turn_deg_ = wrapped(view.turn_deg + rng_.normal() * skill_.turn_error_deg * error_share);
  // Not across what lies between: back to the middle of the way in, then in again.
  if (distance(view.tip, planned_[kScope]) > kAcrossMm) {
    go(kScope, through(portal, in_portal(portal, kInsideMm)), 0.0);
  }
  go(kScope, through(portal, view.tip + error(skill_.aim_error_mm)), skill_.dwell_s);
  tasks_.back().turns = true;
}

void ScriptedArthroscopist::draw_out(std::uint8_t hand) {
  const std::uint8_t portal = in_[hand];
  if (portal == procedure::kNoBody) return;
  go(hand, through(portal, in_portal(portal, kInsideMm)), 0.0);  // to the hole first
  go(hand, through(portal, in_portal(portal, -map_.portals[portal].capsule_mm - kOutsideMm)),
     skill_.reaction_s);
  in_[hand] = procedure::kNoBody;
}

void ScriptedArthroscopist::enter(std::uint8_t hand, std::uint8_t portal) {
  if (in_[hand] == portal) return;
  draw_out(hand);
  go(hand, through(portal, in_portal(portal, -map_.portals[portal].capsule_mm - kOutsideMm)),
     skill_.reaction_s);
  go(hand, through(portal, in_portal(portal, kInsideMm)), skill_.reaction_s);
  in_[hand] = portal;
}

void ScriptedArthroscopist::watches_first(std::uint8_t portal,
                                          std::vector<cases::TourPoint> places) {
  watch_ = Watch{portal, std::move(places)};
}

/// All of them at once; from where they are not seen so, the last of them.
void ScriptedArthroscopist::plan_watch(const Watch& watch) {
  enter(kScope, watch.portal);
  std::vector<Vec3> places;
  for (const cases::TourPoint& place : watch.places) places.push_back(moved(place));
  View view = view_of(watch.portal, places, planned_[kScope]);
  if (!view.is_found) view = view_of(watch.portal, places.back(), planned_[kScope]);
  if (view.is_found) look(watch.portal, view);
}

void ScriptedArthroscopist::goes_on() noexcept {
  watch_.reset();
  has_planned_ = false;
}

void ScriptedArthroscopist::plan() {
  tilt_deg_ = rng_.normal() * skill_.tilt_deg;
  planned_[kScope] = hands_[kScope].tip;
  if (watch_) {
    plan_watch(*watch_);
    return;
  }
  if (procedure_.drill) {
    plan_drill(*procedure_.drill);
  } else if (procedure_.removal) {
    plan_removal();
  } else if (procedure_.shaving) {
    plan_shaving();
  } else if (procedure_.controls_screw) {
    plan_screw_control();
  } else {
    plan_tour();
  }
  plan_finish();
}

/// In the other hand, well outside of where it will go in.
void ScriptedArthroscopist::take_probe(std::uint8_t portal) {
  Task take;
  take.hand = kProbe;
  take.takes_probe = true;
  take.takes = tool_;
  if (tool_ == punch_) take.jaws = Jaws::Closed;  // so it goes in
  take.to = through(portal, in_portal(portal, -map_.portals[portal].capsule_mm - 60.0));
  take.dwell = ticks_of(0.5);
  tasks_.push_back(take);
}

void ScriptedArthroscopist::plan_finish() {
  if (asked_ != nullptr) {
    Task report;
    report.to = {planned_[kScope], hands_[kScope].shaft};
    report.answers = true;
    tasks_.push_back(report);
  }
  Task finish;
  finish.to = {planned_[kScope], {}};
  finish.finishes = true;
  tasks_.push_back(finish);
}

void ScriptedArthroscopist::begin(const simulation::Snapshot& now) {
  for (std::size_t h = 0; h < simulation::kHands; ++h) {
    const std::uint8_t item = now.hands[h].item;
    hands_[h] = item < simulation::kMaxItems
                    ? HandPose{now.items[item].tip_in_patient, now.items[item].shaft_in_patient}
                    : HandPose{opening_.tip_in_target, opening_.shaft_in_target};
  }
}

/// Where bone or wall holds an instrument back, the hand follows after it.
void ScriptedArthroscopist::give_way(const simulation::Snapshot& now) {
  for (std::size_t h = 0; h < simulation::kHands; ++h) {
    const std::uint8_t item = now.hands[h].item;
    const bool is_pressed = length(now.hands[h].force_in_patient) > skill_.yields_n;
    Vec3& given = given_[h];
    if (item < simulation::kMaxItems && is_pressed) {
      given += (now.items[item].tip_in_patient - hands_[h].tip - given) * kGivesWay * 5.0;
    } else {
      given = given * (1.0 - kGivesWay);
    }
  }
}

simulation::Input ScriptedArthroscopist::next(const simulation::Snapshot& now) {
  simulation::Input input;
  if (!has_begun_) begin(now);
  has_begun_ = true;
  input.wrist = wrist_;
  input.c_arm = now.c_arm;
  const auto hold = [&] {
    for (std::size_t h = 0; h < simulation::kHands; ++h) {
      input.hands[h].tip_in_patient = hands_[h].tip + given_[h];
      input.hands[h].shaft_in_patient = hands_[h].shaft;
    }
    input.hands[0].tip_in_patient += tremor_.next();
    using simulation::Driver;
    if (procedure_.removal) {
      input.hands[kProbe].driver = are_closed_ ? Driver::Forward : Driver::Reverse;
    } else if (procedure_.shaving && in_hand_ == punch_ && punch_ != instruments::kNoInstrument) {
      input.hands[kProbe].driver = are_closed_ ? Driver::Forward : Driver::Reverse;
    } else if (procedure_.shaving) {
      // In the way in only a hasty foot presses.
      const bool may = now.scope.facts.is_in_joint[kProbe] || skill_.hasty > 0.5;
      input.hands[kProbe].driver = are_closed_ && may ? Driver::Forward : Driver::Off;
    }
  };
  if (!has_planned_) {
    hold();
    if (now.tick < kPullTicks) return input;
    plan();
    has_planned_ = true;
    in_task_ = 0;
    move_ticks_ = 0;
  }
  if (at_ >= tasks_.size()) {
    hold();
    return input;
  }
  while (in_task_ == 0 && is_reached(tasks_[at_], now.scope.facts)) ++at_;
  while (in_task_ == 0 && tasks_[at_].seeks) seek(now);
  const Task& task = tasks_[at_];
  if (in_task_ == 0) {
    if (task.jaws != Jaws::AsTheyAre) are_closed_ = task.jaws == Jaws::Closed;
    const HandPose& from = hands_[task.hand];
    const double speed = task.speed_mm_per_s > 0 ? task.speed_mm_per_s : skill_.speed_mm_per_s;
    move_ticks_ = std::max(kLeastMoveTicks, ticks_of(distance(from.tip, task.to.tip) / speed));
    const bool stays = task.finishes || task.answers;
    if (stays) move_ticks_ = 1;
    move_ = MinimumJerkMove(from, stays ? from : task.to, move_ticks_);
    if (task.takes_probe) {
      hands_[task.hand] = task.to;
      move_ = MinimumJerkMove(task.to, task.to, 1);
      move_ticks_ = 1;
    }
  }
  ++in_task_;
  hands_[task.hand] = move_.at(in_task_);
  give_way(now);
  hold();
  if (task.takes_probe && in_task_ == 1) {
    input.command.kind = CommandKind::Take;
    input.command.hand = task.hand;
    input.command.index = task.takes;
    in_hand_ = task.takes;
  } else if (task.answers) {
    answer(now, input);
    if (answered_ < asked_->findings.size()) return input;
  } else if (task.finishes) {
    input.command.kind = CommandKind::Finish;
    is_finished_ = true;
  } else if (task.turns_mouth && in_task_ == 1) {
    input.command.kind = CommandKind::TurnMouth;
    input.command.hand = task.hand;
    input.command.rotation_deg = wrapped(task.mouth_deg);
  } else if (task.inflow_steps >= 0 && in_task_ == 1) {
    input.command.kind = CommandKind::SetFluid;
    input.command.index = simulation::fluid_index(procedure::FluidControl::Inflow,
                                                  static_cast<std::uint8_t>(task.inflow_steps));
  } else if (task.turns && now.tick % kTurnEvery == 0) {
    const double left = wrapped(task.shaft_turn_deg - turn_deg_);
    const double most = kTurnDegPerTick * static_cast<double>(kTurnEvery);
    if (std::abs(left) > 0.05) {
      turn_deg_ = wrapped(turn_deg_ + std::clamp(left, -most, most));
      input.command.kind = CommandKind::TurnScope;
      input.command.rotation_deg = turn_deg_;
      input.command.tilt_deg = task.camera_turn_deg;
    }
  }
  const bool is_turned = !task.turns || std::abs(wrapped(task.shaft_turn_deg - turn_deg_)) < 0.1;
  if (!is_turned && in_task_ > move_ticks_) in_task_ = move_ticks_;  // the turn is waited for
  const bool is_cut =
      task.until_gone >= 0 && now.scope.pieces_left[static_cast<std::size_t>(task.until_gone)] == 0;
  if (is_cut || (in_task_ >= move_ticks_ + task.dwell && is_turned)) {
    ++at_;
    in_task_ = 0;
  }
  return input;
}

}  // namespace carpus::trainee
