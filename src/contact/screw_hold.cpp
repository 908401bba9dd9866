// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "contact/screw_hold.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fields/removed_share.hpp"
#include "geometry/trilinear.hpp"

namespace carpus::contact {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kStepMm = 0.5;
constexpr int kMostSteps = 256;
constexpr int kShells = 3;

/// Width over which a surface or a cut's edge is smoothed [mm]: half a voxel of the CT.
constexpr double kEdgeMm = 0.2;

constexpr double kCos30 = 0.86602540378443865;
constexpr std::array<std::array<double, 2>, 12> kAround{{{1, 0},
                                                         {kCos30, 0.5},
                                                         {0.5, kCos30},
                                                         {0, 1},
                                                         {-0.5, kCos30},
                                                         {-kCos30, 0.5},
                                                         {-1, 0},
                                                         {-kCos30, -0.5},
                                                         {-0.5, -kCos30},
                                                         {0, -1},
                                                         {0.5, -kCos30},
                                                         {kCos30, -0.5}}};

}  // namespace

ScrewHold screw_hold(const fields::CutBone& left,
                     const GridView<const std::int16_t>& ct,
                     const ThreadedCylinderShape& screw,
                     const Pose<frame::Bone, frame::Tool>& bone_from_screw) noexcept {
  ScrewHold hold;
  const double wanted = std::ceil(screw.length_mm / kStepMm);
  if (!(wanted >= 1 && screw.core_radius_mm < screw.crest_radius_mm)) return hold;
  const int steps = static_cast<int>(std::min(wanted, static_cast<double>(kMostSteps)));
  const double step = screw.length_mm / steps;
  const double inner = screw.core_radius_mm * screw.core_radius_mm;
  const double outer = screw.crest_radius_mm * screw.crest_radius_mm;
  constexpr double kPlaces = kShells * 12;
  const double volume = kPi * (outer - inner) * step / kPlaces;
  double bitten = 0;
  for (int i = 0; i < steps; ++i) {
    double ring = 0;
    for (int shell = 0; shell < kShells; ++shell) {
      // Of equal areas.
      const double radius = std::sqrt(inner + (outer - inner) * (shell + 0.5) / kShells);
      for (const auto& [x, y] : kAround) {
        const Point<frame::Tool> in_screw{{radius * x, radius * y, (i + 0.5) * step}};
        const Vec3 p = (bone_from_screw * in_screw).v;
        const double in_bone = std::clamp(0.5 - left.bone.sample(p) / kEdgeMm, 0.0, 1.0);
        if (!(in_bone > 0)) continue;
        const double hu = sample_at(ct, p, fields::kHoleHu);
        const double dense =
            std::clamp((hu - fields::kHoleHu) / (kDenseHu - fields::kHoleHu), 0.0, 1.0);
        const double whole = volume * in_bone * dense;
        const double share = 1 - left.cut.removed_share(p, kEdgeMm);
        hold.whole_mm3 += whole;
        hold.bone_mm3 += whole * share;
        ring += in_bone * share;
      }
    }
    if (ring >= 0.5 * kPlaces) bitten += step;
  }
  hold.turns = bitten / screw.pitch_mm;
  return hold;
}

SweptTool stripped_thread(const ThreadedCylinderShape& screw,
                          const Pose<frame::Bone, frame::Tool>& bone_from_screw,
                          double share) noexcept {
  const double radius = screw.core_radius_mm + std::clamp(share, 0.0, 1.0) *
                                                   (screw.crest_radius_mm - screw.core_radius_mm);
  const Vec3 shaft = bone_from_screw.rotation.column(2);
  // Round ends as the core's: the thread ends where it does.
  const double end = std::min(screw.crest_radius_mm, 0.5 * screw.length_mm);
  return SweptTool::bar(bone_from_screw.translation + shaft * end, radius,
                        bone_from_screw.translation + shaft * (screw.length_mm - end), radius);
}

double stripping_compression_n(double tip_share, double tail_share) noexcept {
  return kGreatestCompressionN * std::clamp(std::min(tip_share, tail_share), 0.0, 1.0);
}

}  // namespace carpus::contact
