// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "trainee/leading_sleeve.hpp"

namespace carpus::trainee {
namespace {

using simulation::Command;
using simulation::CommandKind;

constexpr std::uint8_t kHand = 1;
constexpr double kFarMm = 30.0;    // from where it goes straight in
constexpr double kBeforeMm = 1.0;  // of the bone: the point is seen to touch it
constexpr double kMetMm = 0.2;     // the hand beyond the sleeve: something stopped it

}  // namespace

LeadingSleeve::LeadingSleeve(const procedure::Procedure& procedure) {
  for (const auto index : procedure.tray) {
    if (instruments::catalogue()[index].is_sleeve) instrument_ = index;
  }
}

void LeadingSleeve::begin(const HandPose& hand,
                          const Vec3& entry,
                          const Vec3& inward,
                          double mm_per_s) {
  if (!is_held_) hand_ = hand;
  entry_ = entry;
  inward_ = inward;
  mm_per_s_ = mm_per_s;
  stage_ = Stage::Take;
}

void LeadingSleeve::move_to(const HandPose& target) {
  const double way = distance(hand_.tip, target.tip) + 40.0 * distance(hand_.shaft, target.shaft);
  move_ = MinimumJerkMove(hand_, target, static_cast<Tick>((0.3 + way / mm_per_s_) / kTickSeconds));
  in_move_ = 0;
}

bool LeadingSleeve::next(const simulation::Snapshot& now, simulation::Input& input) {
  switch (stage_) {
    case Stage::Take:
      if (!is_held_) input.command = {CommandKind::Take, kHand, instrument_, 0, 0};
      is_held_ = true;
      move_to({entry_ - inward_ * kFarMm, -inward_});
      stage_ = Stage::Come;
      break;
    case Stage::Come:
      hand_ = move_.at(++in_move_);
      if (!move_.is_over(in_move_)) break;
      move_to({entry_ - inward_ * kBeforeMm, -inward_});
      stage_ = Stage::Approach;
      break;
    case Stage::Approach:
      hand_ = move_.at(++in_move_);
      if (now.hands[kHand].contact_depth_mm > kMetMm) {
        hand_.tip -= inward_ * (2 * kMetMm);
        stage_ = Stage::Stands;
      } else if (move_.is_over(in_move_)) {
        stage_ = Stage::Stands;
      }
      break;
    case Stage::Stands:
      break;
  }
  keep(input);
  return stage_ == Stage::Stands;
}

void LeadingSleeve::keep(simulation::Input& input) const {
  input.hands[kHand].tip_in_patient = hand_.tip;
  input.hands[kHand].shaft_in_patient = hand_.shaft;
}

void LeadingSleeve::put_down(simulation::Input& input) {
  input.command = {CommandKind::PutDown, kHand, 0, 0, 0};
  is_held_ = false;
}

}  // namespace carpus::trainee
