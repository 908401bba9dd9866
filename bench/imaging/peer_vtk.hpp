// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// VTK's discrete flying edges, in a process of its own: Debian's VTK for C++ brings a hundred and
// seventy packages, its Python module twenty.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "bench/imaging/volume.hpp"

namespace carpus::bench {

struct SurfacesRun {
  double seconds = 0;
  std::size_t vertices = 0;
  std::size_t facets = 0;
};

/// Surfaces of labels 1 to `last`. Nothing where VTK is not installed (tools/install all).
[[nodiscard]] std::optional<SurfacesRun> run_vtk_surfaces(const Volume& volume,
                                                          const std::vector<std::uint16_t>& labels,
                                                          std::uint16_t last);

}  // namespace carpus::bench
