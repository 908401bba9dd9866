// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "trainee/portal_maker.hpp"

#include <algorithm>
#include <cmath>

#include "cases/joint_under_block.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "instruments/instrument.hpp"
#include "simulation/asked_portals.hpp"

namespace carpus::trainee {
namespace {

using simulation::CommandKind;

constexpr double kOutsideMm = 14.0;
constexpr double kBeforeMm = 3.0;   // off the skin, where it is aimed
constexpr double kBeyondMm = 7.0;   // of the capsule a needle is not led on
constexpr double kInSightMm = 4.5;  // ... under vision
constexpr double kPressesMm = 2.0;  // with a fingertip
constexpr double kFeltApartMm = 2.5;
constexpr double kFeltS = 0.25;
constexpr double kOverSkinMmPerS = 15.0;
constexpr double kDeepestCutMm = 9.0;  // it is not led on
constexpr int kMostEntries = 3;
constexpr double kFollows = 0.02;  // of what a blade is off its depth, a tick
constexpr double kMostFollowMm = 0.01;
constexpr double kJustInMm = 1.5;
constexpr double kShortMm = 0.5;  // of the capsule a clamp is opened
constexpr double kOpenS = 0.8;
constexpr double kDrawsMmPerS = 20.0;
constexpr Tick kPullTicks = 2500;
constexpr Tick kLeastMoveTicks = 60;

Tick ticks_of(double s) { return static_cast<Tick>(std::max(0.0, s) / kTickSeconds); }

}  // namespace

PortalSkill portal_skill_of(Skill skill) noexcept {
  PortalSkill made;
  if (skill == Skill::Middle) {
    made = {50.0, 22.0, 6.0,  6.0, 0.1, 1.6, 7.0,  2,    5,  0.75,
            5.5,  1.0,  20.0, 2.2, 0.3, 0.1, 0.25, true, 1.2};
  } else if (skill == Skill::Novice) {
    made = {40.0, 16.0, 5.0,  8.0, 0.2, 3.2,  14.0, 1,     8,  0.85,
            8.0,  2.0,  45.0, 3.8, 0.0, 0.45, 0.4,  false, 0.0};
  }
  return made;
}

ScriptedPortalMaker::ScriptedPortalMaker(const cases::CaseData& data,
                                         const procedure::Procedure& procedure,
                                         Skill skill,
                                         std::uint64_t seed)
    : data_(data),
      procedure_(procedure),
      skill_(portal_skill_of(skill)),
      rng_(seed + 77),
      tremor_(skill_.tremor_mm, Rng(seed + 1)) {
  const procedure::Opening opening = procedure.opening(data);
  const auto asked = simulation::asked_portals(data, *procedure.making, seed);
  if (!asked) throw InvalidInput("making portals: this wrist has no second portal");
  asked_ = *asked;
  wrist_ = opening.wrist;
  wrist_.traction_n = skill_.traction_n;
  std::size_t target = 0;
  for (const cases::Bone& bone : data.bones) {
    if (bone.bone == procedure.target) target = poses_.size();
    poses_.push_back(cases::pose_under_block(data.hand_motion, bone.bone, wrist_));
  }
  hand_.tip = (poses_[target] * Point<frame::Bone>{opening.tip_in_target}).v;
  hand_.shaft = (poses_[target] * Direction<frame::Bone>{opening.shaft_in_target}).v;
  planned_ = hand_;
}

ScriptedPortalMaker::Portal ScriptedPortalMaker::portal_now(std::size_t which) const {
  const cases::ArthroscopicMap& map = *data_.arthroscopy;
  const cases::Portal& portal = map.portals[asked_[which]];
  const auto& pose = poses_[portal.body];
  Portal now{(pose * Point<frame::Bone>{portal.skin}).v,
             (pose * Direction<frame::Bone>{portal.inwards}).v,
             portal.capsule_mm,
             {}};
  now.landmark = now.skin;
  const procedure::PortalLandmark* declared = procedure::landmark_of(*procedure_.making, portal.id);
  if (declared == nullptr) return now;
  now.is_opened_first = declared->is_opened_first;
  for (const cases::FeltLandmark& mark : map.landmarks) {
    if (mark.id != declared->landmark) continue;
    // Over the bone, as far out as the skin is at the portal.
    now.landmark = (poses_[mark.body] * Point<frame::Bone>{mark.at}).v;
  }
  if (const cases::Portal* other = cases::find_portal(map, declared->landmark)) {
    now.landmark = (poses_[other->body] * Point<frame::Bone>{other->skin}).v;
  }
  return now;
}

Vec3 ScriptedPortalMaker::across(const Vec3& inwards) const {
  return normalized_or(cross(data_.arthroscopy->distal, inwards), {1, 0, 0});
}

void ScriptedPortalMaker::go(const HandPose& to, double mm_per_s, double dwell_s) {
  Task task;
  task.to = to;
  task.mm_per_s = mm_per_s;
  task.dwell = ticks_of(dwell_s);
  tasks_.push_back(task);
  planned_ = to;
}

void ScriptedPortalMaker::take(const char* id) {
  const auto index = instruments::instrument_of(id);
  if (!index) return;
  Task task;
  task.to = planned_;
  task.takes = true;
  task.instrument = *index;
  task.dwell = ticks_of(skill_.reaction_s);
  tasks_.push_back(task);
}

/// Pressed in, led about from place to place.
void ScriptedPortalMaker::feel(const Vec3& at, const Vec3& out) {
  const Vec3 along = normalized_or(
      data_.arthroscopy->distal - out * dot(data_.arthroscopy->distal, out), {1, 0, 0});
  const Vec3 aside = cross(out, along);
  go({at + out * kOutsideMm, out}, skill_.speed_mm_per_s);
  const double middle = (skill_.felt_across - 1) / 2.0;
  for (int i = 0; i < skill_.felt_across; ++i) {
    for (int j = 0; j < skill_.felt_across; ++j) {
      const Vec3 off =
          along * ((i - middle) * kFeltApartMm) + aside * ((j - middle) * kFeltApartMm);
      go({at + off - out * kPressesMm, out}, kOverSkinMmPerS, kFeltS);
    }
  }
  go({at + out * kOutsideMm, out}, skill_.speed_mm_per_s);
}

void ScriptedPortalMaker::plan_prick(bool is_first) {
  const double share = std::pow(skill_.learning, pricks_++);
  const Vec3 aside = across(at_.inwards);
  const Vec3 along = cross(at_.inwards, aside);
  const double off = skill_.place_error_mm * share;
  const double turn = radians_from_degrees(skill_.tilt_error_deg) * share;
  found_ = at_.skin + aside * (rng_.normal() * off) + along * (rng_.normal() * off);
  found_way_ = normalized_or(
      at_.inwards + aside * (rng_.normal() * turn) + along * (rng_.normal() * turn), at_.inwards);
  const Vec3 shaft = -found_way_;
  go({found_ + shaft * kOutsideMm, shaft}, skill_.speed_mm_per_s, is_first ? 0.3 : 0.0);
  go({found_ + shaft * kBeforeMm, shaft}, skill_.speed_mm_per_s, 0.2);
  const double beyond_mm = works_under_vision() ? kInSightMm : kBeyondMm;
  go({found_ + found_way_ * (at_.capsule_mm + beyond_mm), shaft}, skill_.in_mm_per_s,
     2 * skill_.reaction_s + 0.3);
  tasks_.back().until = Until::FluidBack;
  tasks_.back().is_prick = true;
  go({found_ + shaft * kOutsideMm, shaft}, kDrawsMmPerS);
}

void ScriptedPortalMaker::plan_portal() {
  at_ = portal_now(which_);
  skin_out_ = -at_.inwards;
  pricks_ = 0;
  const Vec3 out = -at_.inwards;
  if (which_ > 0) take("fingertip");
  feel(at_.landmark + out * (which_ == 0 ? 3.0 : 0.0), out);
  feel(at_.skin, out);
  found_ = at_.skin + across(at_.inwards) * (rng_.normal() * skill_.place_error_mm);
  found_way_ = at_.inwards;
  skips_needle_ = rng_.uniform() < skill_.skips;
  if (!skips_needle_ && !at_.is_opened_first) {
    take("needle_22g");
    plan_prick(true);
  }
  Task rest;
  rest.to = planned_;
  rest.plans = true;
  tasks_.push_back(rest);
}

/// By where the needle was, straight into the skin as it lies there.
void ScriptedPortalMaker::plan_cut() {
  const Vec3 out = skin_out_;
  const Vec3 distal = data_.arthroscopy->distal;
  const Vec3 flat = normalized_or(distal - out * dot(distal, out), distal);
  const Vec3 start = found_ - flat * (skill_.cut_mm / 2);
  cut_deep_mm_ = std::max(0.5, skill_.cut_deep_mm + rng_.normal() * skill_.cut_error_mm);
  take("blade_15");
  go({start + out * kOutsideMm, out}, skill_.speed_mm_per_s);
  go({start - out * kDeepestCutMm, out}, skill_.in_mm_per_s / 2);
  tasks_.back().until = Until::Deep;
  tasks_.back().cuts = true;
}

/// Along the skin as it lies there.
void ScriptedPortalMaker::lead_blade(const simulation::Snapshot& now) {
  const Vec3 out = now.skin.out_of_skin[works_];
  const Vec3 distal = data_.arthroscopy->distal;
  const Vec3 flat = normalized_or(distal - out * dot(distal, out), distal);
  const double turn = radians_from_degrees(skill_.cut_turn_deg) * rng_.normal();
  const Vec3 way = normalized_or(flat + cross(out, flat) * turn, flat);
  const double mm = std::max(2.5, skill_.cut_mm + rng_.normal() * skill_.cut_error_mm);
  planned_ = hand_;
  go({hand_.tip + way * mm, hand_.shaft}, skill_.in_mm_per_s, 0.2);
  tasks_.back().keeps_deep = true;
  go({planned_.tip + out * kOutsideMm, hand_.shaft}, kDrawsMmPerS);
  tasks_.back().looks = true;
}

/// By the cut, which anyone sees.
void ScriptedPortalMaker::plan_way_in(const simulation::Snapshot& now) {
  planned_ = hand_;
  entries_ = 0;
  if (now.skin.cut_count > 0) {
    const simulation::CutView& cut = now.skin.cuts[now.skin.cut_count - 1];
    found_ = (cut.from_in_patient + cut.to_in_patient) / 2.0;
  }
  cut_at_ = found_;
  const HandPose before{found_ - found_way_ * kOutsideMm, -found_way_};
  if (!(rng_.uniform() < skill_.skips)) {
    take("mosquito_clamp");
    go(before, skill_.speed_mm_per_s);
    const HandPose down{found_ + found_way_ * (at_.capsule_mm - kShortMm), -found_way_};
    go(down, skill_.in_mm_per_s, 0.2);
    go(down, skill_.in_mm_per_s, kOpenS);
    tasks_.back().opens = true;
    go(before, kDrawsMmPerS);
  }
  if (!skips_needle_ && at_.is_opened_first) {
    take("needle_22g");
    plan_prick(true);
    Task end;
    end.to = planned_;
    end.ends = true;
    tasks_.push_back(end);
    return;
  }
  plan_sheath_and_end();
}

/// By the cut, whatever the needle found beside it.
void ScriptedPortalMaker::plan_sheath_and_end() {
  if (at_.is_opened_first) found_ = cut_at_;
  take("scope_sheath_1_9");
  plan_sheath();
  Task last;
  last.to = planned_;
  last.finishes = true;
  tasks_.push_back(last);
}

void ScriptedPortalMaker::plan_sheath() {
  ++entries_;
  const HandPose before{found_ - found_way_ * kOutsideMm, -found_way_};
  go(before, skill_.speed_mm_per_s);
  go({found_ + found_way_ * (at_.capsule_mm + 2 * kBeyondMm), -found_way_}, skill_.through_mm_per_s,
     0.5);
  tasks_.back().until = Until::Made;
  tasks_.back().enters = true;
  go(before, kDrawsMmPerS);
}

bool ScriptedPortalMaker::is_reached(const Task& task, const simulation::Snapshot& now) const {
  switch (task.until) {
    case Until::There:
      return false;
    case Until::FluidBack:
      return now.skin.is_wet[works_];
    case Until::Deep:
      return now.skin.under_mm[works_] >= cut_deep_mm_ - skill_.foresees_mm;
    case Until::Made:
      return now.skin.facts.made > which_;
  }
  return false;
}

bool ScriptedPortalMaker::works_under_vision() const noexcept {
  return which_ > 0 && skill_.works_under_vision &&
         std::any_of(procedure_.tray.begin(), procedure_.tray.end(), [](const auto index) {
           return instruments::catalogue()[index].optic.has_value();
         });
}

simulation::Input ScriptedPortalMaker::next(const simulation::Snapshot& now) {
  simulation::Input input;
  input.wrist = wrist_;
  input.wrist.traction_n =
      skill_.traction_n *
      std::min(1.0, static_cast<double>(now.tick) / static_cast<double>(kPullTicks - 500));
  bool opens = false;
  if (now.tick >= kPullTicks && !is_finished_) {
    if (!has_planned_) {
      plan_portal();
      has_planned_ = true;
    }
    Task& task = tasks_.front();
    if (in_task_ == 0) {
      const double far = distance(hand_.tip, task.to.tip);
      move_ticks_ = std::max(kLeastMoveTicks,
                             task.mm_per_s > 0 ? ticks_of(far / task.mm_per_s) : kLeastMoveTicks);
      move_ = MinimumJerkMove(hand_, task.to, move_ticks_);
      reached_at_ = 0;
      if (task.takes) {
        input.command.kind = CommandKind::Take;
        input.command.hand = works_;
        input.command.index = task.instrument;
      }
    }
    ++in_task_;
    if (reached_at_ == 0 && is_reached(task, now)) reached_at_ = now.tick;
    // As the skin lies where it is touched or pricked: from farther off a hollow's side is nearer.
    const bool is_felt = now.skin.feels[works_].felt != simulation::Felt::Nothing;
    const double in_mm = now.skin.under_mm[works_];
    if (is_felt || (in_mm > 0.0 && in_mm < kJustInMm)) skin_out_ = now.skin.out_of_skin[works_];
    const bool reacts = reached_at_ > 0 && now.tick >= reached_at_ + ticks_of(skill_.reaction_s);
    if (!reacts) hand_ = move_.at(in_task_);
    opens = task.opens;
    if (task.keeps_deep) {
      const double off = now.skin.under_mm[works_] - cut_deep_mm_;
      lifted_mm_ += std::clamp(kFollows * off, -kMostFollowMm, kMostFollowMm);
    } else if (task.takes) {
      lifted_mm_ = 0.0;
    }
    // In sight it stays where it is until it was looked at.
    const double looks_s = task.is_prick && works_under_vision() ? skill_.looks_s : 0.0;
    const bool is_over = reacts ? now.tick >= reached_at_ + ticks_of(skill_.reaction_s + looks_s)
                                : in_task_ >= move_ticks_ + task.dwell;
    if (is_over) {
      const Task done = task;
      tasks_.pop_front();
      in_task_ = 0;
      if (done.is_prick && reached_at_ == 0 && pricks_ < skill_.tries) {
        std::deque<Task> rest;
        rest.swap(tasks_);
        const Task out = rest.front();
        rest.pop_front();
        tasks_.push_back(out);
        plan_prick(false);
        for (const Task& each : rest) tasks_.push_back(each);
      }
      if (done.cuts) {
        lead_blade(now);
      }
      if (done.looks) plan_way_in(now);
      if (done.ends) {
        planned_ = hand_;
        plan_sheath_and_end();
      }
      if (done.enters && now.skin.facts.made <= which_ && entries_ < kMostEntries) {
        std::deque<Task> rest;
        rest.swap(tasks_);
        tasks_.push_back(rest.front());  // out
        planned_ = rest.front().to;
        rest.pop_front();
        found_way_ = at_.inwards;  // as it was taught
        plan_sheath();
        for (const Task& each : rest) tasks_.push_back(each);
      }
      if (done.plans) {
        planned_ = hand_;
        plan_cut();
      } else if (done.finishes) {
        if (++which_ < procedure::kPortalsMade && now.skin.facts.made >= which_) {
          planned_ = hand_;
          plan_portal();
        } else {
          input.command.kind = CommandKind::Finish;
          is_finished_ = true;
        }
      }
    }
  }
  for (simulation::HandInput& hand : input.hands) {
    hand.tip_in_patient = hand_.tip;
    hand.shaft_in_patient = hand_.shaft;
  }
  simulation::HandInput& works = input.hands[works_];
  works.tip_in_patient += tremor_.next() + hand_.shaft * lifted_mm_;
  if (opens) works.driver = simulation::Driver::Forward;
  return input;
}

}  // namespace carpus::trainee
