// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Contact for drive A, whose legs can be stopped but not pushed: the legs' angles at the place on
// the surface where the tip may be, each closed to the side that leads into the bone. Legs that the
// surface's normal hardly turns stay free, or sliding would rub.
//
// A stop that moves while a leg leans on it does work on the hand: legs never meet their stops all
// at once, and the one that does would be driven along the surface, and push. So the stop of a leg
// that leans on it, or nearly, may give way but not come nearer.
//
#pragma once

#include <array>

#include "arm/arm_weight.hpp"
#include "firmware/core/delta.hpp"
#include "firmware/core/wire.hpp"
#include "haptics/local_planes.hpp"

namespace carpus::haptics {

/// A leg that turns less than this share of the one that turns most is left free. At a third, a
/// hand that pressed obliquely sank by 4 mm, along the way that the free leg left it.
inline constexpr double kLeastTurnShare = 0.1;
/// Of the slide along the surface [s]: longer, and stops pump energy into the hand.
inline constexpr double kSlideLeadS = 0.025;
/// What a leg yields under load, of data sheets: the pad at the slot's edge; the servo's dead band;
/// and, beyond what its gears' friction bears, as far as it must be turned to give so much.
struct LegYield {
  double pad_n_mm_per_rad = 20'000;
  double dead_band_rad = 0.0035;
  double friction_n_mm = 80;
  double servo_n_mm_per_rad = 235 / 0.0698;
};

/// Stops stand outside the surface by half of what the legs yield together under this press along
/// its normal, and by what the weight makes them yield that no cord carries: 0.4 mm above the tip,
/// where three legs bear it, 0.9 mm beside it, where one does; in the corners of the workspace
/// more, but a wall is not met farther before it than it is deep.
inline constexpr double kEarlyForPressN = 2;
inline constexpr double kMostEarlyMm = 1.1;
/// @param weight_n_mm  torques that hold the rest of the arm's weight up.
[[nodiscard]] double early_mm(const firmware::DeltaState<double>& state,
                              const Vec3& normal,
                              const arm::LegAngles& weight_n_mm = {},
                              const LegYield& yield = {}) noexcept;

/// A surface farther than this is no matter yet [mm].
inline constexpr double kNearSurfaceMm = 25;

/// Nearer to its stop than this a leg may lean on it: dead band, pulse and potentiometer may be so
/// wrong together [rad].
inline constexpr double kLeansRad = 0.017;

class LegStops {
 public:
  /// @param plane  in the device's frame. @param angles, tip, velocity  of the legs [rad], of the
  /// tip [mm], [mm/s]. All legs free where the plane is far, out of reach or not finite. Real-time.
  [[nodiscard]] firmware::Stop at(const arm::DeltaArm& arm,
                                  const SurfacePlane& plane,
                                  const arm::LegAngles& angles,
                                  const Vec3& tip,
                                  const Vec3& velocity) noexcept;
  /// No surface is near: all legs free.
  [[nodiscard]] firmware::Stop free() noexcept;

 private:
  arm::LegAngles stops_{};
  std::array<firmware::LegStopSide, 3> sides_{};
};

}  // namespace carpus::haptics
