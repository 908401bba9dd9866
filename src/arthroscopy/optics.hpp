// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An arthroscope's optics: where it looks and where a point falls in its round picture. The shaft
// turns apart from the camera head: the one turns where it looks, the other which way is up. All
// directions and points are of one frame, Patient in the simulation.
#pragma once

#include <array>
#include <optional>

#include "geometry/vec3.hpp"

namespace carpus::arthroscopy {

/// Of one scope (instruments::Optic).
struct Lens {
  double view_angle_deg = 30;  ///< of the line of sight from the shaft: 0, 30 or 70
  double field_deg = 80;       ///< across the round picture
};

/// How a scope is held.
struct ScopeHold {
  Vec3 tip;                   ///< [mm]
  Vec3 shaft{0, 0, 1};        ///< unit, from the tip towards the hand
  double shaft_turn_deg = 0;  ///< at 0 it looks towards `level`, turning right-handed about `shaft`
  double camera_turn_deg = 0;  ///< at 0 the picture's up is `level`; likewise
};

/// Where it looks: a right-handed frame of unit vectors, right x up = -axis.
struct Sight {
  Vec3 eye;
  Vec3 axis;
  Vec3 up;
  Vec3 right;
  double least_cosine = 1;  ///< of half the field: less is outside the round picture
};

/// Cosine and sine of any angle, by + - * / and polynomials: the same bits on every machine.
/// @param angle_deg  finite, within +-1e6.
[[nodiscard]] std::array<double, 2> cos_sin_deg(double angle_deg) noexcept;

/// @param level  the direction that is up in a level picture; need not lie across the shaft.
/// Real-time: only + - * / and sqrt.
[[nodiscard]] Sight sight_of(const Lens& lens, const ScopeHold& hold, const Vec3& level) noexcept;

/// Whether the point falls into the round picture, whatever stands before it. Real-time.
[[nodiscard]] bool is_in_field(const Sight& sight, const Vec3& point) noexcept;

/// Cosine of the angle by which the picture's up is off what is level; 1 where no way is level
/// (looking along it). Real-time.
[[nodiscard]] double horizon_cosine(const Sight& sight, const Vec3& level) noexcept;

/// From the picture's middle, to the right and down, in pixels of a round picture of this diameter.
/// The lens draws angles from its axis equally long (equidistant), as wide ones nearly do [E].
struct Pixel {
  double right = 0;
  double down = 0;
};
/// Empty where the point is outside the field. Uses trigonometry: not for a tick.
[[nodiscard]] std::optional<Pixel> project(const Lens& lens,
                                           const Sight& sight,
                                           double diameter_px,
                                           const Vec3& point);

}  // namespace carpus::arthroscopy
