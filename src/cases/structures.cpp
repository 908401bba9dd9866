// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/structures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carpus::cases {

double length_of(const Structure& structure) {
  double sum = 0;
  for (std::size_t i = 1; i < structure.course.size(); ++i) {
    sum += distance(structure.course[i - 1].at, structure.course[i].at);
  }
  return sum;
}

double distance_to(const Structure& structure, const Vec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < structure.course.size(); ++i) {
    const Vec3& a = structure.course[i].at;
    const Vec3& b = structure.course[std::min(i + 1, structure.course.size() - 1)].at;
    const double squared = squared_length(b - a);
    const double t = squared > 0 ? std::clamp(dot(point - a, b - a) / squared, 0.0, 1.0) : 0.0;
    least = std::min(least, distance(point, a + (b - a) * t));
  }
  return least - structure.radius_mm;
}

}  // namespace carpus::cases
