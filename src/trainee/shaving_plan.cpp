// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a scripted arthroscopist shaves: it looks for what is ill, goes from piece to piece of what
// it has seen, turns the mouth onto each, and presses the pedal where it is there until it is gone.
#include <algorithm>

#include "trainee/arthroscopist.hpp"

namespace carpus::trainee {
namespace {

constexpr std::uint8_t kScope = 0;  // hands
constexpr std::uint8_t kProbe = 1;
constexpr double kInsideMm = 2.0;
constexpr double kSeenDeg = 28.0;    // off the line of sight it is still well seen
constexpr double kCutS = 1.0;        // a piece takes less; who does not look presses so long
constexpr double kFarMm = 3.0;       // to a piece farther off the hand is lifted
constexpr double kWatchedMm = 2.5;   // off what the scope was led to, it is led anew
constexpr double kHazyPerMm = 0.08;  // more, and a place 10 mm away is hardly seen
constexpr double kClearsS = 3.0;
constexpr int kClearingSteps = 10;  // of the pump: 50 mmHg
constexpr int kMostLooks = 2;
constexpr int kMostPresses = 4;  // at a piece, before it is come to anew

double cosine_of(double deg) { return arthroscopy::cos_sin_deg(deg)[0]; }

}  // namespace

/// Where a piece stands now, its middle.
Vec3 ScriptedArthroscopist::piece_at(std::size_t i) const {
  const cases::TissuePiece& piece = lesions_->pieces[i];
  return (poses_[piece.body] * Point<frame::Bone>{piece.at + piece.inwards * (piece.height_mm / 2)})
      .v;
}

Vec3 ScriptedArthroscopist::out_of_joint(std::size_t i) const {
  const cases::TissuePiece& piece = lesions_->pieces[i];
  return -(poses_[piece.body] * Direction<frame::Bone>{piece.inwards}).v;
}

/// Of what was seen and is left the nearest to where the shaver is; none where all is done.
std::size_t ScriptedArthroscopist::next_to_cut(const simulation::Snapshot& now) const {
  const auto& pieces = lesions_->pieces;
  // What does not come into the mouth is given up; a hasty hand goes on.
  const double most_tries = skill_.tries * (1.0 + skill_.hasty);
  std::size_t best = pieces.size();
  double least = 1e9;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const bool is_seen = (now.scope.facts.shaving.patches_seen >> pieces[i].patch & 1U) != 0;
    if (!pieces[i].is_ill || !is_seen || now.scope.pieces_left[i] == 0) continue;
    if (cut_tries_[i] >= most_tries) continue;
    const double far = distance(piece_at(i), last_cut_) +
                       (pieces[i].patch == last_patch_ ? 0.0 : 20.0) + 3.0 * cut_tries_[i];
    if (far >= least) continue;
    least = far;
    best = i;
  }
  return best;
}

/// The portal for it, what works there in it, and the scope on it.
void ScriptedArthroscopist::come_to_piece(const Vec3& at, int turn, bool is_new) {
  if (is_new || turn > 0) working_.work = portal_for(at, 2 * turn);
  if (!has_probe_) {
    take_probe(working_.work);
    has_probe_ = true;
  }
  const bool leads_blind = rng_.uniform(0.0, 1.0) < skill_.leads_blind;
  const bool is_aside = is_new || distance(at, watched_) > kWatchedMm;
  if ((is_aside && !leads_blind) || turn > 0) {
    watched_ = at;
    watch(working_, {&at, 1}, cosine_of(kSeenDeg), std::min(turn, 3));
  }
  if (in_[kProbe] != working_.work) go_in(kProbe, working_.work);
}

