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
constexpr double kBeforeMm = 1.6;   // a body, before the jaws are brought over it
constexpr double kMouthMm = 0.8;    // behind the tip the jaws close
constexpr double kSeenDeg = 28.0;   // off the line of sight it is still well seen
constexpr double kClosingS = 0.3;
constexpr int kMostLooks = 4;

double cosine_of(double deg) { return arthroscopy::cos_sin_deg(deg)[0]; }

}  // namespace

void ScriptedArthroscopist::plan_removal() {
  working_.look = kFirstPortal;
  working_.work = work_portal(kFirstPortal);
  go_in(kScope, working_.look);
  look_round(working_);
  go_on_seeking();
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
  const auto& loose = now.scope.loose;
  const bool has_one = std::any_of(loose.begin(), loose.begin() + now.scope.loose_count,
                                   [](const auto& body) { return body.hand == kProbe; });
  if (has_one) {
    plan_bring_out();
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
  go(kProbe, through(working_.work, at + back * kBeforeMm), skill_.reaction_s);
  tasks_[first].jaws = Jaws::Open;
  go(kProbe, through(working_.work, aimed), skill_.reaction_s);
  go(kProbe, through(working_.work, aimed), kClosingS);
  tasks_.back().jaws = Jaws::Closed;
  go_on_seeking();
}

void ScriptedArthroscopist::plan_bring_out() {
  const std::uint8_t portal = working_.work;
  const std::size_t first = tasks_.size();
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
  look_round(working_);
  go_on_seeking();
}

}  // namespace carpus::trainee
