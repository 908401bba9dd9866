// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/instrument_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.hpp"

namespace carpus {
namespace {

void require_positive(const char* shape, const char* name, double value) {
  if (std::isfinite(value) && value > 0) return;
  throw InvalidInput(std::string(shape) + ": " + name + " is " + std::to_string(value) +
                     ", must be finite and greater than 0 mm");
}

void require_length(const char* shape, double length_mm, double least_mm) {
  require_positive(shape, "length_mm", length_mm);
  if (length_mm >= least_mm) return;
  throw InvalidInput(std::string(shape) + ": length_mm is " + std::to_string(length_mm) +
                     ", its ends alone take " + std::to_string(least_mm) + " mm");
}

/// Signed distance to the balls between two knots. The nearest ball's centre lies where the line
/// to the point makes a right angle with the hull of the balls, not with the axis.
double distance_to_piece(const AxisKnot& a, const AxisKnot& b, const Vec3& p) noexcept {
  const double off_axis = std::sqrt(p.x * p.x + p.y * p.y);
  double z = a.z_mm;
  if (b.z_mm > a.z_mm) {
    const double slope = (b.radius_mm - a.radius_mm) / (b.z_mm - a.z_mm);
    const double nearest = p.z + off_axis * slope / std::sqrt(1 - slope * slope);
    z = std::clamp(nearest, a.z_mm, b.z_mm);
    const double radius = a.radius_mm + slope * (z - a.z_mm);
    return std::sqrt(off_axis * off_axis + (p.z - z) * (p.z - z)) - radius;
  }
  return std::sqrt(off_axis * off_axis + (p.z - z) * (p.z - z)) - a.radius_mm;
}

}  // namespace

InstrumentShape::InstrumentShape(const SphereShape& shape) : kind_(ShapeKind::Sphere) {
  require_positive("sphere", "radius_mm", shape.radius_mm);
  knots_[0] = {shape.radius_mm, shape.radius_mm};
}

InstrumentShape::InstrumentShape(const CapsuleShape& shape) : kind_(ShapeKind::Capsule) {
  require_positive("capsule", "radius_mm", shape.radius_mm);
  require_length("capsule", shape.length_mm, 2 * shape.radius_mm);
  count_ = 2;
  knots_[0] = {shape.radius_mm, shape.radius_mm};
  knots_[1] = {shape.length_mm - shape.radius_mm, shape.radius_mm};
}

InstrumentShape::InstrumentShape(const ConeTipShape& shape) : kind_(ShapeKind::ConeTip) {
  require_positive("cone tip", "radius_mm", shape.radius_mm);
  require_positive("cone tip", "cone_mm", shape.cone_mm);
  const double full = std::sqrt(shape.radius_mm * shape.radius_mm + shape.cone_mm * shape.cone_mm);
  require_length("cone tip", shape.length_mm, full + shape.radius_mm);
  count_ = 3;
  knots_[0] = {0, 0};
  knots_[1] = {full, shape.radius_mm};
  knots_[2] = {shape.length_mm - shape.radius_mm, shape.radius_mm};
}

InstrumentShape::InstrumentShape(const ThreadedCylinderShape& shape)
    : kind_(ShapeKind::ThreadedCylinder),
      thread_(ScrewThread{shape.crest_radius_mm - shape.core_radius_mm, shape.pitch_mm}) {
  require_positive("threaded cylinder", "core_radius_mm", shape.core_radius_mm);
  require_positive("threaded cylinder", "crest_radius_mm", shape.crest_radius_mm);
  require_positive("threaded cylinder", "pitch_mm", shape.pitch_mm);
  require_length("threaded cylinder", shape.length_mm, 2 * shape.crest_radius_mm);
  if (!(shape.core_radius_mm < shape.crest_radius_mm)) {
    throw InvalidInput("threaded cylinder: core_radius_mm must be less than crest_radius_mm");
  }
  count_ = 2;
  knots_[0] = {shape.crest_radius_mm, shape.crest_radius_mm};
  knots_[1] = {shape.length_mm - shape.crest_radius_mm, shape.crest_radius_mm};
}

double InstrumentShape::radius_at(double z_mm) const noexcept {
  for (std::size_t i = 1; i < count_; ++i) {
    const AxisKnot& a = knots_[i - 1];
    const AxisKnot& b = knots_[i];
    if (!(z_mm < b.z_mm)) continue;
    if (!(z_mm > a.z_mm)) return a.radius_mm;
    return a.radius_mm + (b.radius_mm - a.radius_mm) * ((z_mm - a.z_mm) / (b.z_mm - a.z_mm));
  }
  return knots_[count_ - 1].radius_mm;
}

double InstrumentShape::signed_distance(const Vec3& point) const noexcept {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = count_ == 1 ? 0 : 1; i < count_; ++i) {
    best = std::min(best, distance_to_piece(knots_[i == 0 ? 0 : i - 1], knots_[i], point));
  }
  return best;
}

}  // namespace carpus
