// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "phantom/scan_conditions.hpp"

#include <algorithm>

namespace carpus::phantom {
namespace {

double between(double mild, double severe, double t) { return mild + (severe - mild) * t; }

}  // namespace

std::string_view name_of(Condition condition) noexcept {
  switch (condition) {
    case Condition::SmoothKernel:
      return "smooth_kernel";
    case Condition::SharpKernel:
      return "sharp_kernel";
    case Condition::BeamHardening:
      return "beam_hardening";
    case Condition::Metal:
      return "metal";
    case Condition::Motion:
      return "motion";
    case Condition::ThickSlices:
      return "thick_slices";
    case Condition::LowDose:
      return "low_dose";
    case Condition::Table:
      return "table";
    case Condition::Cast:
      return "cast";
    case Condition::Oblique:
      return "oblique";
    case Condition::ShortForearm:
      return "short_forearm";
    case Condition::ShortHand:
      return "short_hand";
    case Condition::Osteoporosis:
      return "osteoporosis";
    case Condition::DenseBone:
      return "dense_bone";
    case Condition::OtherAnatomy:
      return "other_anatomy";
    case Condition::ScapholunateGap:
      return "scapholunate_gap";
    case Condition::Fused:
      return "fused";
    case Condition::Screw:
      return "screw";
    case Condition::CutOff:
      return "cut_off";
    case Condition::WholeHand:
      return "whole_hand";
    case Condition::Bipartite:
      return "bipartite";
    case Condition::LunateTypeTwo:
      return "lunate_type_two";
  }
  return "";
}

std::optional<Condition> condition_of(std::string_view name) noexcept {
  for (const Condition condition : kAllConditions) {
    if (name_of(condition) == name) return condition;
  }
  return std::nullopt;
}

void apply(Condition condition, double severity, ScanOptions& o) noexcept {
  const double t = std::clamp(severity, 0.0, 1.0);
  switch (condition) {
    case Condition::SmoothKernel:
      o.point_spread_fwhm_mm = between(0.75, 1.3, t);
      break;
    case Condition::SharpKernel:
      o.edge_enhancement = between(0.3, 1.0, t);
      o.noise_hu *= 1.6;
      break;
    case Condition::BeamHardening:
      o.beam_hardening_hu = between(60, 250, t);
      break;
    case Condition::Metal:
      o.metal_radius_mm = between(0.5, 0.9, t);
      o.metal_streaks_hu = between(150, 700, t);
      break;
    case Condition::Motion:
      o.motion_step_mm = between(0.4, 3.0, t);
      break;
    case Condition::ThickSlices:
      o.slice_mm = between(1.0, 2.0, t);
      break;
    case Condition::LowDose:
      o.noise_hu *= between(1.6, 4.5, t);
      break;
    case Condition::Table:
      o.has_table = true;
      break;
    case Condition::Cast:
      o.cast_mm = between(3, 6, t);
      o.cast_hu = between(150, 700, t);
      break;
    case Condition::Oblique:
      o.tilt_degrees = between(15, 40, t);
      break;
    case Condition::ShortForearm:
      o.proximal_reach_mm = between(20, 9, t);
      break;
    case Condition::ShortHand:
      o.distal_reach_mm = between(46, 38, t);
      break;
    case Condition::Osteoporosis:
      o.bone_density = between(0.8, 0.45, t);
      o.cortex_thickness = between(0.9, 0.6, t);
      break;
    case Condition::DenseBone:
      o.bone_density = between(1.15, 1.6, t);
      break;
    case Condition::OtherAnatomy:
      o.warp_mm = between(0.8, 2.5, t);
      o.size_variation = between(0.03, 0.08, t);
      break;
    case Condition::ScapholunateGap:
      o.scapholunate_gap_mm = between(1.0, 3.0, t);
      break;
    case Condition::Fused:
      o.is_fused = true;
      break;
    case Condition::Screw:
      o.is_screw = true;
      o.metal_radius_mm = between(1.2, 1.7, t);
      o.metal_streaks_hu = between(200, 900, t);
      break;
    case Condition::CutOff:
      o.cut_off_mm = between(4, 16, t);
      break;
    case Condition::WholeHand:
      o.has_fingers = true;
      o.distal_reach_mm = between(90, 160, t);
      break;
    case Condition::Bipartite:
      o.bipartite_mm = between(0.8, 1.6, t);
      break;
    case Condition::LunateTypeTwo:
      o.hamate_facet_mm = between(1.5, 3.0, t);
      break;
  }
}

}  // namespace carpus::phantom
