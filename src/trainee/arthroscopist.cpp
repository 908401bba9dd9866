// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The whole way is planned when traction has opened the joint: for each place the scope's tip and
// turn from which it is seen with least movement, found by trying many.
#include "trainee/arthroscopist.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "arthroscopy/make_map.hpp"
#include "arthroscopy/opened_space.hpp"
#include "arthroscopy/pathology_table.hpp"
#include "cases/joint_under_block.hpp"
#include "core/error.hpp"
#include "fields/distance_field.hpp"
#include "simulation/questions.hpp"

namespace carpus::trainee {
namespace {

using simulation::CommandKind;

constexpr std::uint8_t kScope = 0;  // hands
constexpr std::uint8_t kProbe = 1;
constexpr double kOutsideMm = 12.0;
constexpr double kInsideMm = 2.0;    // beyond the capsule, to begin with
constexpr double kDeepestMm = 14.0;  // of the working depth [S81]
constexpr double kAcrossMm = 3.0;
constexpr double kBackMm = -2.5;         // so far from the capsule a scope has fallen out
constexpr double kBehindMm = 0.6;        // of the wall: so far its grid is off
constexpr double kInFieldCosine = 0.08;  // more than half the field's: not at its rim
constexpr double kTurnStepDeg = 15.0;
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

/// The hole in the skin where it is now.
HandPose ScriptedArthroscopist::hole(std::uint8_t portal) const {
  const cases::Portal& p = map_.portals[portal];
  return {(poses_[p.body] * Point<frame::Bone>{p.skin}).v,
          -(poses_[p.body] * Direction<frame::Bone>{p.inwards}).v};
}

Vec3 ScriptedArthroscopist::place_of(std::size_t point) const { return moved(map_.points[point]); }

Vec3 ScriptedArthroscopist::moved(const cases::TourPoint& point) const {
  return (poses_[point.body] * Point<frame::Bone>{point.at}).v;
}

Vec3 ScriptedArthroscopist::in_portal(std::uint8_t portal, double beyond_capsule_mm) const {
  const HandPose at = hole(portal);
  return at.tip - at.shaft * (map_.portals[portal].capsule_mm + beyond_capsule_mm);
}

HandPose ScriptedArthroscopist::through(std::uint8_t portal, const Vec3& tip) const {
  const HandPose at = hole(portal);
  const double deep = -dot(tip - at.tip, at.shaft);
  return {tip, deep > 4.0 ? normalized_or(at.tip - tip, at.shaft) : at.shaft};
}

arthroscopy::OpenedSpace ScriptedArthroscopist::space_at(std::uint8_t joint, const Vec3& at) const {
  const cases::JointSpace& space = map_.joints[joint];
  return arthroscopy::opened_space_at(space.wall, poses_[space.proximal].inverse(),
                                      poses_[space.distal].inverse(), at);
}

/// Between the pulled bones, and not behind the joint's wall.
bool ScriptedArthroscopist::has_room(std::uint8_t joint, const Vec3& at, double room_mm) const {
  const arthroscopy::OpenedSpace wall = space_at(joint, at);
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
  const arthroscopy::OpenedSpace wall = space_at(map_.portals[portal].joint, tip);
  if (!wall.is_near || wall.distance_mm > 0.1) return false;
  const HandPose held = through(portal, tip);
  for (double s = 0; s < 12.0; s += 1.0) {
    const Vec3 at = tip + held.shaft * s;
    if (is_in_metal(at, radius_mm)) return false;
    for (const auto& [bone, from_patient] : bones_) {
      const Vec3 local = (from_patient * Point<frame::Patient>{at}).v;
      const fields::DistanceSample d = fields::sample_distance(bone->distance_field, local);
      if (d.is_inside_grid && d.distance_mm < radius_mm) return false;
    }
  }
  return true;
}

bool ScriptedArthroscopist::is_in_metal(const Vec3& at, double radius_mm) const {
  if (lesions_ == nullptr || !lesions_->screw) return false;
  const Vec3 local = (poses_[lesions_->screw->body].inverse() * Point<frame::Patient>{at}).v;
  return cases::in_screw(*lesions_->screw, local, radius_mm).depth_mm > 0;
}

bool ScriptedArthroscopist::is_free(std::uint8_t joint, const Vec3& from, const Vec3& to) const {
  const double far = distance(from, to);
  for (double s = 0.5; s < far - 0.8; s += 0.5) {
    if (!has_room(joint, from + (to - from) * (s / far), 0.0)) return false;
  }
  return true;
}

/// Well within the round picture.
ScriptedArthroscopist::View ScriptedArthroscopist::view_of(std::uint8_t portal,
                                                           const Vec3& point,
                                                           const Vec3& from) const {
  const double half_field = arthroscopy::cos_sin_deg(lens_.field_deg / 2)[0];
  return view_of(portal, {&point, 1}, from, half_field + kInFieldCosine, kTurnStepDeg);
}

/// Tries tips about the capsule's hole and turns of the shaft.
ScriptedArthroscopist::View ScriptedArthroscopist::view_of(std::uint8_t portal,
                                                           std::span<const Vec3> places,
                                                           const Vec3& from,
                                                           double least_cosine,
                                                           double turn_step_deg) const {
  const std::uint8_t joint = map_.portals[portal].joint;
  const Vec3 inwards = -hole(portal).shaft;
  const double scope_radius =
      instruments::catalogue()[procedure_.tray.front()].shape.greatest_radius_mm();
  const Vec3 across = normalized_or(cross(inwards, map_.distal), {1, 0, 0});
  View best;
  double least = 1e9;
  for (double deep = 1.0; deep <= kDeepestMm; deep += 1.0) {
    for (double aside = -8.0; aside <= 8.0; aside += 1.0) {
      for (double up = -2.0; up <= 3.5; up += 0.5) {
        const Vec3 tip = in_portal(portal, deep) + across * aside + map_.distal * up;
        const HandPose held = through(portal, tip);
        const Vec3 eye = tip + held.shaft * scope_radius;
        const double way = 1.5 * distance(tip, from) + 0.5 * deep;
        if (way >= least) continue;
        const bool is_near = std::all_of(places.begin(), places.end(), [&](const Vec3& place) {
          const double far = distance(eye, place);
          return far >= 2.0 && far <= 13.0;
        });
        if (!is_near || !goes_in(tip, portal, scope_radius + kSpareMm)) continue;
        const bool are_seen = std::all_of(places.begin(), places.end(), [&](const Vec3& place) {
          return is_free(joint, eye, place);
        });
        if (!are_seen) continue;
        for (double turn = -180.0; turn < 180.0; turn += turn_step_deg) {
          const arthroscopy::Sight sight =
              arthroscopy::sight_of(lens_, {eye, held.shaft, turn, 0.0}, map_.distal);
          double cosine = 1.0;
          for (const Vec3& place : places) {
            cosine = std::min(cosine, dot(place - eye, sight.axis) / distance(place, eye));
          }
          if (cosine < least_cosine) continue;
          const double cost =
              way + 6.0 * (1.0 - cosine) / 0.1 + 0.01 * std::abs(wrapped(turn - planned_turn_deg_));
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

/// Each point is looked at by the first of its portals that shows it; portals in the map's order.
std::vector<ScriptedArthroscopist::Stop> ScriptedArthroscopist::stops() const {
  std::vector<Stop> all(map_.portals.size());
  for (std::size_t i = 0; i < map_.points.size(); ++i) {
    for (const std::uint8_t portal : map_.points[i].by) {
      if (!view_of(portal, place_of(i), in_portal(portal, kInsideMm)).is_found) continue;
      all[portal].points.push_back(i);
      all[portal].is_probing = all[portal].is_probing || map_.points[i].is_probed;
      break;
    }
  }
  std::vector<Stop> used;
  for (std::uint8_t portal = 0; portal < all.size(); ++portal) {
    if (all[portal].points.empty()) continue;
    all[portal].look = portal;
    all[portal].work = work_portal(portal);
    used.push_back(std::move(all[portal]));
  }
  return used;
}

/// The tour's next portal into the same joint; its own where there is no other.
std::uint8_t ScriptedArthroscopist::work_portal(std::uint8_t look) const {
  const auto count = static_cast<std::uint8_t>(map_.portals.size());
  for (std::uint8_t by = 1; by < count; ++by) {
    const auto other = static_cast<std::uint8_t>((look + by) % count);
    const cases::Portal& portal = map_.portals[other];
    if (portal.is_usual && portal.joint == map_.portals[look].joint) return other;
  }
  return look;
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

void ScriptedArthroscopist::look_at(const Stop& stop, const Vec3& place) {
  for (int i = 0; i < skill_.wanderings; ++i) {
    look(stop.look, {planned_[kScope] + error(2.0), rng_.uniform(-180.0, 180.0), true});
    tasks_.back().dwell = ticks_of(0.4);
  }
  if (rng_.uniform(0.0, 1.0) < skill_.falls_out) {
    go(kScope, through(stop.look, in_portal(stop.look, kBackMm)), skill_.reaction_s);
    go(kScope, through(stop.look, in_portal(stop.look, kInsideMm)), skill_.reaction_s);
  }
  const View view = view_of(stop.look, place, planned_[kScope]);
  if (view.is_found) look(stop.look, view);
}

void ScriptedArthroscopist::probe(const Stop& stop, const Vec3& at) {
  const Vec3 down =
      normalized_or(space_at(map_.portals[stop.look].joint, at).outwards, map_.distal);
  go(kProbe, through(stop.work, at + down * skill_.presses_mm), skill_.dwell_s);
  go(kProbe, through(stop.work, in_portal(stop.work, kInsideMm)), skill_.reaction_s);
}

/// Once round, from two depths: what was planned for and missed may be found so.
void ScriptedArthroscopist::look_round(const Stop& stop) {
  for (const double deep : {2.0, 4.0}) {
    for (double turn = -180.0; turn < 180.0; turn += 45.0) {
      look(stop.look, {in_portal(stop.look, deep), turn, true});
    }
  }
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
  const double half_field = arthroscopy::cos_sin_deg(lens_.field_deg / 2)[0];
  View view =
      view_of(watch.portal, places, planned_[kScope], half_field + kInFieldCosine, kTurnStepDeg);
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

void ScriptedArthroscopist::plan_tour() {
  std::uint8_t looked_round = 0;  // joints
  bool has_probe = false;
  for (const Stop& stop : stops()) {
    // The probe leaves a portal that the scope needs.
    if (in_[kProbe] != procedure::kNoBody) draw_out(kProbe);
    enter(kScope, stop.look);
    if (stop.is_probing && stop.work != stop.look) {
      if (!has_probe) {
        take_probe(stop.work);
        has_probe = true;
      }
      enter(kProbe, stop.work);
    }
    for (const std::size_t point : stop.points) {
      look_at(stop, place_of(point));
      if (map_.points[point].is_probed && in_[kProbe] == stop.work) probe(stop, place_of(point));
    }
    const auto joint_bit = static_cast<std::uint8_t>(1U << map_.portals[stop.look].joint);
    if ((looked_round & joint_bit) == 0) look_round(stop);
    looked_round = static_cast<std::uint8_t>(looked_round | joint_bit);
  }
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

/// One finding a tick.
void ScriptedArthroscopist::answer(const simulation::Snapshot& now, simulation::Input& input) {
  if (answered_ >= asked_->findings.size()) return;
  const std::uint32_t seen = now.scope.lesions_seen;
  const std::uint8_t grade =
      procedure_.examines ? judged(answered_, seen) : judged_of_screw(answered_, seen);
  said_[answered_] = grade;
  input.command.kind = CommandKind::Answer;
  input.command.index = simulation::answer_index(answered_, grade);
  ++answered_;
}

/// What is named of what came into view; what did not is taken for well.
std::uint8_t ScriptedArthroscopist::judged(std::size_t finding, std::uint32_t lesions_seen) {
  const auto grades = arthroscopy::PathologyTable::generic().scale_of(finding).grades.size();
  const auto some = static_cast<std::uint8_t>(1 + rng_.below(grades - 1));
  const double chance = rng_.uniform(0.0, 1.0);
  const double exact = rng_.uniform(0.0, 1.0);
  if (rng_.uniform(0.0, 1.0) < skill_.says_nothing) return simulation::kNoGrade;
  const std::uint8_t truth = lesions_ != nullptr ? lesions_->grades[finding] : std::uint8_t{0};
  bool is_seen = false;
  for (std::size_t i = 0; truth != 0 && i < lesions_->lesions.size(); ++i) {
    const bool is_of_it = lesions_->lesions[i].finding == finding;
    is_seen = is_seen || (is_of_it && (lesions_seen >> i & 1U) != 0);
  }
  if (!is_seen) return chance < skill_.invents ? some : std::uint8_t{0};
  if (chance >= skill_.recognises) return 0;
  if (exact < skill_.grades_right) return truth;
  // The grade beside it.
  if (truth + 1U < grades && (truth == 1 || exact > 0.5 * (1.0 + skill_.grades_right))) {
    return static_cast<std::uint8_t>(truth + 1);
  }
  return truth > 1 ? static_cast<std::uint8_t>(truth - 1) : truth;
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
