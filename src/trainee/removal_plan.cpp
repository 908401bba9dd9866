// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a scripted arthroscopist takes out what is loose: it goes after what the scope has shown,
// finds out at each step what has become of it, and looks again at the end.
#include <algorithm>

#include "trainee/arthroscopist.hpp"

namespace carpus::trainee {
namespace {

constexpr std::uint8_t kScope = 0;  // hands
constexpr std::uint8_t kProbe = 1;
constexpr std::uint8_t kFirstPortal = 0;
constexpr double kInsideMm = 2.0;
constexpr double kOutsideMm = 12.0;
constexpr double kWithinMm = 0.8;   // of the wall, a tip that comes in
constexpr double kBeforeMm = 1.6;   // a body, before the jaws are brought over it
constexpr double kMouthMm = 0.8;    // behind the tip the jaws close
constexpr double kSeenDeg = 28.0;   // off the line of sight it is still well seen
constexpr double kBetweenMm = 0.7;  // so near to their mouth it lies between the jaws
constexpr double kClosingS = 0.3;
constexpr int kMostLooks = 4;
constexpr int kMostTries = 12;

double cosine_of(double deg) { return arthroscopy::cos_sin_deg(deg)[0]; }

}  // namespace

void ScriptedArthroscopist::plan_removal() {
  working_.look = kFirstPortal;
  working_.work = work_portal(kFirstPortal);
  go_in(kScope, working_.look);
  plan_search();
  go_on_seeking();
}

/// Round once, then place by place.
void ScriptedArthroscopist::plan_search() {
  look_round(working_);
  const std::uint8_t joint = map_.portals[working_.look].joint;
  for (std::size_t i = 0; i < map_.points.size(); ++i) {
    if (map_.points[i].joint != joint) continue;
    if (rng_.uniform(0.0, 1.0) < skill_.searches) look_at(working_, place_of(i));
  }
}

/// Of the tour's portals beside the scope the one through which jaws reach it; the next at each
/// other try.
std::uint8_t ScriptedArthroscopist::portal_for(const Vec3& at, int turn) const {
  const double radius = instruments::catalogue()[procedure_.tray.back()].shape.greatest_radius_mm();
  std::vector<std::uint8_t> all;
  for (std::uint8_t p = 0; p < map_.portals.size(); ++p) {
    const cases::Portal& portal = map_.portals[p];
    const bool is_other = portal.is_usual && p != working_.look;
    if (is_other && portal.joint == map_.portals[working_.look].joint) all.push_back(p);
  }
  if (all.empty()) return working_.work;
  std::stable_partition(all.begin(), all.end(), [&](std::uint8_t p) {
    return goes_in(at + through(p, at).shaft * kBeforeMm, p, radius);
  });
  return all[static_cast<std::size_t>(turn / 2) % all.size()];
}

/// Where the line from the hole in the skin to a place comes into the joint, well within its wall.
Vec3 ScriptedArthroscopist::comes_in_at(std::uint8_t portal, const Vec3& at) const {
  const Vec3 from = hole(portal).tip;
  const double far = distance(from, at);
  for (double s = map_.portals[portal].capsule_mm * 0.7; s < far; s += 0.25) {
    const Vec3 p = from + (at - from) * (s / far);
    const arthroscopy::OpenedSpace space = space_at(map_.portals[portal].joint, p);
    if (space.is_near && space.distance_mm < -kWithinMm) return p;
  }
  return in_portal(portal, kInsideMm);
}

void ScriptedArthroscopist::go_on_seeking() {
  Task next;
  next.hand = kScope;
  next.seeks = true;
  tasks_.push_back(next);
}

/// Put before what is still to be done, in the place of the task that asked.
void ScriptedArthroscopist::seek(const simulation::Snapshot& now) {
  const auto from = tasks_.begin() + static_cast<std::ptrdiff_t>(at_);
  const std::vector<Task> after(from + 1, tasks_.end());
  tasks_.erase(from, tasks_.end());
  planned_[kScope] = hands_[kScope].tip;
  if (procedure_.shaving) {
    seek_to_cut(now);
    tasks_.insert(tasks_.end(), after.begin(), after.end());
    return;
  }
  const auto& loose = now.scope.loose;
  const bool has_one = std::any_of(loose.begin(), loose.begin() + now.scope.loose_count,
                                   [](const auto& body) { return body.hand == kProbe; });
  const bool was_over = is_over_;
  is_over_ = false;
  const simulation::LooseView* over = nullptr;
  for (std::size_t i = 0; was_over && i < now.scope.loose_count; ++i) {
    if (loose[i].lesion == over_) over = &loose[i];
  }
  if (has_one) {
    plan_bring_out();
  } else if (over != nullptr) {
    plan_close(now, *over);
  } else if (const simulation::LooseView* body = next_to_catch(now)) {
    plan_catch(*body);
  } else {
    plan_another_look(now);
  }
  tasks_.insert(tasks_.end(), after.begin(), after.end());
}

/// Of what was seen, what was tried least.
const simulation::LooseView* ScriptedArthroscopist::next_to_catch(
    const simulation::Snapshot& now) const {
  const simulation::LooseView* best = nullptr;
  for (std::size_t i = 0; i < now.scope.loose_count; ++i) {
    const simulation::LooseView& body = now.scope.loose[i];
    const bool is_seen = (now.scope.lesions_seen >> body.lesion & 1U) != 0;
    if (!is_seen || tried_[body.lesion] >= 3 * skill_.tries) continue;
    if (best == nullptr || tried_[body.lesion] < tried_[best->lesion]) best = &body;
  }
  return best;
}

void ScriptedArthroscopist::plan_catch(const simulation::LooseView& body) {
  const int turn = tried_[body.lesion]++;
  const Vec3 at = body.at_in_patient;
  working_.work = portal_for(at, turn);
  if (!has_probe_) {
    take_probe(working_.work);
    has_probe_ = true;
  }
  if (rng_.uniform(0.0, 1.0) >= skill_.leads_blind || turn > 1) {
    watch(working_, {&at, 1}, cosine_of(kSeenDeg), std::min(turn, 3));
  }
  if (in_[kProbe] != working_.work) go_in(kProbe, working_.work);
  const Vec3 back = through(working_.work, at).shaft;
  const Vec3 aimed = at - back * kMouthMm + error(skill_.aim_error_mm);
  const std::size_t first = tasks_.size();
  // Aside first, while it is hardly in, then straight on: along the line all of it has room.
  const Vec3 before = at + back * kBeforeMm;
  go(kProbe, through(working_.work, in_portal(working_.work, kInsideMm)), 0.0);
  go(kProbe, through(working_.work, comes_in_at(working_.work, before)), 0.0);
  go(kProbe, through(working_.work, before), skill_.reaction_s);
  tasks_[first].jaws = Jaws::Open;
  go(kProbe, through(working_.work, aimed), skill_.reaction_s);
  is_over_ = true;
  over_ = body.lesion;
  go_on_seeking();
}

/// What the scope shows between them: closed at once; what lies beside is tried again.
void ScriptedArthroscopist::plan_close(const simulation::Snapshot& now,
                                       const simulation::LooseView& body) {
  const std::uint8_t item = now.hands[kProbe].item;
  if (item >= simulation::kMaxItems || lesions_ == nullptr) return plan_catch(body);
  const simulation::ItemView& jaws = now.items[item];
  const Vec3 mouth = jaws.tip_in_patient + jaws.shaft_in_patient * kMouthMm;
  const double beside =
      distance(mouth, body.at_in_patient) - lesions_->lesions[body.lesion].radius_mm;
  const bool closes = beside <= kBetweenMm || rng_.uniform(0.0, 1.0) < skill_.hasty;
  if (closes) {
    go(kProbe, hands_[kProbe], kClosingS);
    tasks_.back().jaws = Jaws::Closed;
    go_on_seeking();
  } else if (tried_[body.lesion] < 3 * skill_.tries) {
    plan_catch(body);
  } else {
    go_on_seeking();
  }
}

void ScriptedArthroscopist::plan_bring_out() {
  if (++brought_ > kMostTries) return;
  const std::uint8_t portal = working_.work;
  const std::size_t first = tasks_.size();
  // The way that it came: back along its shaft, before the hole in the capsule, out.
  const HandPose& held = hands_[kProbe];
  go(kProbe, through(portal, comes_in_at(portal, held.tip)), 0.0);
  go(kProbe, through(portal, in_portal(portal, kInsideMm)), 0.0);
  go(kProbe, through(portal, in_portal(portal, -map_.portals[portal].capsule_mm - kOutsideMm)),
     skill_.reaction_s);
  for (std::size_t i = first; i < tasks_.size(); ++i) {
    tasks_[i].speed_mm_per_s = skill_.draws_mm_per_s;
  }
  in_[kProbe] = procedure::kNoBody;
  go_on_seeking();
}

/// Nothing that was seen is left: another may be where it was not looked.
void ScriptedArthroscopist::plan_another_look(const simulation::Snapshot& now) {
  const std::uint8_t out = now.scope.facts.loose.out;
  const bool is_new = looks_ == 0 || out > out_when_looked_;
  out_when_looked_ = out;
  if (!is_new || looks_ >= kMostLooks) return;
  ++looks_;
  if (rng_.uniform(0.0, 1.0) >= skill_.looks_again) return;
  plan_search();
  go_on_seeking();
}

}  // namespace carpus::trainee
