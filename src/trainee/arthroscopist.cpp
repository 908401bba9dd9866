// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The whole way is planned when traction has opened the joint: for each place the scope's tip and
// turn from which it is seen with least movement, found by trying many.
#include "trainee/arthroscopist.hpp"

#include <algorithm>
#include <cmath>

#include "arthroscopy/make_map.hpp"
#include "arthroscopy/opened_space.hpp"
#include "cases/joint_under_block.hpp"
#include "core/error.hpp"
#include "fields/distance_field.hpp"

namespace carpus::trainee {
namespace {

using simulation::CommandKind;

constexpr std::uint8_t kLook = 0;  // portals, in the map's order
constexpr std::uint8_t kWork = 1;
constexpr double kOutsideMm = 12.0;
constexpr double kInsideMm = 2.0;    // beyond the capsule, to begin with
constexpr double kDeepestMm = 14.0;  // of the working depth [S81]
constexpr double kAcrossMm = 3.0;
constexpr double kBackMm = -2.5;     // so far from the capsule a scope has fallen out
constexpr double kBehindMm = 0.6;    // of the wall: so far its grid is off
constexpr double kSpareMm = 0.1;     // about the scope
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
    result = {50.0, 9.0, 0.1, 0.5, 10.0, 9.0, 1.3, 1, 0.06, 1.2, 2.5, 0.7};
  } else if (skill == Skill::Novice) {
    result = {40.0, 7.0, 0.2, 1.2, 22.0, 24.0, 1.05, 2, 0.2, 3.0, 6.0, 1.0};
  }
  return result;
}

ScriptedArthroscopist::ScriptedArthroscopist(const cases::CaseData& data,
                                             const procedure::Procedure& procedure,
                                             Skill skill,
                                             std::uint64_t seed)
    : data_(data),
      procedure_(procedure),
      map_([&]() -> const cases::ArthroscopicMap& {
        if (data.arthroscopy == nullptr) (void)procedure.opening(data);  // says why not
        if (data.arthroscopy == nullptr) throw InvalidInput("the case has no soft tissue");
        return *data.arthroscopy;
      }()),
      skill_(scope_skill_of(skill)),
      rng_(seed),
      tremor_(skill_.tremor_mm, Rng(seed + 1)),
      opening_(procedure.opening(data)) {
  const auto& optic = instruments::catalogue()[procedure.tray.front()].optic;
  lens_ = {optic->view_angle_deg, optic->field_deg};
  wrist_ = opening_.wrist;
  wrist_.traction_n = skill_.traction_n;
  for (const cases::Bone& bone : data.bones) {
    const bool is_near = belongs_to_forearm(bone.bone) || bone.bone == BoneId::Scaphoid ||
                         bone.bone == BoneId::Lunate || bone.bone == BoneId::Triquetrum;
    if (!is_near || bone.distance_field.values().empty()) continue;
    if (bone.bone == BoneId::Lunate) {
      row_from_patient_ = cases::pose_under_block(data.hand_motion, bone.bone, wrist_).inverse();
    }
    bones_.emplace_back(&bone,
                        cases::pose_under_block(data.hand_motion, bone.bone, wrist_).inverse());
  }
}

Vec3 ScriptedArthroscopist::error(double mm) {
  return {rng_.normal() * mm, rng_.normal() * mm, rng_.normal() * mm};
}

Vec3 ScriptedArthroscopist::in_portal(std::uint8_t portal, double beyond_capsule_mm) const {
  const cases::Portal& p = map_.portals[portal];
  return p.skin + p.inwards * (p.capsule_mm + beyond_capsule_mm);
}

HandPose ScriptedArthroscopist::through(std::uint8_t portal, const Vec3& tip) const {
  const cases::Portal& p = map_.portals[portal];
  const double deep = dot(tip - p.skin, p.inwards);
  return {tip, deep > 4.0 ? normalized_or(p.skin - tip, -p.inwards) : -p.inwards};
}

arthroscopy::OpenedSpace ScriptedArthroscopist::space_at(const Vec3& at) const {
  return arthroscopy::opened_space_at(map_.space, {}, row_from_patient_, at);
}

