// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a scripted arthroscopist brings a shaver's mouth to a piece of tissue: straight from inside
// where the shaft has room there, else from aside, turned as little as needed; and what it sees of
// it in the picture once it is there.
#include <algorithm>
#include <array>

#include "fields/distance_field.hpp"
#include "trainee/arthroscopist.hpp"

namespace carpus::trainee {
namespace {

constexpr std::uint8_t kProbe = 1;  // hand
constexpr double kTurnStepDeg = 4.0;
constexpr double kAsideStepDeg = 20.0;
constexpr std::array kLiftsMm{0.25, 0.5, 0.75};  // by which the mouth stays off the piece's middle
constexpr std::array kAlongMm{0.0, -0.5, 0.5};   // ... or lies beside it, along the shaft
constexpr double kSpareMm = 0.1;                 // about the shaver
constexpr double kShaftMm = 14.0;                // of it that bones may be in the way of
constexpr double kOnWallMm = 0.2;                // a tip may lie so deep in what lines the joint
constexpr double kShortCosts = 6.0;              // a millimetre, against one of lift
constexpr double kTurnedCosts = 0.5;             // a quarter of a turn aside
constexpr double kBehindMm = 0.3;                // the mouth's plane a piece is still drawn in
constexpr double kSureMm = 0.1;                  // within its reach, to be seen to be in it

}  // namespace

/// By which the mouth looks that way, as nearly as the shaft lets it.
double ScriptedArthroscopist::mouth_turn_deg(const HandPose& held, const Vec3& towards) const {
  double best = 0.0;
  double most = -2.0;
  for (double deg = -180.0; deg < 180.0; deg += kTurnStepDeg) {
    const arthroscopy::Sight sight =
        arthroscopy::sight_of({90.0, 90.0}, {held.tip, held.shaft, deg, 0.0}, map_.distal);
    const double cosine = dot(sight.axis, towards);
    if (cosine <= most) continue;
    most = cosine;
    best = deg;
  }
  return best;
}

/// Between the bones; negative: it would be in one.
double ScriptedArthroscopist::room_about_shaver_mm(const HandPose& held) const {
  const auto& shape = instruments::catalogue()[procedure_.tray.back()].shape;
  double least = kSpareMm;
  for (double s = shape.front_z_mm(); s < kShaftMm; s += 0.5) {
    const Vec3 at = held.tip + held.shaft * s;
    for (const auto& [bone, from_patient] : bones_) {
      const Vec3 local = (from_patient * Point<frame::Patient>{at}).v;
      const fields::DistanceSample near = fields::sample_distance(bone->distance_field, local);
      if (!near.is_inside_grid) continue;
      least = std::min(least, near.distance_mm - shape.greatest_radius_mm());
    }
  }
  return least;
}

/// @param left  of the piece
ScriptedArthroscopist::Approach ScriptedArthroscopist::approach(std::uint8_t portal,
                                                                std::size_t i,
                                                                double left) const {
  const instruments::Instrument& shaver = instruments::catalogue()[procedure_.tray.back()];
  const double radius_mm = shaver.shape.greatest_radius_mm();
  const cases::TissuePiece& piece = lesions_->pieces[i];
  const Vec3 out = out_of_joint(i);
  const Vec3 at = piece_at(i) + out * (piece.height_mm * (1.0 - left) / 2);
  const Vec3 shaft = through(portal, at).shaft;
  const Vec3 across = normalized_or(out - shaft * dot(out, shaft), out);
  const Vec3 aside = cross(shaft, across);
  Approach best;
  Vec3 faces;
  double least = 1e9;
  for (double deg = 0.0; deg < 360.0; deg += kAsideStepDeg) {
    const auto [cosine, sine] = arthroscopy::cos_sin_deg(deg);
    const Vec3 towards = across * cosine + aside * sine;
    for (const double lift : kLiftsMm) {
      for (const double along : kAlongMm) {
        const double turned = kTurnedCosts * (1.0 - cosine) + lift + std::abs(along);
        if (turned >= least) continue;
        const Vec3 tip =
            at - towards * (radius_mm + lift) - shaft * (shaver.mouth->behind_mm + along);
        const HandPose held = through(portal, tip);
        const arthroscopy::OpenedSpace wall = space_at(piece.joint, tip);
        const double behind_wall = wall.is_near ? wall.distance_mm - kOnWallMm : 0.0;
        const double short_mm = std::max({0.0, kSpareMm - room_about_shaver_mm(held), behind_wall});
        const double cost = turned + kShortCosts * short_mm;
        if (cost >= least) continue;
        least = cost;
        best.held = held;
        faces = towards;
      }
    }
  }
  best.mouth_deg = mouth_turn_deg(best.held, faces);
  return best;
}

/// As the picture shows it: before the mouth, and near enough to be drawn in.
bool ScriptedArthroscopist::is_in_mouth(const simulation::Snapshot& now, std::size_t i) const {
  const std::uint8_t item = now.hands[kProbe].item;
  const instruments::Instrument& shaver = instruments::catalogue()[procedure_.tray.back()];
  if (item >= simulation::kMaxItems || !now.scope.facts.is_in_joint[kProbe]) return false;
  const HandPose held{now.items[item].tip_in_patient, now.items[item].shaft_in_patient};
  const Vec3 faces =
      arthroscopy::sight_of({90.0, 90.0}, {held.tip, held.shaft, now.scope.mouth_deg[kProbe], 0.0},
                            map_.distal)
          .axis;
  const Vec3 mouth =
      held.tip + held.shaft * shaver.mouth->behind_mm + faces * shaver.shape.greatest_radius_mm();
  const cases::TissuePiece& piece = lesions_->pieces[i];
  const Vec3 out = out_of_joint(i);
  const Vec3 base = piece_at(i) + out * (piece.height_mm / 2);
  const double high = piece.height_mm * 0.01 * now.scope.pieces_left[i];
  const Vec3 nearest = base - out * std::clamp(dot(base - mouth, out), 0.0, high);
  const Vec3 off = nearest - mouth;
  return dot(off, faces) > -kBehindMm &&
         length(off) < shaver.mouth->reach_mm + piece.radius_mm - kSureMm;
}

}  // namespace carpus::trainee
