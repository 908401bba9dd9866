// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "phantom/tissue.hpp"

#include <algorithm>
#include <cmath>

#include "phantom/coherent_noise.hpp"

namespace carpus::phantom {
namespace {

constexpr double kCortexHu = 1280;
constexpr double kShaftCortexHu = 1500;
constexpr double kCortexVariation = 0.13;  // of its HU, over 4 mm
constexpr double kCoreHu = 250;
constexpr double kCoreNearCortexHu = 170;  // added just below the cortex, gone within 2 mm
constexpr double kCoreDecayMm = 1.2;
constexpr double kMarrowHu = 30;
constexpr double kJointCortexMm = 0.75;
constexpr double kMetacarpalShaftCortexMm = 1.7;
constexpr double kForearmShaftCortexMm = 2.1;
constexpr double kThicknessVariation = 0.25;
/// From cortex to core over this much [mm].
constexpr double kCortexEdgeMm = 0.3;
/// The cortices of a fracture in place still touch: of what the line takes out of the core.
constexpr double kCortexLost = 0.3;
constexpr double kSclerosisHu = 620;
constexpr double kSclerosisDecayMm = 1.7;
constexpr double kCystHu = 70;

double mix(double a, double b, double t) { return a + (b - a) * t; }

}  // namespace

BoneTissue::BoneTissue(const BoneShapes& shapes, const LongAxis& scaphoid_axis, std::uint64_t seed)
    : shapes_(&shapes), scaphoid_(scaphoid_axis), seed_(seed) {}

double BoneTissue::core(const Shape& shape, const Vec3& p, double depth_mm) const noexcept {
  double level = kCoreHu;
  if (shape.bone == BoneId::Scaphoid) {  // denser towards the proximal pole
    const double part = (dot(scaphoid_.direction, p - scaphoid_.centroid) - scaphoid_.least) /
                        (scaphoid_.greatest - scaphoid_.least);
    level = mix(410, 240, smooth_step(0.15, 0.55, part));
  }
  const double texture =
      75 * coherent_noise(p, 0.75, seed_) + 55 * coherent_noise(p, 2.4, seed_ + 1);
  double hu = level + kCoreNearCortexHu * std::exp(-depth_mm / kCoreDecayMm) + texture;
  if (shape.part != BonePart::Whole && shapes_->fracture()->is_old) {
    const double from_face = std::max(0.0, shapes_->depth_from_fracture(shape.part, p));
    hu += kSclerosisHu * std::exp(-from_face / kSclerosisDecayMm) *
          (1 + 0.4 * coherent_noise(p, 1.6, seed_ + 2));
    const double cyst =
        distance(p, shapes_->fracture()->cyst) - shapes_->fracture()->cyst_radius_mm;
    hu = mix(kCystHu, hu, smooth_step(-0.2, 0.3, cyst));
  }
  return hu;
}

double BoneTissue::hounsfield(const Shape& shape, const Vec3& p, double depth_mm) const noexcept {
  const double shaft = shapes_->shaft_fraction(shape.bone, p);
  const double shaft_cortex_mm =
      belongs_to_forearm(shape.bone) ? kForearmShaftCortexMm : kMetacarpalShaftCortexMm;
  const double thickness = mix(kJointCortexMm, shaft_cortex_mm, shaft) *
                           (1 + kThicknessVariation * coherent_noise(p, 3.5, seed_ + 3));
  const double cortex = mix(kCortexHu, kShaftCortexHu, shaft) *
                        (1 + kCortexVariation * coherent_noise(p, 4.0, seed_ + 4));
  const double inside =
      mix(core(shape, p, depth_mm), kMarrowHu + 12 * coherent_noise(p, 1.5, seed_ + 5), shaft);
  const double below_cortex = smooth_step(thickness, thickness + kCortexEdgeMm, depth_mm);
  const double whole = mix(cortex, inside, below_cortex);
  if (shape.bone != BoneId::Scaphoid || shape.part != BonePart::Whole || !shapes_->fracture()) {
    return whole;
  }
  const double lost = shapes_->fracture()->lost_share(p) * mix(kCortexLost, 1.0, below_cortex);
  return mix(whole, gap_hounsfield(p), lost);
}

double BoneTissue::gap_hounsfield(const Vec3& p) const noexcept {
  return shapes_->fracture()->gap_hounsfield + 35 * coherent_noise(p, 1.3, seed_ + 6);
}

}  // namespace carpus::phantom
