// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Point sets for the hull tables: the distributions of the literature, seeded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/hull/origin.hpp"
#include "geometry/vec3.hpp"

namespace carpus::bench {

/// A named set of points [mm].
struct PointSet {
  std::string name;
  std::vector<Vec3> points;
  Origin origin{};
};

/// ball: uniform in a ball; sphere: on its surface, so that all are corners; cube: uniform in a
/// cube; gaussian: normal in each coordinate; lattice: a full cubic grid, all degenerate.
/// @throws InvalidInput for another name.
[[nodiscard]] PointSet make_point_set(const std::string& distribution,
                                      std::size_t count,
                                      std::uint64_t seed);

/// The names that make_point_set knows.
[[nodiscard]] std::vector<std::string> distributions();

}  // namespace carpus::bench
