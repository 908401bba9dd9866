// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "phantom/fracture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/rng.hpp"
#include "core/units.hpp"
#include "phantom/coherent_noise.hpp"

namespace carpus::phantom {
namespace {

constexpr double kSampleStepMm = 0.6;
/// The pivot of the distal fragment lies distal of the fracture: its ligaments hold the far end.
constexpr double kPivotBeyondFractureMm = 4.0;
constexpr int kPowerSteps = 60;
/// A nonunion runs this oblique to the scaphoid's cross-section.
constexpr double kObliquityDegrees = 14.0;
/// A horizontal fracture is at most this far from square to the forearm.
constexpr double kUnevenDegrees = 2.0;
/// From bone to gap across a fresh line [mm], to either side of the face.
constexpr double kLineEdgeMm = 0.1;
/// Of the bone on a fresh line: the faces touch here and there.
constexpr double kLostShare = 0.95;
constexpr double kTouchingShare = 0.2;

/// What makes one kind of fracture. Engineering values within what is seen; a gap or step of less
/// than 1 mm counts as undisplaced.
struct Recipe {
  FractureKind kind;
  double place;  ///< part of the length that is proximal; 0: at the waist
  double gap_mm;
  double least_gap_mm;
  double relief_coarse_mm;
  double relief_fine_mm;
  bool is_horizontal;  ///< see normal_of; otherwise nearly square to the scaphoid's axis
  double flexion_deg;  ///< of the distal fragment
  double step_mm;      ///< of the distal fragment, towards radial
  bool is_apart;
  bool is_old;
  double cyst_radius_mm;
  double gap_hounsfield;
};
constexpr double kAtWaist = 0.0;
constexpr std::array<Recipe, 7> kRecipes{{
    {FractureKind::Waist, kAtWaist, 0.8, 0, 0.12, 0.06, true, 0, 0, false, false, 0, 50},
    {FractureKind::ProximalPole, 0.27, 0.8, 0, 0.12, 0.06, true, 0, 0, false, false, 0, 50},
    {FractureKind::DistalThird, 0.74, 0.8, 0, 0.12, 0.06, true, 0, 0, false, false, 0, 50},
    {FractureKind::Displaced, kAtWaist, 1.5, 0.8, 0.3, 0.15, false, 5, 3.0, true, false, 0, 60},
    {FractureKind::Humpback, kAtWaist, 2.0, 1.0, 0.65, 0.3, false, 24, 0, true, true, 2.2, 110},
    {FractureKind::Nonunion, kAtWaist, 1.7, 0, 0.65, 0.3, false, 8, 0, true, true, 1.2, 150},
    {FractureKind::ProximalNonunion, 0.27, 1.36, 0, 0.65, 0.3, false, 3, 0, true, true, 1.2, 150},
}};

const Recipe& recipe_of(FractureKind kind) {
  return *std::find_if(kRecipes.begin(), kRecipes.end(),
                       [&](const Recipe& each) { return each.kind == kind; });
}

std::vector<Vec3> points_inside_scaphoid(const anatomy::WristModel& model) {
  const Aabb& box = model.bone(BoneId::Scaphoid).bounds;
  std::vector<Vec3> points;
  for (double x = box.low.x; x <= box.high.x; x += kSampleStepMm)
    for (double y = box.low.y; y <= box.high.y; y += kSampleStepMm)
      for (double z = box.low.z; z <= box.high.z; z += kSampleStepMm)
        if (model.signed_value(BoneId::Scaphoid, {x, y, z}) < 0) points.push_back({x, y, z});
  return points;
}

/// Direction of greatest variance by power iteration on the covariance.
Vec3 main_direction(const std::vector<Vec3>& points, const Vec3& centroid) {
  Mat3 c{{Vec3{}, Vec3{}, Vec3{}}};
  for (const Vec3& p : points) {
    const Vec3 d = p - centroid;
    for (std::size_t i = 0; i < 3; ++i) c.rows[i] += d * d[i];
  }
  Vec3 v{-1, 0, 0};  // distal
  for (int i = 0; i < kPowerSteps; ++i) v = normalized_or(c * v, v);
  return v.x < 0 ? v : -v;
}

/// Coordinate of the smallest section between 30 and 60 % of the length, over bins of 2 mm.
double find_waist(const std::vector<Vec3>& points, const LongAxis& axis) {
  const double length_mm = axis.greatest - axis.least;
  double best = 0;
  std::size_t fewest = points.size() + 1;
  for (double part = 0.30; part <= 0.60; part += 0.02) {
    const double middle = axis.least + part * length_mm;
    const auto count =
        static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [&](const Vec3& p) {
          return std::abs(dot(axis.direction, p - axis.centroid) - middle) < 1.0;
        }));
    if (count < fewest) {
      fewest = count;
      best = middle;
    }
  }
  return best;
}

}  // namespace

