// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Qhull through its reentrant C interface, which is its fastest; options Qt (triangulated), as our
// result is.
extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <cstdio>

#include "bench/hull/peers.hpp"
#include "bench/stopwatch.hpp"

namespace carpus::bench {
namespace {

HullRun run_qhull(std::span<const Vec3> points) {
  std::vector<coordT> coordinates;
  coordinates.reserve(points.size() * 3);
  for (const Vec3& p : points) coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
  HullRun run;
  qhT state;
  qhT* qh = &state;
  qh_zero(qh, stderr);
  char options[] = "qhull Qt";
  const Stopwatch watch;
  const int status = qh_new_qhull(qh, 3, static_cast<int>(points.size()), coordinates.data(), False,
                                  options, nullptr, stderr);
  run.seconds = watch.seconds();
  if (status == 0) {
    qh_getarea(qh, qh->facet_list);
    run.ok = true;
    run.vertices = static_cast<std::size_t>(qh->num_vertices);
    run.facets = static_cast<std::size_t>(qh->num_facets);
    run.volume_mm3 = qh->totvol;
  }
  qh_freeqhull(qh, qh_ALL);
  return run;
}

}  // namespace

HullEngine qhull_engine() { return {"qhull", true, 0, run_qhull}; }

}  // namespace carpus::bench
