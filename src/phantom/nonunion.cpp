// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "phantom/nonunion.hpp"

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
/// Bone lost between the faces; with the relief the gap is 1 to 2.5 mm.
constexpr double kGapMm = 1.7;
constexpr double kHumpbackDegrees = 8.0;
constexpr double kProximalTiltDegrees = 3.0;
/// The fracture runs this oblique to the scaphoid's cross-section.
constexpr double kObliquityDegrees = 14.0;
/// A proximal-pole fracture leaves this part of the length proximal.
constexpr double kProximalPart = 0.27;
/// The pivot of the distal fragment lies distal of the fracture: its ligaments hold the far end.
constexpr double kPivotBeyondFractureMm = 4.0;
constexpr double kReliefCoarseMm = 0.65;
constexpr double kReliefFineMm = 0.3;
constexpr int kPowerSteps = 60;

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

std::string_view name_of(NonunionKind kind) noexcept {
  constexpr std::array<std::string_view, 3> kNames{"none", "waist", "proximal"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::optional<NonunionKind> nonunion_of(std::string_view name) noexcept {
  for (const auto kind : {NonunionKind::None, NonunionKind::Waist, NonunionKind::Proximal}) {
    if (name == name_of(kind)) return kind;
  }
  return std::nullopt;
}

double Nonunion::height(const Vec3& p) const noexcept {
  return dot(normal, p - point) + kReliefCoarseMm * coherent_noise(p, 3.0, seed) +
         kReliefFineMm * coherent_noise(p, 1.2, seed + 1);
}

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

Nonunion make_nonunion(const anatomy::WristModel& model, NonunionKind kind, std::uint64_t seed) {
  const LongAxis axis = scaphoid_axis(model);
  Rng rng(seed ^ 0xF2AC7012EULL);
  const bool is_waist = kind == NonunionKind::Waist;
  const double place =
      is_waist ? axis.waist : axis.least + kProximalPart * (axis.greatest - axis.least);
  Nonunion n;
  n.seed = rng.next();
  n.gap_mm = kGapMm * (is_waist ? 1.0 : 0.8);
  n.point = axis.centroid + axis.direction * place;
  const Vec3 side = any_perpendicular(axis.direction);
  const Vec3 about = rotation_about(axis.direction, rng.uniform(0, 2 * kPi)) * side;
  const double obliquity = radians_from_degrees(kObliquityDegrees * rng.uniform(0.6, 1.2));
  n.normal = rotation_about(about, obliquity) * axis.direction;
  const double tilt = is_waist ? kHumpbackDegrees : kProximalTiltDegrees;
  n.rotation = rotation_about({0, 1, 0}, radians_from_degrees(tilt));  // flexes, on either side
  n.pivot = n.point + axis.direction * kPivotBeyondFractureMm;
  n.cyst = n.point - axis.direction * (n.gap_mm + 1.6) + side * rng.uniform(-2.0, 2.0);
  return n;
}

}  // namespace carpus::phantom
