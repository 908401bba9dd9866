// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/polytope_measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/exact_number.hpp"
#include "geometry/tolerance.hpp"

namespace carpus::hull {
namespace {

/// Rounding beyond this share of the volume calls for exact arithmetic.
constexpr double kEnough = 1e-12;

/// A facet's corners, divided by the extent's power of two so that no product leaves the doubles.
struct ScaledFacet {
  std::array<Vec3, 3> corners;
  std::array<Vec3, 3> from_apex;  ///< corners - apex
};

double six_volumes(const ScaledFacet& f) {
  return dot(f.from_apex[0], cross(f.from_apex[1], f.from_apex[2]));
}

/// Of six_volumes: the differences are off by a rounding, the products and sums by six.
double error_of(const ScaledFacet& f) {
  const auto size = [](const Vec3& v) { return Vec3{std::abs(v.x), std::abs(v.y), std::abs(v.z)}; };
  const Vec3 a = size(f.from_apex[0]);
  const Vec3 b = size(f.from_apex[1]);
  const Vec3 c = size(f.from_apex[2]);
  const double products =
      a.x * (b.y * c.z + b.z * c.y) + a.y * (b.z * c.x + b.x * c.z) + a.z * (b.x * c.y + b.y * c.x);
  return 16 * kRoundoff * products;
}

double exact_six_volumes(const ScaledFacet& f, const Vec3& apex) {
  const ExactVec3 from(apex);
  return dot(ExactVec3(f.corners[0]) - from,
             cross(ExactVec3(f.corners[1]) - from, ExactVec3(f.corners[2]) - from))
      .to_double();
}

}  // namespace

PolytopeMeasures measures_of(const ConvexPolytope& polytope) {
  const auto& vertices = polytope.vertices;
  if (vertices.empty()) return {};
  double extent = 0;
  for (const Vec3& v : vertices) {
    for (std::size_t i = 0; i < 3; ++i) extent = std::max(extent, std::abs(v[i] - vertices[0][i]));
  }
  const int exponent = std::ilogb(extent);
  const auto scaled = [&](const Vec3& v) {
    return Vec3{std::ldexp(v.x, -exponent), std::ldexp(v.y, -exponent), std::ldexp(v.z, -exponent)};
  };
  const Vec3 apex = scaled(vertices[0]);
  const auto facet = [&](const Triangle& t) {
    ScaledFacet f;
    for (std::size_t i = 0; i < 3; ++i) {
      f.corners[i] = scaled(vertices[t[i]]);
      f.from_apex[i] = f.corners[i] - apex;
    }
    return f;
  };

  double six = 0;
  double error = 0;
  double area = 0;
  Vec3 weighted;     // four times the centroid, by volume
  Vec3 area_centre;  // three times the centroid, by area
  for (const Triangle& t : polytope.facets) {
    const ScaledFacet f = facet(t);
    const double v = six_volumes(f);
    const Vec3 sum = f.from_apex[0] + f.from_apex[1] + f.from_apex[2];
    const double a =
        length(cross(f.from_apex[1] - f.from_apex[0], f.from_apex[2] - f.from_apex[0])) / 2;
    six += v;
    error += error_of(f);
    weighted += sum * v;
    area += a;
    area_centre += sum * a;
  }
  if (!(error <= kEnough * six)) {
    six = 0;
    weighted = {};
    for (const Triangle& t : polytope.facets) {
      const ScaledFacet f = facet(t);
      const double v = exact_six_volumes(f, apex);
      six += v;
      weighted += (f.from_apex[0] + f.from_apex[1] + f.from_apex[2]) * v;
    }
  }
  PolytopeMeasures measures;
  measures.volume_mm3 = std::ldexp(six / 6, 3 * exponent);
  measures.area_mm2 = std::ldexp(area, 2 * exponent);
  const Vec3 centre =
      six > 0 ? weighted / (4 * six) : (area > 0 ? area_centre / (3 * area) : Vec3{});
  measures.centroid =
      vertices[0] + Vec3{std::ldexp(centre.x, exponent), std::ldexp(centre.y, exponent),
                         std::ldexp(centre.z, exponent)};
  return measures;
}

}  // namespace carpus::hull
