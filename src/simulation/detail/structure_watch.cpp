// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/structure_watch.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/rigid_blend.hpp"

namespace carpus::simulation::detail {
namespace {

std::uint8_t body_of(const cases::CaseData& data, BoneId bone) {
  for (std::size_t b = 0; b < data.bones.size(); ++b) {
    if (data.bones[b].bone == bone) return static_cast<std::uint8_t>(b);
  }
  return kNoBody;
}

/// The forearm's bone, or the other one where it is missing.
std::uint8_t forearm_of(const cases::CaseData& data, BoneId bone) {
  const std::uint8_t own = body_of(data, bone);
  if (own != kNoBody) return own;
  return body_of(data, bone == BoneId::Radius ? BoneId::Ulna : BoneId::Radius);
}

DualQuaternion motion_of(std::span<const Pose<frame::Patient, frame::Bone>> poses,
                         std::uint8_t body) noexcept {
  if (body >= poses.size()) return {};
  return dual_quaternion(poses[body].rotation, poses[body].translation);
}

/// Steps are taken to be no shorter, so that one can be divided by [mm].
constexpr double kLeastStepMm = 0.1;

double held_to_unit(double t) noexcept { return t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t; }

}  // namespace

bool is_possible(const StructureState& state,
                 std::size_t structures,
                 std::size_t instruments) noexcept {
  if (state.count != structures || structures > cases::kMaxStructures) return false;
  for (std::size_t i = 0; i < state.count; ++i) {
    const StructureHarm& harm = state.harm[i];
    const bool is_near =
        harm.least_mm <= kFarFromStructureMm && harm.least_mm >= -kFarFromStructureMm;
    if (!is_near || (harm.by != kNoInstrument && harm.by >= instruments)) return false;
  }
  return true;
}

StructureWatch::StructureWatch(const cases::CaseData& data)
    : hand_(body_of(data, BoneId::Capitate)),
      carriers_{hand_, body_of(data, BoneId::Radius), body_of(data, BoneId::Ulna)} {
  const std::size_t count = std::min(data.structures.size(), cases::kMaxStructures);
  for (std::size_t i = 0; i < count; ++i) {
    const cases::Structure& s = data.structures[i];
    tubes_.push_back(
        {scanned_.size(), s.course.size(), s.radius_mm, forearm_of(data, s.forearm), {}, 0.0, 0.0});
    for (const cases::StructurePoint& p : s.course) {
      scanned_.push_back(p.at);
      hand_share_.push_back(p.hand_share);
    }
  }
  now_ = scanned_;
}

void StructureWatch::follow(std::span<const Pose<frame::Patient, frame::Bone>> poses) noexcept {
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

double StructureWatch::gap_mm(std::size_t tube,
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

double segment_distance(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) noexcept {
  const Vec3 u = a1 - a0;
  const Vec3 v = b1 - b0;
  const Vec3 w = a0 - b0;
  const double a = dot(u, u);
  const double e = dot(v, v);
  const double f = dot(v, w);
  double s = 0.0;
  double t = 0.0;
  if (!(a > 0.0)) {
    t = e > 0.0 ? held_to_unit(f / e) : 0.0;
  } else {
    const double c = dot(u, w);
    if (!(e > 0.0)) {
      s = held_to_unit(-c / a);
    } else {
      const double b = dot(u, v);
      const double denominator = a * e - b * b;
      s = denominator > 0.0 ? held_to_unit((b * f - c * e) / denominator) : 0.0;
      t = (b * s + f) / e;
      if (t < 0.0) {
        t = 0.0;
        s = held_to_unit(-c / a);
      } else if (t > 1.0) {
        t = 1.0;
        s = held_to_unit((b - c) / a);
      }
    }
  }
  return distance(a0 + u * s, b0 + v * t);
}

}  // namespace carpus::simulation::detail
