// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/imaging/engines.hpp"
#include "imaging/gaussian.hpp"
#include "imaging/watershed.hpp"
#include "mesh/label_surfaces.hpp"

namespace carpus::bench {
namespace {

GridGeometry geometry_of(const Volume& volume) {
  GridGeometry g;
  g.size = volume.size;
  g.spacing = {volume.spacing_mm[0], volume.spacing_mm[1], volume.spacing_mm[2]};
  return g;
}

}  // namespace

WatershedRun run_our_watershed(const Volume& volume, const std::vector<std::uint16_t>& markers) {
  const GridGeometry g = geometry_of(volume);
  const GridView<const float> relief(g, volume.relief);
  WatershedRun run;
  const double start = processor_seconds();
  run.labels = markers;
  imaging::flood_from_markers(relief, {}, {}, GridView<std::uint16_t>(g, run.labels));
  run.seconds = processor_seconds() - start;
  return run;
}

GradientRun run_our_gradient(const Volume& volume, double sigma_mm) {
  const GridGeometry g = geometry_of(volume);
  const double start = processor_seconds();
  const Grid<float> gradient =
      imaging::gradient_magnitude(GridView<const float>(g, volume.hu), sigma_mm);
  GradientRun run;
  run.seconds = processor_seconds() - start;
  run.values.assign(gradient.values().begin(), gradient.values().end());
  return run;
}

SurfacesRun run_our_surfaces(const Volume& volume, const std::vector<std::uint16_t>& labels) {
  const GridGeometry g = geometry_of(volume);
  const double start = processor_seconds();
  const auto surfaces = mesh::extract_label_surfaces(GridView<const std::uint16_t>(g, labels));
  SurfacesRun run;
  run.seconds = processor_seconds() - start;
  for (const mesh::LabelSurface& surface : surfaces) {
    run.vertices += surface.mesh.vertices.size();
    run.facets += surface.mesh.facets.size();
  }
  return run;
}

}  // namespace carpus::bench
