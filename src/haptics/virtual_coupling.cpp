// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Settle the account of the last tick -> spring and damper -> limit -> scale to what is stored.
#include "haptics/virtual_coupling.hpp"

#include <algorithm>

#include "core/units.hpp"

namespace carpus::haptics {

void VirtualCoupling::release(const Vec3& hand) noexcept {
  stored_n_mm_ = kFirstStoredNMm;
  force_ = {};
  move_ = {};
  hand_ = hand;
  has_hand_ = is_finite(hand);
}

void VirtualCoupling::let_go() noexcept {
  if (stored_n_mm_ < kUsedUpNMm) stored_n_mm_ = kFirstStoredNMm;
}

void VirtualCoupling::hold_fast(const Vec3& proxy, const Vec3& hand) noexcept {
  if (has_hand_ && dot(hand - hand_, hand - proxy) > 0.0) let_go();
}

Vec3 VirtualCoupling::force_n(const Vec3& proxy, const Vec3& hand, double limit_n) noexcept {
  if (!is_finite(proxy) || !is_finite(hand)) {
    ++faults_;
    stored_n_mm_ = std::min(stored_n_mm_, kFirstStoredNMm);
    force_ = {};
    has_hand_ = false;
    return {};
  }
  const Vec3 move = has_hand_ ? hand - hand_ : Vec3{};
  const bool has_jumped = !has_hand_ || distance(move, move_) > kMostSurpriseMm;
  const double stored = stored_n_mm_ - dot(force_, move);
  stored_n_mm_ = std::max(has_jumped ? std::min(stored, kFirstStoredNMm) : stored, 0.0);
  hand_ = hand;
  move_ = move;
  has_hand_ = true;

  const Vec3 spring = (proxy - hand) * kContactStiffnessNPerMm;
  const double stretch = length(spring);
  force_ = {};
  if (!(stretch > 0.0) || has_jumped) return {};
  // Damping acts along the spring only, and never turns its push into a pull.
  const Vec3 along = spring / stretch;
  const double damping = -kContactDampingNSPerMm * dot(move, along) / kTickSeconds;
  const double limit = std::clamp(limit_n, 0.0, kForceLimitN);
  double magnitude = std::clamp(stretch + damping, 0.0, limit);
  const double way = std::max(0.0, dot(move, along) + kMostSurpriseMm);
  if (magnitude * way > stored_n_mm_) magnitude = stored_n_mm_ / way;
  force_ = along * magnitude;
  if (!is_finite(force_)) {
    ++faults_;
    force_ = {};
  }
  return force_;
}

}  // namespace carpus::haptics