/// Between the pulled bones, and not behind the joint's wall.
bool ScriptedArthroscopist::has_room(const Vec3& at, double room_mm) const {
  const arthroscopy::OpenedSpace wall = space_at(at);
  if (!wall.is_near || wall.distance_mm > kBehindMm) return false;
  for (const auto& [bone, from_patient] : bones_) {
    const Vec3 local = (from_patient * Point<frame::Patient>{at}).v;
    const fields::DistanceSample s = fields::sample_distance(bone->distance_field, local);
    if (s.is_inside_grid && s.distance_mm < room_mm) return false;
  }
  return true;
}

/// Tip and shaft have room from the capsule on.
bool ScriptedArthroscopist::goes_in(const Vec3& tip, std::uint8_t portal, double radius_mm) const {
  const arthroscopy::OpenedSpace wall = space_at(tip);
  if (!wall.is_near || wall.distance_mm > 0.1) return false;
  const HandPose held = through(portal, tip);
  for (double s = 0; s < 12.0; s += 1.0) {
    const Vec3 at = tip + held.shaft * s;
    for (const auto& [bone, from_patient] : bones_) {
      const Vec3 local = (from_patient * Point<frame::Patient>{at}).v;
      const fields::DistanceSample d = fields::sample_distance(bone->distance_field, local);
      if (d.is_inside_grid && d.distance_mm < radius_mm) return false;
    }
  }
  return true;
}

bool ScriptedArthroscopist::is_free(const Vec3& from, const Vec3& to) const {
  const double far = distance(from, to);
  for (double s = 0.5; s < far - 0.8; s += 0.5) {
    if (!has_room(from + (to - from) * (s / far), 0.0)) return false;
  }
  return true;
}

/// Tries tips about the capsule's hole and turns of the shaft.
ScriptedArthroscopist::View ScriptedArthroscopist::view_of(const Vec3& point,
                                                           const Vec3& from) const {
  const cases::Portal& portal = map_.portals[kLook];
  const double scope_radius =
      instruments::catalogue()[procedure_.tray.front()].shape.greatest_radius_mm();
  const Vec3 across = normalized_or(cross(portal.inwards, map_.distal), {1, 0, 0});
  View best;
  double least = 1e9;
  for (double deep = 1.0; deep <= kDeepestMm; deep += 1.0) {
    for (double aside = -8.0; aside <= 8.0; aside += 1.0) {
      for (double up = -2.0; up <= 3.5; up += 0.5) {
        const Vec3 tip = in_portal(kLook, deep) + across * aside + map_.distal * up;
        const Vec3 eye = tip + through(kLook, tip).shaft * scope_radius;
        const double far = distance(eye, point);
        if (far < 2.0 || far > 13.0) continue;
        if (!goes_in(tip, kLook, scope_radius + kSpareMm) || !is_free(eye, point)) continue;
        const HandPose held = through(kLook, tip);
        for (double turn = -180.0; turn < 180.0; turn += 15.0) {
          const arthroscopy::Sight sight =
              arthroscopy::sight_of(lens_, {eye, held.shaft, turn, 0.0}, map_.distal);
          const double cosine = dot(point - eye, sight.axis) / far;
          if (cosine < sight.least_cosine + 0.08) continue;
          const double cost = 1.5 * distance(tip, from) + 6.0 * (1.0 - cosine) / 0.1 +
                              0.01 * std::abs(wrapped(turn - planned_turn_deg_)) + 0.5 * deep;
          if (cost >= least) continue;
          least = cost;
          best = {tip, turn, true};
        }
      }
    }
  }
  return best;
}

void ScriptedArthroscopist::go(std::uint8_t hand, const HandPose& to, double dwell_s) {
  Task task;
  task.hand = hand;
  task.to = to;
  task.shaft_turn_deg = planned_turn_deg_;
  task.dwell = ticks_of(dwell_s);
  tasks_.push_back(task);
  planned_[hand] = to.tip;
}

void ScriptedArthroscopist::look(const View& view) {
  planned_turn_deg_ = wrapped(view.turn_deg + rng_.normal() * skill_.turn_error_deg);
  // Not across what lies between: back to the middle of the way in, then in again.
  if (distance(view.tip, planned_[kLook]) > kAcrossMm) {
    go(0, through(kLook, in_portal(kLook, kInsideMm)), 0.0);
  }
  go(0, through(kLook, view.tip + error(skill_.aim_error_mm)), skill_.dwell_s);
  tasks_.back().turns = true;
}

