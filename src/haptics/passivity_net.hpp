// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A net below a device's own account of energy [hannaford2002passivity]: the host books the work
// that the device says its force did on the hand, and takes its share back where more came out than
// went in. It stabilises nothing by itself; it ends what should not have begun.
#pragma once

#include "geometry/vec3.hpp"

namespace carpus::haptics {

/// Half a millijoule [N mm]: below it, noise of the book itself.
inline constexpr double kNetSlackNMm = 0.5;
/// Ticks until a device that was caught has its whole share again.
inline constexpr int kNetRecoveryTicks = 200;

/// Real-time; once a tick.
class PassivityNet {
 public:
  /// @param force  that the contact did on the hand, as the device reports it [N], without weight.
  /// @param tip  where it was then [mm].
  /// @return share of its stiffness that the device may have, 0 to 1.
  [[nodiscard]] double share(const Vec3& force, const Vec3& tip) noexcept;
  /// Out of contact: the book is closed.
  void close() noexcept;
  [[nodiscard]] double given_n_mm() const noexcept { return given_n_mm_; }
  [[nodiscard]] int catches() const noexcept { return catches_; }

 private:
  Vec3 force_;
  Vec3 tip_;
  double given_n_mm_ = 0;
  double share_ = 1;
  int catches_ = 0;
  bool has_tip_ = false;
};

}  // namespace carpus::haptics
