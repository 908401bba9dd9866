// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What scanners and patients do to a CT, by name: each changes some of ScanOptions, more or less of
// it by its severity. The physics is that of the fields below.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace carpus::phantom {

/// How the scan is made, and how this patient differs from the model; the defaults are the demo
/// patient's.
struct ScanOptions {
  // The scanner.
  double point_spread_fwhm_mm = 0.6;  ///< Gaussian of the reconstruction kernel
  /// A sharp kernel: MTF G(f) (1 + e (1 - H(f))), H a Gaussian of 0.9 mm FWHM; 0 none, 1 strong.
  double edge_enhancement = 0;
  double noise_hu = 24;  ///< in soft tissue, after the kernel; goes with 1 / sqrt(dose)
  /// Each slice is the mean over its own thickness, made of slices of about 0.5 mm.
  double slice_mm = 0;
  /// Darkening by a path through 20 mm of cortical bone [HU]: the second order of the
  /// polychromatic attenuation, summed along four directions of each axial slice.
  double beam_hardening_hu = 0;
  double metal_radius_mm = 0;  ///< of a steel wire or screw left in the scaphoid; 0 none
  bool is_screw = false;       ///< within the bone; a wire stands out of its distal pole
  double metal_streaks_hu = 0;
  double motion_step_mm = 0;  ///< the arm moves across once, at a slice near the middle
  bool has_table = false;     ///< a sandwich of two dense layers below the arm
  double cast_mm = 0;         ///< thickness of a splint around the skin; 0 none
  double cast_hu = 600;       ///< plaster; fibreglass has about 150
  // Positioning.
  double tilt_degrees = 4;        ///< of the arm, random up to this about each axis
  double proximal_reach_mm = 32;  ///< field of view from the wrist's origin towards the elbow
  double distal_reach_mm = 54;    ///< and towards the fingers
  double width_mm = 96;           ///< across, at most
  double cut_off_mm = 0;          ///< of the arm, at one side, out of the field of view
  // The patient.
  double bone_density = 1;  ///< of cortex and core; 0.5 is severe osteoporosis
  double cortex_thickness = 1;
  /// Another anatomy: all of space bent smoothly (waves of 9 to 16 mm), by up to this.
  double warp_mm = 0;
  double size_variation = 0;       ///< each bone smaller by up to this part
  double scapholunate_gap_mm = 0;  ///< the lunate moves off, and extends by 6 degrees a mm (DISI)
  bool is_fused = false;           ///< lunate and triquetrum grown together
  double bipartite_mm = 0;     ///< one carpal bone is two from birth, with so wide a joint between
  double hamate_facet_mm = 0;  ///< a lunate of type II: how far its corner reaches to the hamate
  bool has_fingers = false;    ///< metacarpals are whole and phalanges follow
};

enum class Condition : std::uint8_t {
  SmoothKernel,
  SharpKernel,
  BeamHardening,
  Metal,
  Motion,
  ThickSlices,
  LowDose,
  Table,
  Cast,
  Oblique,
  ShortForearm,
  ShortHand,
  Osteoporosis,
  DenseBone,
  OtherAnatomy,
  ScapholunateGap,
  Fused,
  Screw,
  CutOff,
  WholeHand,
  Bipartite,
  LunateTypeTwo,
};
inline constexpr std::array<Condition, 22> kAllConditions{
    Condition::SmoothKernel,    Condition::SharpKernel,  Condition::BeamHardening,
    Condition::Metal,           Condition::Motion,       Condition::ThickSlices,
    Condition::LowDose,         Condition::Table,        Condition::Cast,
    Condition::Oblique,         Condition::ShortForearm, Condition::ShortHand,
    Condition::Osteoporosis,    Condition::DenseBone,    Condition::OtherAnatomy,
    Condition::ScapholunateGap, Condition::Fused,        Condition::Screw,
    Condition::CutOff,          Condition::WholeHand,    Condition::Bipartite,
    Condition::LunateTypeTwo};

/// "smooth_kernel", "sharp_kernel", ...
[[nodiscard]] std::string_view name_of(Condition condition) noexcept;
[[nodiscard]] std::optional<Condition> condition_of(std::string_view name) noexcept;

/// Changes `options` as the condition does; severity from 0 (just seen) to 1 (the worst that is
/// still sent for an operation).
void apply(Condition condition, double severity, ScanOptions& options) noexcept;

}  // namespace carpus::phantom