void ScriptedArthroscopist::plan(const simulation::Snapshot&) {
  tilt_deg_ = rng_.normal() * skill_.tilt_deg;
  planned_[0] = hands_[0].tip;
  go(0, through(kLook, in_portal(kLook, -map_.portals[kLook].capsule_mm - kOutsideMm)),
     skill_.reaction_s);
  go(0, through(kLook, in_portal(kLook, kInsideMm)), skill_.reaction_s);
  Task take;
  take.hand = 1;
  take.takes_probe = true;
  take.to = through(kWork, in_portal(kWork, -map_.portals[kWork].capsule_mm - 60.0));
  take.dwell = ticks_of(0.5);
  tasks_.push_back(take);
  go(1, through(kWork, in_portal(kWork, -map_.portals[kWork].capsule_mm - kOutsideMm)),
     skill_.reaction_s);
  go(1, through(kWork, in_portal(kWork, kInsideMm)), skill_.reaction_s);
  for (const cases::TourPoint& point : map_.points) {
    for (int i = 0; i < skill_.wanderings; ++i) {
      look({planned_[0] + error(2.0), rng_.uniform(-180.0, 180.0), true});
      tasks_.back().dwell = ticks_of(0.4);
    }
    if (rng_.uniform(0.0, 1.0) < skill_.falls_out) {
      go(0, through(kLook, in_portal(kLook, kBackMm)), skill_.reaction_s);
      go(0, through(kLook, in_portal(kLook, kInsideMm)), skill_.reaction_s);
    }
    const View view = view_of(point.at, planned_[0]);
    if (view.is_found) look(view);
    if (!point.is_probed) continue;
    const Vec3 way_in = in_portal(kWork, kInsideMm);
    const Vec3 down =
        normalized_or(fields::sample_distance(map_.space, point.at).gradient, map_.distal);
    go(1, through(kWork, point.at + down * skill_.presses_mm), skill_.dwell_s);
    go(1, through(kWork, way_in), skill_.reaction_s);
  }
  // Once round, from two depths: what was planned for and missed may be found so.
  for (const double deep : {2.0, 4.0}) {
    for (double turn = -180.0; turn < 180.0; turn += 45.0)
      look({in_portal(kLook, deep), turn, true});
  }
  Task finish;
  finish.to = {planned_[0], {}};
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
  };
  if (!has_planned_) {
    hold();
    if (now.tick < kPullTicks) return input;
    plan(now);
    has_planned_ = true;
    in_task_ = 0;
    move_ticks_ = 0;
  }
  if (at_ >= tasks_.size()) {
    hold();
    return input;
  }
  const Task& task = tasks_[at_];
  if (in_task_ == 0) {
    const HandPose& from = hands_[task.hand];
    move_ticks_ = std::max(kLeastMoveTicks,
                           ticks_of(distance(from.tip, task.to.tip) / skill_.speed_mm_per_s));
    if (task.finishes) move_ticks_ = 1;
    move_ = MinimumJerkMove(from, task.finishes ? from : task.to, move_ticks_);
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
    input.command.index = procedure_.tray.back();
  } else if (task.finishes) {
    input.command.kind = CommandKind::Finish;
    is_finished_ = true;
  } else if (task.turns && now.tick % kTurnEvery == 0) {
    const double left = wrapped(task.shaft_turn_deg - turn_deg_);
    const double most = kTurnDegPerTick * static_cast<double>(kTurnEvery);
    if (std::abs(left) > 0.05) {
      turn_deg_ = wrapped(turn_deg_ + std::clamp(left, -most, most));
      input.command.kind = CommandKind::TurnScope;
      input.command.rotation_deg = turn_deg_;
      input.command.tilt_deg = tilt_deg_;
    }
  }
  const bool is_turned = !task.turns || std::abs(wrapped(task.shaft_turn_deg - turn_deg_)) < 0.1;
  if (!is_turned && in_task_ > move_ticks_) in_task_ = move_ticks_;  // the turn is waited for
  if (in_task_ >= move_ticks_ + task.dwell && is_turned) {
    ++at_;
    in_task_ = 0;
  }
  return input;
}

}  // namespace carpus::trainee