std::string_view name_of(FractureKind kind) noexcept {
  constexpr std::array<std::string_view, kAllFractureKinds.size()> kNames{
      "none",      "waist",    "proximal_pole", "distal_third",
      "displaced", "humpback", "nonunion",      "proximal_nonunion"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::optional<FractureKind> fracture_of(std::string_view name) noexcept {
  for (const FractureKind kind : kAllFractureKinds) {
    if (name == name_of(kind)) return kind;
  }
  return std::nullopt;
}

double Fracture::height(const Vec3& p) const noexcept {
  return dot(normal, p - point) + relief_coarse_mm * coherent_noise(p, 3.0, seed) +
         relief_fine_mm * coherent_noise(p, 1.2, seed + 1);
}

double Fracture::lost_share(const Vec3& p) const noexcept {
  const double half = 0.5 * lost_mm;
  const double off = std::abs(height(p));
  if (off > half + kLineEdgeMm) return 0;
  const double lost = kLostShare - kTouchingShare * std::max(0.0, coherent_noise(p, 2.0, seed + 2));
  return lost * (1 - smooth_step(half - kLineEdgeMm, half + kLineEdgeMm, off));
}

namespace {

/// "Horizontal oblique": square to the forearm, not to the scaphoid, so that pictures taken square
/// to the forearm look along the fracture. The others are oblique to the scaphoid's section by some
/// degrees, in any direction.
Vec3 normal_of(const Recipe& recipe, const LongAxis& axis, const Vec3& side, Rng& rng) {
  if (recipe.is_horizontal) {
    const Vec3 distal{-1, 0, 0};
    const Vec3 about = rotation_about(distal, rng.uniform(0, 2 * kPi)) * Vec3{0, 1, 0};
    return rotation_about(about, radians_from_degrees(kUnevenDegrees * rng.uniform(0, 1))) * distal;
  }
  const Vec3 about = rotation_about(axis.direction, rng.uniform(0, 2 * kPi)) * side;
  const double obliquity = radians_from_degrees(kObliquityDegrees * rng.uniform(0.6, 1.2));
  return rotation_about(about, obliquity) * axis.direction;
}

}  // namespace

LongAxis scaphoid_axis(const anatomy::WristModel& model) {
  const std::vector<Vec3> points = points_inside_scaphoid(model);
  LongAxis axis;
  for (const Vec3& p : points) axis.centroid += p / static_cast<double>(points.size());
  axis.direction = main_direction(points, axis.centroid);
  for (const Vec3& p : points) {
    const double t = dot(axis.direction, p - axis.centroid);
    axis.least = std::min(axis.least, t);
    axis.greatest = std::max(axis.greatest, t);
  }
  axis.waist = find_waist(points, axis);
  return axis;
}

Fracture make_fracture(const anatomy::WristModel& model, FractureKind kind, std::uint64_t seed) {
  const LongAxis axis = scaphoid_axis(model);
  const Recipe& recipe = recipe_of(kind);
  Rng rng(seed ^ 0xF2AC7012EULL);
  Fracture n;
  n.seed = rng.next();
  n.gap_mm = recipe.gap_mm;
  n.lost_mm = recipe.is_apart && !recipe.is_old ? 0.0 : recipe.gap_mm;
  n.least_gap_mm = recipe.least_gap_mm;
  n.is_apart = recipe.is_apart;
  n.is_old = recipe.is_old;
  n.relief_coarse_mm = recipe.relief_coarse_mm;
  n.relief_fine_mm = recipe.relief_fine_mm;
  n.cyst_radius_mm = recipe.cyst_radius_mm;
  n.gap_hounsfield = recipe.gap_hounsfield;
  const double place = recipe.place == kAtWaist
                           ? axis.waist
                           : axis.least + recipe.place * (axis.greatest - axis.least);
  n.point = axis.centroid + axis.direction * place;
  const Vec3 side = any_perpendicular(axis.direction);
  n.normal = normal_of(recipe, axis, side, rng);
  // Flexes, on either side; the axis points radial on either side too.
  n.rotation = rotation_about({0, 1, 0}, radians_from_degrees(recipe.flexion_deg));
  n.pivot = n.point + axis.direction * kPivotBeyondFractureMm;
  const Vec3 radial{0, axis.direction.y < 0 ? -1.0 : 1.0, 0};
  n.shift = normalized_or(radial - n.normal * dot(n.normal, radial), radial) * recipe.step_mm +
            n.normal * (n.gap_mm - n.lost_mm);
  n.cyst = n.point - axis.direction * (n.gap_mm + 0.4 + recipe.cyst_radius_mm) +
           side * rng.uniform(-2.0, 2.0);
  return n;
}

}  // namespace carpus::phantom
