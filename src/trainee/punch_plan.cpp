// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a scripted arthroscopist bites tissue off where a punch lies on the tray: the bulk of what
// hangs loose first, bite by bite, as far as none of what is to stay would come with it; then it
// changes to the shaver for the rest.
#include "trainee/arthroscopist.hpp"

namespace carpus::trainee {
namespace {

constexpr std::uint8_t kProbe = 1;  // hand
constexpr double kInsideMm = 2.0;
constexpr double kPressMm = 0.1;  // by which the jaws are pressed onto what they are to bite
constexpr double kAboveMm = 1.2;  // from there they are brought over it
constexpr double kClosingS = 0.25;
constexpr double kHastySound = 5.0;  // places that are to stay, which a hasty hand lets go with it

}  // namespace

/// In the middle of the most that a bite takes; none where no bite is worth it.
std::size_t ScriptedArthroscopist::next_to_bite(const simulation::Snapshot& now) const {
  const auto& pieces = lesions_->pieces;
  const double within = instruments::catalogue()[punch_].bite->width_mm / 2;
  std::size_t best = pieces.size();
  double most = 0.0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const bool is_seen = (now.scope.facts.shaving.patches_seen >> pieces[i].patch & 1U) != 0;
    if (!pieces[i].is_ill || !is_seen || now.scope.pieces_left[i] == 0) continue;
    if (bite_tries_[i] >= skill_.tries) continue;
    double ill = 0.0;
    double sound = 0.0;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const bool is_there = now.scope.pieces_left[k] != 0 && pieces[k].joint == pieces[i].joint;
      if (!is_there || distance(piece_at(k), piece_at(i)) > within) continue;
      ++(pieces[k].is_ill ? ill : sound);
    }
    if (sound > kHastySound * skill_.hasty) continue;
    const double gain = ill - 2.0 * sound * (1.0 - skill_.hasty) - 0.5 * bite_tries_[i];
    if (gain <= most) continue;
    most = gain;
    best = i;
  }
  return best;
}

void ScriptedArthroscopist::plan_bite(std::size_t i) {
  const int turn = bite_tries_[i]++;
  const Vec3 at = piece_at(i);
  const bool is_new = !has_probe_;
  come_to_piece(at, turn, is_new);
  const instruments::Instrument& punch = instruments::catalogue()[punch_];
  const Vec3 inwards = -out_of_joint(i);
  const Vec3 middle = at + inwards * (punch.shape.greatest_radius_mm() - kPressMm);
  const Vec3 tip = middle - through(working_.work, middle).shaft * punch.bite->behind_mm +
                   error(skill_.aim_error_mm);
  const Vec3 above = tip + inwards * kAboveMm;
  if (is_new || turn > 0) {
    go(kProbe, through(working_.work, in_portal(working_.work, kInsideMm)), 0.0);
    go(kProbe, through(working_.work, comes_in_at(working_.work, above)), 0.0);
  }
  go(kProbe, through(working_.work, above), skill_.reaction_s);
  tasks_.back().jaws = Jaws::Open;
  go(kProbe, through(working_.work, tip), skill_.reaction_s);
  go(kProbe, through(working_.work, tip), kClosingS);
  tasks_.back().jaws = Jaws::Closed;
  last_cut_ = at;
  go_on_seeking();
}

/// Outside: what it holds is drawn out, the next takes its place where it is begun with.
void ScriptedArthroscopist::change_tool(instruments::InstrumentIndex tool) {
  if (in_[kProbe] != procedure::kNoBody) draw_out(kProbe);
  tool_ = tool;
  has_probe_ = false;
  last_patch_ = cases::kMaxPatches;  // what comes first with it is new to it
}

/// @returns  whether a bite is planned, and all else waits.
bool ScriptedArthroscopist::seek_to_bite(const simulation::Snapshot& now) {
  if (punch_ == instruments::kNoInstrument || tool_ != punch_) return false;
  const std::size_t piece = next_to_bite(now);
  if (piece < lesions_->pieces.size()) {
    plan_bite(piece);
    return true;
  }
  if (next_to_cut(now) < lesions_->pieces.size()) change_tool(procedure_.tray.back());
  return false;
}

}  // namespace carpus::trainee
