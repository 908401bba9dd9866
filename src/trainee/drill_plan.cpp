// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a scripted arthroscopist goes through the exercises (procedure::ScopeDrill): each is tried as
// often as its skill allows, and let be once it is done.
#include <algorithm>
#include <array>
#include <cmath>

#include "trainee/arthroscopist.hpp"

namespace carpus::trainee {
namespace {

constexpr std::uint8_t kScope = 0;  // hands
constexpr std::uint8_t kProbe = 1;
constexpr std::uint8_t kFirstPortal = 0;
constexpr double kInsideMm = 2.0;
constexpr double kBeforeSkinMm = 6.0;
constexpr double kFineTurnDeg = 5.0;
constexpr double kMiddleShare = 0.7;  // of what counts as the middle
constexpr double kSeenDeg = 28.0;     // off the line of sight the probe is still well seen
constexpr double kHoldSpareS = 0.8;
constexpr double kUsefulMm = 13.0;
constexpr double kRoundStepDeg = 30.0;
constexpr double kRoundDwellS = 0.45;
constexpr double kAboveMm = 1.2;  // a place, before and after it is touched
constexpr double kLineStepMm = 0.8;
constexpr std::size_t kPieceSteps = 5;  // of the line, looked at at a time
constexpr double kRimDeg = 4.0;         // within the picture's rim
constexpr double kLinePress = 0.8;      // of what the probe presses otherwise

double cosine_of(double deg) { return arthroscopy::cos_sin_deg(deg)[0]; }

}  // namespace

std::size_t ScriptedArthroscopist::point_of(std::uint8_t number) const {
  std::size_t at = 0;
  while (at + 1 < map_.points.size() && map_.points[at].number != number) ++at;
  return at;
}

void ScriptedArthroscopist::mark_since(std::size_t first, DrillGoal goal, std::size_t count) {
  for (std::size_t i = first; i < tasks_.size(); ++i) {
    tasks_[i].goal = goal;
    tasks_[i].count = static_cast<std::uint8_t>(count);
  }
}

bool ScriptedArthroscopist::is_reached(const Task& task, const procedure::ScopeFacts& facts) const {
  const procedure::DrillFacts& done = facts.drill;
  switch (task.goal) {
    case DrillGoal::None:
      return false;
    case DrillGoal::In:
      return facts.is_in_joint[task.hand];
    case DrillGoal::Hold:
      return done.held >= task.count;
    case DrillGoal::Round:
      return done.is_round_done;
    case DrillGoal::Touch:
      return done.touched >= task.count;
    case DrillGoal::Line:
      return done.is_line_done;
  }
  return false;
}

/// Of the camera head, for which the picture is most level.
double ScriptedArthroscopist::level_turn_deg(const HandPose& held, double shaft_turn_deg) const {
  double best = 0;
  double most = -2;
  for (double deg = -40.0; deg <= 40.0; deg += 2.0) {
    const arthroscopy::Sight sight =
        arthroscopy::sight_of(lens_, {held.tip, held.shaft, shaft_turn_deg, deg}, map_.distal);
    const double level = arthroscopy::horizon_cosine(sight, map_.distal);
    if (level <= most) continue;
    most = level;
    best = deg;
  }
  return best;
}

/// Places are brought into view, and the picture level: what is off is seen, so that each try is
/// half as far off as the one before.
bool ScriptedArthroscopist::watch(const Stop& stop,
                                  std::span<const Vec3> places,
                                  double least_cosine,
                                  int turn) {
  const View view = view_of(stop.look, places, planned_[kScope], least_cosine, kFineTurnDeg);
  if (!view.is_found) return false;
  look(stop.look, view, std::ldexp(1.0, -turn));
  tasks_.back().camera_turn_deg =
      level_turn_deg(tasks_.back().to, planned_turn_deg_) + std::ldexp(tilt_deg_, -turn);
  return true;
}

void ScriptedArthroscopist::plan_drill(const procedure::ScopeDrill& drill) {
  Stop stop;
  stop.look = kFirstPortal;
  stop.work = work_portal(kFirstPortal);
  go_in(kScope, stop.look);
  plan_holds(drill, stop);
  plan_round(drill, stop);
  take_probe(stop.work);
  const Vec3 first = place_of(point_of(drill.touch.front()));
  watch(stop, {&first, 1}, cosine_of(kSeenDeg), 0);
  go_in(kProbe, stop.work);
  plan_touches(drill, stop);
  plan_line(drill, stop);
}

/// Tried until it is in: a way missed is felt at once.
void ScriptedArthroscopist::go_in(std::uint8_t hand, std::uint8_t portal) {
  enter(hand, portal);
  const std::size_t first = tasks_.size();
  for (int turn = 1; turn < skill_.tries; ++turn) {
    const Vec3 before = in_portal(portal, -map_.portals[portal].capsule_mm - kBeforeSkinMm);
    go(hand, through(portal, before + error(skill_.aim_error_mm)), skill_.reaction_s);
    go(hand, through(portal, in_portal(portal, kInsideMm)), skill_.reaction_s);
  }
  mark_since(first, DrillGoal::In, 1);
}

void ScriptedArthroscopist::plan_holds(const procedure::ScopeDrill& drill, const Stop& stop) {
  for (std::size_t i = 0; i < drill.hold.size(); ++i) {
    const std::size_t first = tasks_.size();
    const Vec3 place = place_of(point_of(drill.hold[i]));
    for (int turn = 0; turn < skill_.tries; ++turn) {
      if (!watch(stop, {&place, 1}, cosine_of(kMiddleShare * drill.middle_deg), turn)) break;
      tasks_.back().dwell = static_cast<Tick>((drill.hold_s + kHoldSpareS) / kTickSeconds);
    }
    mark_since(first, DrillGoal::Hold, i + 1);
  }
}

/// From where most places can be seen by turning alone.
Vec3 ScriptedArthroscopist::place_to_look_round(std::uint8_t portal) const {
  const std::uint8_t joint = map_.portals[portal].joint;
  const double radius =
      instruments::catalogue()[procedure_.tray.front()].shape.greatest_radius_mm();
  const double widest = cosine_of(lens_.view_angle_deg + lens_.field_deg / 2 - 4.0);
  const Vec3 across = normalized_or(cross(-hole(portal).shaft, map_.distal), {1, 0, 0});
  Vec3 best = in_portal(portal, kInsideMm);
  int most = -1;
  for (double deep = 1.0; deep <= 8.0; deep += 1.0) {
    for (double aside = -5.0; aside <= 5.0; aside += 1.0) {
      for (double up = -1.0; up <= 1.0; up += 0.5) {
        const Vec3 tip = in_portal(portal, deep) + across * aside + map_.distal * up;
        if (!goes_in(tip, portal, radius + 0.1)) continue;
        const HandPose held = through(portal, tip);
        const Vec3 eye = tip + held.shaft * radius;
        int seen = 0;
        for (std::size_t p = 0; p < map_.points.size(); ++p) {
          const Vec3 at = place_of(p);
          const double far = distance(eye, at);
          if (map_.points[p].joint != joint || far > kUsefulMm) continue;
          if (-dot(at - eye, held.shaft) < widest * far || !is_free(joint, eye, at)) continue;
          ++seen;
        }
        if (seen <= most) continue;
        most = seen;
        best = tip;
      }
    }
  }
  return best;
}

void ScriptedArthroscopist::plan_round(const procedure::ScopeDrill&, const Stop& stop) {
  const std::size_t first = tasks_.size();
  const Vec3 best = place_to_look_round(stop.look);
  for (int turn = 0; turn < skill_.tries; ++turn) {
    const Vec3 tip = best + error(2.0 * skill_.aim_error_mm);
    for (double deg = -180.0; deg <= 180.0; deg += kRoundStepDeg) {
      look(stop.look, {tip, deg, true});
      tasks_.back().dwell = static_cast<Tick>(kRoundDwellS / kTickSeconds);
    }
  }
  mark_since(first, DrillGoal::Round, 1);
}

Vec3 ScriptedArthroscopist::on_surface(std::uint8_t joint,
                                       const Vec3& near,
                                       double presses_mm) const {
  const arthroscopy::OpenedSpace wall = space_at(joint, near);
  if (!wall.is_near) return near;
  return near + wall.outwards * (presses_mm - wall.distance_mm);
}

void ScriptedArthroscopist::plan_touches(const procedure::ScopeDrill& drill, const Stop& stop) {
  const std::uint8_t joint = map_.portals[stop.look].joint;
  for (std::size_t i = 0; i < drill.touch.size(); ++i) {
    const std::size_t first = tasks_.size();
    const Vec3 place = place_of(point_of(drill.touch[i]));
    for (int turn = 0; turn < skill_.tries; ++turn) {
      // What was led blind and not counted is looked at the next time.
      if (turn > 0 || rng_.uniform(0.0, 1.0) >= skill_.leads_blind) {
        watch(stop, {&place, 1}, cosine_of(kSeenDeg), turn);
      }
      const Vec3 at = place + error(skill_.aim_error_mm);
      const HandPose above = through(stop.work, on_surface(joint, at, -kAboveMm));
      go(kProbe, above, skill_.reaction_s);
      go(kProbe, through(stop.work, on_surface(joint, at, skill_.presses_mm)), skill_.dwell_s);
      go(kProbe, above, 0.0);
    }
    mark_since(first, DrillGoal::Touch, i + 1);
  }
}

/// Piece by piece: each is brought into view, then followed.
void ScriptedArthroscopist::plan_line(const procedure::ScopeDrill& drill, const Stop& stop) {
  const std::size_t first = tasks_.size();
  const std::uint8_t joint = map_.portals[stop.look].joint;
  std::vector<Vec3> line;
  for (std::size_t i = 0; i + 1 < drill.line.size(); ++i) {
    const Vec3 from = place_of(point_of(drill.line[i]));
    const Vec3 to = place_of(point_of(drill.line[i + 1]));
    const double whole = std::ceil(distance(from, to) / kLineStepMm);
    for (double s = 0; s < whole; ++s) line.push_back(from + (to - from) * (s / whole));
  }
  line.push_back(place_of(point_of(drill.line.back())));
  const double at_rim = cosine_of(lens_.field_deg / 2 - kRimDeg);
  for (int turn = 0; turn < skill_.tries; ++turn) {
    go(kProbe, through(stop.work, on_surface(joint, line.front(), -kAboveMm)), skill_.reaction_s);
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (i % kPieceSteps == 0) {
        const std::size_t last = std::min(i + kPieceSteps, line.size() - 1);
        watch(stop, std::array{line[i], line[last]}, at_rim, turn);
      }
      const Vec3 pressed = on_surface(joint, line[i], kLinePress * skill_.presses_mm);
      go(kProbe, through(stop.work, pressed + error(0.3 * skill_.aim_error_mm)), 0.0);
    }
    go(kProbe, through(stop.work, in_portal(stop.work, kInsideMm)), skill_.reaction_s);
  }
  mark_since(first, DrillGoal::Line, 1);
}

}  // namespace carpus::trainee
