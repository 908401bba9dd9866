// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/joint_end.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "anatomy/region_shape.hpp"

namespace carpus::anatomy {
namespace {

constexpr double kLeast = 1e-6;  // keeps the logarithm of an empty or flat body finite

EndMeasure measure_of(const Moments& moments, double piece_mm3) {
  BodyShape shape;
  shape.moments = moments;
  shape.piece_mm3 = piece_mm3;
  summarise(shape);
  EndMeasure result;
  result.log_volume = std::log(std::max(shape.volume_mm3, kLeast));
  for (std::size_t k = 0; k < 3; ++k) {
    result.log_extents[k] = std::log(std::max(shape.extents[k], kLeast));
  }
  result.centroid = shape.centroid;
  return result;
}

}  // namespace

JointEnd::JointEnd(std::span<const Vec3> points,
                   const Vec3& towards_joint,
                   double length_mm,
                   double piece_mm3) {
  double reach = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) reach = std::max(reach, dot(towards_joint, p));
  std::array<Moments, kLongestEndMm> slices;
  for (const Vec3& p : points) {
    const double depth = reach - dot(towards_joint, p);
    if (depth < static_cast<double>(kLongestEndMm)) {
      slices[static_cast<std::size_t>(depth)].add(p);
    }
  }
  const auto count = static_cast<std::size_t>(
      std::clamp(std::round(length_mm), 0.0, static_cast<double>(kLongestEndMm)));
  Moments sum;
  for (std::size_t k = 0; k < count; ++k) {
    sum.add(slices[k]);
    if (!(sum.count > 0)) break;
    measures_.push_back(measure_of(sum, piece_mm3));
  }
}

EndMeasure JointEnd::measure(double length_mm) const noexcept {
  const double last = static_cast<double>(measures_.size()) - 1;
  const double at = std::clamp(length_mm - 1, 0.0, last);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, measures_.size() - 1);
  const double t = at - static_cast<double>(low);
  const EndMeasure& a = measures_[low];
  const EndMeasure& b = measures_[high];
  EndMeasure result;
  result.log_volume = a.log_volume + t * (b.log_volume - a.log_volume);
  for (std::size_t k = 0; k < 3; ++k) {
    result.log_extents[k] = a.log_extents[k] + t * (b.log_extents[k] - a.log_extents[k]);
  }
  result.centroid = a.centroid + (b.centroid - a.centroid) * t;
  return result;
}

}  // namespace carpus::anatomy
