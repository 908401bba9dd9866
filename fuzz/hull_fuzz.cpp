// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bytes to points, most of them degenerate; every algorithm must agree
// (hull/detail/all_algorithms.hpp).
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bytes.hpp"
#include "hull/detail/all_algorithms.hpp"
#include "hull/detail/face_polygon.hpp"

namespace {

using carpus::Vec3;
using carpus::fuzz::Bytes;

constexpr std::size_t kMostPoints = 24;  // gift wrapping and the check are slow with sanitizers
/// More than fast_hull needs to begin with the hull of extremes.
constexpr std::size_t kManyPoints = 1100;

double coordinate(Bytes& bytes, unsigned kind, std::size_t axis) {
  if (kind == 5) return bytes.any_double();
  const std::uint8_t b = bytes.byte();
  const double lattice = b % 5;
  switch (kind) {
    case 0:
      return lattice;
    case 1:
      return (axis == 2 ? 0.9 : 0.4) * lattice - 7.3;
    case 2:
      return b % 7 == 6 ? std::nextafter(lattice, b & 0x80U ? 9 : -9) : lattice;
    case 3:
      return axis == 2 ? lattice * 1e-15 : lattice;
    default:
      return std::ldexp(static_cast<double>(b) - 128, b % 3 == 0 ? 60 : -3);
  }
}

std::vector<Vec3> points_of(Bytes& bytes, unsigned kind) {
  std::vector<Vec3> points;
  while (bytes.left() > 0 && points.size() < kMostPoints) {
    Vec3 p;
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = coordinate(bytes, kind, axis);
    points.push_back(p);
  }
  return points;
}

[[noreturn]] void report(const std::string& wrong) {
  std::fprintf(stderr, "hull_fuzz: %s\n", wrong.c_str());
  std::abort();
}

/// Thousands of points: the two quickhulls only, which must give the same bytes.
void compare_on_many(const std::vector<Vec3>& few) {
  std::vector<Vec3> many;
  for (std::size_t i = 0; i < few.size() * few.size() && many.size() < kManyPoints; ++i)
    many.push_back(few[i % few.size()] * 0.5 + few[i / few.size()] * 0.5);
  std::vector<Vec3> points;
  for (const std::uint32_t i : carpus::hull::distinct_points(many)) points.push_back(many[i]);
  while (!points.empty() && points.size() < kManyPoints) {  // inner points, down to underflow
    points.push_back(points[points.size() % 97 % points.size()] *
                         (1.0 / static_cast<double>(points.size())) +
                     points[0] * (1 - 1.0 / static_cast<double>(points.size())));
  }
  many.clear();
  for (const std::uint32_t i : carpus::hull::distinct_points(points)) many.push_back(points[i]);
  const auto fast = carpus::hull::build_fast_hull(many);
  const auto quick = carpus::hull::build_convex_hull(many);
  if (fast.status != quick.status || fast.polytope.vertices != quick.polytope.vertices ||
      fast.polytope.facets != quick.polytope.facets ||
      fast.polytope.neighbours != quick.polytope.neighbours) {
    report("fast and quickhull differ on many points");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const std::uint8_t first = bytes.byte();
  const std::vector<Vec3> points = points_of(bytes, first % 6U);
  const bool are_finite = std::all_of(points.begin(), points.end(), carpus::is_finite);
  bool has_duplicates = true;
  if (are_finite) has_duplicates = carpus::hull::distinct_points(points).size() < points.size();
  if (const std::string wrong = carpus::hull::check_all(points, has_duplicates); !wrong.empty()) {
    report(wrong);
  }
  if (are_finite && (first & 0xE0U) == 0xE0U) compare_on_many(points);
  return 0;
}
