// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Contact as a device renders it by itself between two ticks of the host: planes near the tip
// [adachi1995intermediate], in the device's frame. The wire has no more than two.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "firmware/core/wire.hpp"
#include "geometry/vec3.hpp"
#include "haptics/force_limiter.hpp"

namespace carpus::haptics {

/// How a surface feels.
struct SurfaceFeel {
  double stiffness_n_per_mm = 2;
  /// By its stiffness [s]: 2 ms, as far as a velocity filtered at 150 Hz carries it.
  double damping_s = 0.002;
  double friction = 0;  ///< 0 to 1.99
};

struct SurfacePlane {
  Vec3 normal;           ///< unit, out of the bone
  double offset_mm = 0;  ///< normal . x on the plane
  SurfaceFeel feel;
};

/// What the hand is to feel in the next tick.
struct HapticWish {
  std::array<SurfacePlane, 2> planes;
  std::size_t plane_count = 0;
  Vec3 besides_n;  ///< the arm's weight held up, a drill's thrust
  double limit_n = 8;
  double vibration_n = 0;
  double vibration_hz = 0;
};

/// The plane that stands for a contact which holds the tip at `proxy` while the hand is at `hand`
/// [zilles1995godobject]; none where they are one. @param surface_normal  of the bone there, where
/// it is known: taken when the two are too near to tell a direction.
[[nodiscard]] std::optional<SurfacePlane> plane_at(const Vec3& proxy,
                                                   const Vec3& hand,
                                                   const Vec3& surface_normal,
                                                   const SurfaceFeel& feel) noexcept;

/// Drive B's frame. What is not finite is left out; the limiter has the last word. @param share  of
/// stiffness, from a PassivityNet. Real-time.
[[nodiscard]] firmware::Contact contact_frame(const HapticWish& wish,
                                              double share,
                                              ForceLimiter& limiter) noexcept;

}  // namespace carpus::haptics
