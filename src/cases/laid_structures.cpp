// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/laid_structures.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/rigid_blend.hpp"
#include "geometry/segment_distance.hpp"

namespace carpus::cases {
namespace {

constexpr std::uint8_t kNoCarrier = 255;

std::uint8_t body_of(const CaseData& data, BoneId bone) {
  for (std::size_t b = 0; b < data.bones.size(); ++b) {
    if (data.bones[b].bone == bone) return static_cast<std::uint8_t>(b);
  }
  return kNoCarrier;
}

/// The forearm's bone, or the other one where it is missing.
std::uint8_t forearm_of(const CaseData& data, BoneId bone) {
  const std::uint8_t own = body_of(data, bone);
  if (own != kNoCarrier) return own;
  return body_of(data, bone == BoneId::Radius ? BoneId::Ulna : BoneId::Radius);
}

DualQuaternion motion_of(std::span<const Pose<frame::Patient, frame::Bone>> poses,
                         std::uint8_t body) noexcept {
  if (body >= poses.size()) return {};
  return dual_quaternion(poses[body].rotation, poses[body].translation);
}

/// Steps are taken to be no shorter, so that one can be divided by [mm].
constexpr double kLeastStepMm = 0.1;

}  // namespace

LaidStructures::LaidStructures(const CaseData& data)
    : hand_(body_of(data, BoneId::Capitate)),
      carriers_{hand_, body_of(data, BoneId::Radius), body_of(data, BoneId::Ulna)} {
  const std::size_t count = std::min(data.structures.size(), kMaxStructures);
  for (std::size_t i = 0; i < count; ++i) {
    const Structure& s = data.structures[i];
    tubes_.push_back({scanned_.size(),
                      s.course.size(),
                      s.radius_mm,
                      forearm_of(data, s.forearm),
                      {},
                      0.0,
                      0.0,
                      s.kind});
    for (const StructurePoint& p : s.course) {
      scanned_.push_back(p.at);
      hand_share_.push_back(p.hand_share);
    }
  }
  now_ = scanned_;
}

void LaidStructures::follow(std::span<const Pose<frame::Patient, frame::Bone>> poses) noexcept {
  bool is_still = is_laid_;
  for (std::size_t c = 0; c < carriers_.size(); ++c) {
    if (carriers_[c] >= poses.size()) continue;
    is_still = is_still && laid_by_[c] == poses[carriers_[c]];
    laid_by_[c] = poses[carriers_[c]];
  }
  if (is_still) return;
  is_laid_ = true;
  const DualQuaternion hand = motion_of(poses, hand_);
  for (Tube& tube : tubes_) {
    const DualQuaternion forearm = motion_of(poses, tube.forearm);
    Vec3 low = {1e9, 1e9, 1e9};
    Vec3 high = -low;
    for (std::size_t i = tube.first; i < tube.first + tube.count; ++i) {
      RigidBlend blend;
      blend.add(forearm, 1.0 - hand_share_[i]);
      blend.add(hand, hand_share_[i]);
      now_[i] = blend.moved(scanned_[i]);
      for (std::size_t a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], now_[i][a]);
        high[a] = std::max(high[a], now_[i][a]);
      }
    }
    tube.longest_step_mm = kLeastStepMm;
    for (std::size_t i = tube.first + 1; i < tube.first + tube.count; ++i) {
      tube.longest_step_mm = std::max(tube.longest_step_mm, distance(now_[i - 1], now_[i]));
    }
    tube.middle = (low + high) * 0.5;
    tube.reach_mm = distance(low, high) * 0.5 + tube.radius_mm;
  }
}

double LaidStructures::gap_mm(std::size_t tube,
                              const Vec3& from,
                              const Vec3& to,
                              double below_mm) const noexcept {
  const Tube& t = tubes_[tube];
  const double reach = segment_distance(from, to, t.middle, t.middle) - t.reach_mm;
  if (!(reach < below_mm)) return below_mm;
  double least = below_mm + t.radius_mm;
  for (std::size_t i = t.first + 1; i < t.first + t.count;) {
    const double away = segment_distance(from, to, now_[i - 1], now_[i]);
    least = std::min(least, away);
    // So many pieces farther on nothing can be nearer than what was found.
    i += 1 + static_cast<std::size_t>((away - least) / t.longest_step_mm);
  }
  return least - t.radius_mm;
}

}  // namespace carpus::cases
