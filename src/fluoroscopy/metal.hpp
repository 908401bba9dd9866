// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Wires, screws and shafts as X-rays see them: round rods, tapered, hollow or threaded.
#pragma once

#include "geometry/vec3.hpp"

namespace carpus::fluoroscopy {

/// Attenuation at 40 keV [1/mm], [hubbell2004tables]: iron 3.629 cm2/g at 8.0 g/cm3 stands for
/// implant steel, titanium 2.214 cm2/g at 4.51 g/cm3.
inline constexpr double kSteelPerMm = 2.90;
inline constexpr double kTitaniumPerMm = 1.00;

/// A rod of metal, frame Patient. Its ends are flat.
struct MetalCylinder {
  Vec3 start;                    ///< [mm]
  Vec3 end;                      ///< [mm]
  double start_radius_mm = 0.0;  ///< outer, over the thread's crests
  double end_radius_mm = 0.0;
  double bore_radius_mm = 0.0;   ///< of a cannulated screw; 0 for solid
  double thread_depth_mm = 0.0;  ///< crest minus root; 0 for smooth
  double thread_pitch_mm = 1.0;  ///< used with a thread
  double attenuation_per_mm = kSteelPerMm;
};

/// A smooth round wire of steel, such as a 1.14 mm guide wire.
[[nodiscard]] inline MetalCylinder make_wire(const Vec3& start,
                                             const Vec3& end,
                                             double diameter_mm) {
  return {start, end, diameter_mm / 2, diameter_mm / 2, 0.0, 0.0, 1.0, kSteelPerMm};
}

/// A cannulated headless screw of titanium, threaded all along. Thread and clearance of the bore
/// are engineering values for the picture's sake; the score knows only length and place.
[[nodiscard]] inline MetalCylinder make_headless_screw(const Vec3& tail,
                                                       const Vec3& tip,
                                                       double tail_diameter_mm,
                                                       double tip_diameter_mm,
                                                       double wire_diameter_mm) {
  constexpr double kBoreClearanceMm = 0.05;
  constexpr double kThreadDepthMm = 0.35;
  constexpr double kThreadPitchMm = 1.1;
  return {tail,
          tip,
          tail_diameter_mm / 2,
          tip_diameter_mm / 2,
          wire_diameter_mm / 2 + kBoreClearanceMm,
          kThreadDepthMm,
          kThreadPitchMm,
          kTitaniumPerMm};
}

/// Attenuation (dimensionless) along the straight line from `from` to `to` [mm], by how much metal
/// it crosses: exact for a smooth rod of one radius, by samples of at most 0.05 mm for others. A
/// rod without length or radius attenuates nothing. Tissue that the metal displaces is not
/// subtracted: 3 % of steel's attenuation, 8 % of titanium's, in densest bone.
[[nodiscard]] double line_integral(const MetalCylinder& rod,
                                   const Vec3& from,
                                   const Vec3& to) noexcept;

}  // namespace carpus::fluoroscopy
