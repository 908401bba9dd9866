// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One convex-hull implementation, ours or a peer's, as the benchmark sees it.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "geometry/vec3.hpp"

namespace carpus::bench {

/// What an engine found. Timing covers the hull alone: from the points in the engine's own layout
/// to its own finished structure; copying in and measuring the volume are outside.
struct HullRun {
  bool ok = false;
  double seconds = 0;
  std::size_t vertices = 0;
  std::size_t facets = 0;  ///< triangles; merged facets are counted as their fans
  double volume_mm3 = 0;
  double points_discarded = 0;  ///< by a first stage, where there is one
};

struct HullEngine {
  std::string name;  ///< as in docs/json.md: fast, quickhull, hybrid, …, qhull, cgal, bullet
  bool is_peer = false;
  std::size_t max_points =
      0;  ///< beyond this it is "not run": cost or memory grow too fast; 0 = no limit
  std::function<HullRun(std::span<const Vec3>)> run;
};

/// Our own engines, in the order of the tables.
[[nodiscard]] std::vector<HullEngine> own_hull_engines();

/// The peers that this machine has; each is linked into carpus-bench alone.
[[nodiscard]] std::vector<HullEngine> peer_hull_engines();

}  // namespace carpus::bench