void ScriptedArthroscopist::plan_cut(const simulation::Snapshot& now, std::size_t i) {
  const cases::TissuePiece& piece = lesions_->pieces[i];
  const int turn = cut_tries_[i]++;
  const Vec3 at = piece_at(i);
  const bool is_new = piece.patch != last_patch_ || last_patch_ == cases::kMaxPatches;
  last_patch_ = piece.patch;
  const std::size_t first = tasks_.size();
  come_to_piece(at, turn, is_new);
  // A foot that is hasty stays on the pedal, whatever is done next.
  const bool keeps_running = rng_.uniform(0.0, 1.0) < skill_.hasty * skill_.hasty;
  const Approach to = approach(working_.work, i, 0.01 * now.scope.pieces_left[i]);
  const HandPose held = through(working_.work, to.held.tip + error(skill_.aim_error_mm));
  if (is_new || turn > 0 || distance(at, last_cut_) > kFarMm) {
    go(kProbe, through(working_.work, in_portal(working_.work, kInsideMm)), 0.0);
    go(kProbe, through(working_.work, comes_in_at(working_.work, to.held.tip)), 0.0);
  }
  go(kProbe, held, 0.0);
  tasks_.back().turns_mouth = true;
  tasks_.back().mouth_deg = to.mouth_deg + rng_.normal() * skill_.turn_error_deg;
  if (!keeps_running) tasks_[first].jaws = Jaws::Open;
  last_cut_ = at;
  is_before_ = true;
  before_ = i;
  pressed_ = 0;
  go_on_seeking();
}

/// The pedal, where the mouth is seen to be at the piece, and a look again: what is left stands
/// lower. A hasty foot does not wait to see it, and does not look while it presses.
bool ScriptedArthroscopist::plan_press(const simulation::Snapshot& now) {
  if (!is_before_ || now.scope.pieces_left[before_] == 0 || pressed_ >= kMostPresses) return false;
  const bool is_there = is_in_mouth(now, before_);
  if (!is_there && rng_.uniform(0.0, 1.0) >= skill_.hasty) return false;
  pressed_ = is_there ? pressed_ + 1 : kMostPresses;
  go(kProbe, hands_[kProbe], is_there ? skill_.reaction_s : kCutS);
  tasks_.back().jaws = Jaws::Closed;
  tasks_.back().until_gone = static_cast<int>(before_);
  go_on_seeking();
  return true;
}

/// As plan_removal: looks for it first.
void ScriptedArthroscopist::plan_shaving() {
  working_.look = 0;
  working_.work = work_portal(0);
  go_in(kScope, working_.look);
  plan_search();
  go_on_seeking();
}

/// Blood hides what is cut: who sees that sets the pump higher, once, and waits.
bool ScriptedArthroscopist::waits_until_clear(const simulation::Snapshot& now) {
  const simulation::FluidView& fluid = now.scope.fluid;
  const bool is_clouded = fluid.is_there && fluid.haze_per_mm > kHazyPerMm;
  if (!is_clouded || rng_.uniform(0.0, 1.0) < skill_.hasty) return false;
  go(kProbe, hands_[kProbe], kClearsS);
  tasks_.back().jaws = Jaws::Open;
  tasks_.back().inflow_steps = kClearingSteps;
  go_on_seeking();
  return true;
}

void ScriptedArthroscopist::seek_to_cut(const simulation::Snapshot& now) {
  if (lesions_ == nullptr) return;
  if (waits_until_clear(now) || seek_to_bite(now) || plan_press(now)) return;
  is_before_ = false;
  const std::size_t piece = next_to_cut(now);
  if (piece < lesions_->pieces.size()) return plan_cut(now, piece);
  // Nothing that was seen is left: another place may be where it was not looked.
  go(kProbe, hands_[kProbe], 0.0);
  tasks_.back().jaws = Jaws::Open;
  if (in_[kProbe] != procedure::kNoBody) {
    go(kProbe, through(working_.work, in_portal(working_.work, kInsideMm)), skill_.reaction_s);
  }
  const bool looks = looks_ < kMostLooks && rng_.uniform(0.0, 1.0) < skill_.looks_again;
  if (looks_++ >= kMostLooks || !looks) return;
  plan_search();
  go_on_seeking();
}

}  // namespace carpus::trainee
