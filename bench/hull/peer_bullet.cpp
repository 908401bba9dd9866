// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bullet's btConvexHullComputer, in double precision as Debian builds it (bullet-float64). It works
// on coordinates rounded to a grid, so its vertices are near, not equal to, the input's.
#include <LinearMath/btConvexHullComputer.h>

#include <map>

#include "bench/hull/peers.hpp"
#include "bench/stopwatch.hpp"

namespace carpus::bench {
namespace {

double six_volumes_of(const btConvexHullComputer& hull, std::size_t& triangles) {
  double sum = 0;
  triangles = 0;
  const btVector3 o = hull.vertices[0];
  for (int f = 0; f < hull.faces.size(); ++f) {
    const btConvexHullComputer::Edge* first = &hull.edges[hull.faces[f]];
    const btVector3 a = hull.vertices[first->getSourceVertex()] - o;
    for (const btConvexHullComputer::Edge* e = first->getNextEdgeOfFace();
         e->getTargetVertex() != first->getSourceVertex(); e = e->getNextEdgeOfFace()) {
      const btVector3 b = hull.vertices[e->getSourceVertex()] - o;
      const btVector3 c = hull.vertices[e->getTargetVertex()] - o;
      sum += static_cast<double>(a.dot(b.cross(c)));
      ++triangles;
    }
  }
  return sum;
}

HullRun run_bullet(std::span<const Vec3> points) {
  std::vector<double> coordinates;
  coordinates.reserve(points.size() * 3);
  for (const Vec3& p : points) coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
  HullRun run;
  btConvexHullComputer hull;
  const Stopwatch watch;
  hull.compute(coordinates.data(), 3 * sizeof(double), static_cast<int>(points.size()), 0, 0);
  run.seconds = watch.seconds();
  run.ok = hull.vertices.size() >= 4;
  if (run.ok) {
    run.vertices = static_cast<std::size_t>(hull.vertices.size());
    run.volume_mm3 = std::abs(six_volumes_of(hull, run.facets)) / 6;
  }
  return run;
}

}  // namespace

HullEngine bullet_engine() { return {"bullet", true, 0, run_bullet}; }

}  // namespace carpus::bench
