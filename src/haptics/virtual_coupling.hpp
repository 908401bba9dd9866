// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The force law: a virtual coupling [colgate1995coupling] between the hand and the place where its
// instrument may be (the proxy [zilles1995godobject]), a spring and a damper, never stronger than
// the limit, and passive by an energy account [hannaford2002passivity]: whatever the proxy does,
// the hand never gets back more work than it put in and the account's first kFirstStoredNMm, and as
// much again each time that an account that is used up is let go, or drawn away from what is fast.
//
// The account E holds that first store and what the hand put in less what it got. In the next tick
// the force f does at most |f| w of work on the hand, w = max(0, d.f/|f| + kMostSurpriseMm), where
// d is the hand's last move and kMostSurpriseMm what an arm of flesh can add to it in a tick. The
// force is scaled until |f| w <= E. So E stays >= 0 for every hand that accelerates no faster than
// that. One that jumps is no hand: it feels nothing in that tick and has nothing in store but the
// first. Without a first store no force could ever begin: a still hand might be about to leave.
#pragma once

#include <cstdint>

#include "geometry/vec3.hpp"

namespace carpus::haptics {

/// What a cheap device renders stably on cartilage: 1 to 3 N/mm [clinical: B11 E].
inline constexpr double kContactStiffnessNPerMm = 2.0;
inline constexpr double kContactDampingNSPerMm = 0.003;

/// Above the greatest thrust that bone asks for (B11: 40 N); a device has its own, lower limit.
inline constexpr double kForceLimitN = 40.0;

/// 20 microjoules: a tenth of what a key of a keyboard gives back [E].
inline constexpr double kFirstStoredNMm = 0.02;

/// Less in store lets no force begin: a hundredth of a newton could not be answered for [E].
inline constexpr double kUsedUpNMm = 0.0005;

/// 50 m/s2 over a tick of 1 ms, ten times what a hand reaches in a fast tap [E].
inline constexpr double kMostSurpriseMm = 0.05;

/// One hand's coupling. Plain data; real-time.
class VirtualCoupling {
 public:
  /// The force on the hand for the next tick [N]; zero where anything is not finite.
  /// @param proxy, hand  same frame [mm].
  /// @param limit_n  greatest magnitude, at most kForceLimitN counts.
  [[nodiscard]] Vec3 force_n(const Vec3& proxy, const Vec3& hand, double limit_n) noexcept;

  /// No force, and nothing stored: an empty hand, a paused or stalled exercise. @param hand  [mm].
  void release(const Vec3& hand) noexcept;

  /// Nothing holds the hand: an account that the proxy's own moves have used up begins anew with
  /// its first store. Else no force could ever begin again, as none is felt against which to work.
  void let_go() noexcept;

  /// What the hand holds is stuck: as let_go() for a hand that draws away from there. It would feel
  /// nothing for as long a way as it was given back before, and is never let go as it is held.
  /// @param proxy, hand  as force_n() is to get them.
  void hold_fast(const Vec3& proxy, const Vec3& hand) noexcept;

  /// What the hand has put in and not got back [N mm]; not negative.
  [[nodiscard]] double stored_n_mm() const noexcept { return stored_n_mm_; }
  /// Forces that were not finite since the last call.
  [[nodiscard]] std::uint64_t take_faults() noexcept {
    const std::uint64_t faults = faults_;
    faults_ = 0;
    return faults;
  }

  /// Shows every field that decides the future, in a fixed order.
  template <typename Coupling, typename Visitor>
  friend void visit_coupling(Coupling& coupling, Visitor&& v) noexcept {
    v(coupling.stored_n_mm_);
    v(coupling.force_);
    v(coupling.hand_);
    v(coupling.move_);
    v(coupling.has_hand_);
  }

 private:
  double stored_n_mm_ = kFirstStoredNMm;
  Vec3 force_;  ///< that the hand felt since the last tick
  Vec3 hand_;   ///< where it was then
  Vec3 move_;   ///< its move before that
  bool has_hand_ = false;
  std::uint64_t faults_ = 0;
};

}  // namespace carpus::haptics
