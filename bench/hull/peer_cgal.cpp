// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// CGAL's convex_hull_3 with exact predicates and inexact constructions, as its manual recommends.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include "bench/hull/peers.hpp"
#include "bench/stopwatch.hpp"

namespace carpus::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

HullRun run_cgal(std::span<const Vec3> points) {
  std::vector<Kernel::Point_3> input;
  input.reserve(points.size());
  for (const Vec3& p : points) input.emplace_back(p.x, p.y, p.z);
  HullRun run;
  Mesh mesh;
  const Stopwatch watch;
  CGAL::convex_hull_3(input.begin(), input.end(), mesh);
  run.seconds = watch.seconds();
  run.ok = true;
  run.vertices = mesh.number_of_vertices();
  run.facets = mesh.number_of_faces();
  run.volume_mm3 = CGAL::Polygon_mesh_processing::volume(mesh);
  return run;
}

}  // namespace

HullEngine cgal_engine() { return {"cgal", true, 0, run_cgal}; }

}  // namespace carpus::bench
