// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/point_sets.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/rng.hpp"

namespace carpus::bench {
namespace {

constexpr double kSizeMm = 20;  // of a carpal bone

Vec3 in_cube(Rng& rng) { return {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)}; }

Vec3 in_ball(Rng& rng) {
  Vec3 p = in_cube(rng);
  while (squared_length(p) > 1) p = in_cube(rng);
  return p;
}

std::vector<Vec3> lattice(std::size_t count) {
  const auto side = static_cast<std::size_t>(std::cbrt(static_cast<double>(count)) + 0.5);
  std::vector<Vec3> points;
  points.reserve(side * side * side);
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t j = 0; j < side; ++j) {
      for (std::size_t k = 0; k < side; ++k) {
        points.push_back({0.5 * static_cast<double>(i), 0.5 * static_cast<double>(j),
                          0.5 * static_cast<double>(k)});
      }
    }
  }
  return points;
}

}  // namespace

PointSet make_point_set(const std::string& distribution, std::size_t count, std::uint64_t seed) {
  if (distribution == "lattice") return {distribution, lattice(count)};
  Rng rng(seed);
  PointSet set{distribution, {}};
  set.points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (distribution == "ball") {
      set.points.push_back(kSizeMm * in_ball(rng));
    } else if (distribution == "sphere") {
      set.points.push_back(kSizeMm * normalized_or(in_ball(rng), {1, 0, 0}));
    } else if (distribution == "cube") {
      set.points.push_back(kSizeMm * in_cube(rng));
    } else if (distribution == "gaussian") {
      set.points.push_back(kSizeMm * Vec3{rng.normal(), rng.normal(), rng.normal()});
    } else {
      throw InvalidInput("unknown distribution '" + distribution + "'");
    }
  }
  return set;
}

std::vector<std::string> distributions() {
  return {"ball", "sphere", "cube", "gaussian", "lattice"};
}

}  // namespace carpus::bench
