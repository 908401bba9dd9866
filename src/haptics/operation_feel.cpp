// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "haptics/operation_feel.hpp"

#include <algorithm>
#include <cmath>

namespace carpus::haptics {
namespace {

/// Farther away a surface is not sent yet [mm]: at 0.5 m/s 6 ms, three times what a wish takes.
constexpr double kAheadMm = 3.0;
/// A hold that lies so near the surface's normal is the surface's (a cosine): friction leans it.
constexpr double kSameWay = 0.85;
/// Of the side of a hole [N/mm]: wires give [E].
constexpr double kAsideNPerMm = 1.0;
constexpr double kNothingMm = 1e-3;
/// A layer is no stiffer than this share of the bone as the device gives it: or none could tell
/// them apart where that is soft [E].
constexpr double kLayerShare = 0.4;

void put(Felt& felt, const Vec3& normal, double offset_mm, const SurfaceFeel& feel) noexcept {
  if (felt.plane_count >= felt.planes.size() || !is_finite(normal)) return;
  felt.planes[felt.plane_count++] = {normal, offset_mm, feel};
}

}  // namespace

double thrust_of_press_n(const DrillingFeel& feel, double press, double peak_force_n) noexcept {
  if (!(press > 0) || !(peak_force_n > 0)) return 0;
  return press * std::max(1.0, feel.hardest_bone_n / (feel.share_of_peak * peak_force_n));
}

double press_n(const FeltMoment& moment, double stiffness_n_per_mm) noexcept {
  const double depth = dot(moment.tip - moment.wish, moment.shaft);
  return depth > 0 ? depth * stiffness_n_per_mm : 0.0;
}

Shake drill_shake(const DrillingFeel& feel, double resistance_n, double feed_share) noexcept {
  const double load = std::clamp(resistance_n / feel.hardest_bone_n, 0.0, 1.0);
  const double cut =
      feel.least_cut_share + (1 - feel.least_cut_share) * std::clamp(feed_share, 0.0, 1.0);
  return {feel.free_n + (feel.most_n - feel.free_n) * load * cut,
          feel.turns_per_s * feel.edges * (1 - feel.slows_share * load)};
}

SurfaceFeel OperationFeel::bone_of(const FeltMoment& moment) const noexcept {
  SurfaceFeel bone = table_.bone.feel;
  if (moment.most_n_per_mm > 0)
    bone.stiffness_n_per_mm = std::min(bone.stiffness_n_per_mm, moment.most_n_per_mm);
  return bone;
}

/// A layer over the bone, if any, and the bone: together as stiff as it.
void OperationFeel::put_near_surface(const FeltMoment& moment, Felt& felt) const noexcept {
  const SurfaceNear& near = moment.near;
  if (!near.is_there || !(near.gap_mm < kAheadMm)) return;
  const double bone_at = dot(near.normal, moment.tip) - near.gap_mm;
  const TissueFeel& over = near.has_cartilage ? table_.cartilage : table_.soft_tissue;
  SurfaceFeel bone = bone_of(moment);
  const bool is_bare = moment.is_pointed || felt.plane_count + 2 > felt.planes.size();
  if (is_bare) return put(felt, near.normal, bone_at, bone);
  SurfaceFeel layer = over.feel;
  layer.stiffness_n_per_mm =
      std::min(layer.stiffness_n_per_mm, kLayerShare * bone.stiffness_n_per_mm);
  put(felt, near.normal, bone_at + over.thickness_mm, layer);
  bone.stiffness_n_per_mm -= layer.stiffness_n_per_mm;
  bone.friction = layer.friction;  // what slides, slides on the layer
  put(felt, near.normal, bone_at, bone);
}

/// Along the line as far as bone lets it, aside not at all.
void OperationFeel::put_line(const FeltMoment& moment, Felt& felt) const noexcept {
  const Vec3 back = moment.tip - moment.wish;
  const double along = dot(back, moment.shaft);
  const Vec3 aside = back - moment.shaft * along;
  // A tool in bone is held both ways: who draws is held back as who presses.
  const Vec3 way = along >= 0 ? moment.shaft : -moment.shaft;
  SurfaceFeel line = bone_of(moment);
  line.friction = 0;
  put(felt, way, dot(way, moment.tip), line);
  const double far = length(aside);
  if (!(far > kNothingMm)) return;
  const Vec3 side = aside / far;
  line.stiffness_n_per_mm = std::min(line.stiffness_n_per_mm, kAsideNPerMm);
  put(felt, side, dot(side, moment.tip), line);
}

Shake OperationFeel::detent(const FeltMoment& moment) noexcept {
  const TurningFeel& feel = table_.turning;
  const double detents = std::floor(moment.turns * feel.detents_per_turn);
  if (has_turns_ && moment.is_turning && detents != detents_) {
    pulse_ticks_ = static_cast<int>(feel.pulse_ms);
  }
  detents_ = detents;
  has_turns_ = std::isfinite(moment.turns);
  if (pulse_ticks_ <= 0) return {};
  --pulse_ticks_;
  const double share = std::clamp(moment.torque_n_mm / feel.full_torque_n_mm, 0.0, 1.0);
  return {feel.least_n + (feel.most_n - feel.least_n) * share, feel.pulse_hz};
}

Felt OperationFeel::feel(const FeltMoment& moment) noexcept {
  Felt felt;
  if (!is_finite(moment.tip) || !is_finite(moment.wish) || !is_finite(moment.shaft)) return felt;
  if (moment.is_in_bone) {
    put_line(moment, felt);
  } else {
    const Vec3 back = moment.tip - moment.wish;
    const double far = length(back);
    const SurfaceNear& near = moment.near;
    const bool is_the_surface =
        near.is_there && near.gap_mm < 0.1 && dot(back, near.normal) > kSameWay * far;
    // The shaft, a sleeve, a wedge: what holds the tool otherwise than by its tip.
    if (moment.is_held_back && far > kNothingMm && !is_the_surface) {
      const Vec3 out = back / far;
      put(felt, out, dot(out, moment.tip), bone_of(moment));
    }
    put_near_surface(moment, felt);
  }
  Shake shake;
  if (moment.turned_by == TurnedBy::Motor && moment.is_turning) {
    shake = drill_shake(table_.drilling, moment.resistance_n, moment.feed_share);
  } else if (moment.turned_by == TurnedBy::Hand) {
    shake = detent(moment);
  }
  if (moment.turned_by != TurnedBy::Hand) rest();
  if (std::isfinite(shake.size_n) && std::isfinite(shake.rate_hz)) {
    felt.vibration_n = shake.size_n;
    felt.vibration_hz = shake.rate_hz;
  }
  return felt;
}

}  // namespace carpus::haptics
