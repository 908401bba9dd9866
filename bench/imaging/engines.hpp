// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Who takes part: our kernels and ITK's, each on one thread. Seconds are processor time.
#pragma once

#include <cstdint>
#include <ctime>
#include <vector>

#include "bench/imaging/peer_vtk.hpp"
#include "bench/imaging/volume.hpp"

namespace carpus::bench {

/// Basins from markers, without walls between them, over the six neighbours.
struct WatershedRun {
  std::vector<std::uint16_t> labels;
  double seconds = 0;
};
[[nodiscard]] WatershedRun run_our_watershed(const Volume& volume,
                                             const std::vector<std::uint16_t>& markers);
/// Over the float relief, as users of ITK run it.
[[nodiscard]] WatershedRun run_itk_watershed(const Volume& volume,
                                             const std::vector<std::uint16_t>& markers);
/// Over the relief in 12 bits, as ours quantises it.
[[nodiscard]] WatershedRun run_itk_12bit_watershed(const Volume& volume,
                                                   const std::vector<std::uint16_t>& markers);

/// Length of the gradient of the Gaussian-smoothed scan.
struct GradientRun {
  std::vector<float> values;
  double seconds = 0;
};
[[nodiscard]] GradientRun run_our_gradient(const Volume& volume, double sigma_mm);
/// By recursive filters, whose cost does not grow with sigma.
[[nodiscard]] GradientRun run_itk_gradient(const Volume& volume, double sigma_mm);

/// Surfaces of all labels, half-way between voxels, in one call.
[[nodiscard]] SurfacesRun run_our_surfaces(const Volume& volume,
                                           const std::vector<std::uint16_t>& labels);

/// Processor time of all threads of the program so far [s].
[[nodiscard]] inline double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace carpus::bench
