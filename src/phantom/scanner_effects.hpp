// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a scanner adds to the densities of an arm: metal, hardening of the beam, a step of motion,
// the kernel, thick slices. Each works on a whole volume [HU].
#pragma once

#include <cstdint>

#include "geometry/grid.hpp"
#include "phantom/scan_conditions.hpp"

namespace carpus::phantom {

/// A straight piece of steel, in the scan's frame [mm].
struct Wire {
  Vec3 from;
  Vec3 to;
  double radius_mm = 0;
};

/// Steel (8000 HU before the kernel and the file's limit), and in each axial slice that it crosses
/// the star of dark and bright streaks of photon starvation: a fan of random bands about the wire,
/// dark along the direction in which it is longest, fading over 12 mm.
void add_wire(const Wire& wire, double streaks_hu, std::uint64_t seed, Grid<float>& hu);

/// Minus `darkening_hu` (L / 20 mm)^2 in the mean over four directions of the axial slice, L being
/// the path in cortical bone (1200 HU) along the whole line through the voxel: cupping in bone,
/// dark bands between bones.
void harden_beam(double darkening_hu, Grid<float>& hu);

/// From slice `first` on the arm lies `step_voxels` farther along x; what comes in is air or 0.
template <typename T>
void step_aside(int first, int step_voxels, T outside, Grid<T>& volume);

/// The kernel: a Gaussian, and for a sharp one its high frequencies once more
/// (scan_conditions.hpp).
[[nodiscard]] Grid<float> blurred_by_kernel(const Grid<float>& hu, const ScanOptions& options);

/// Every `count` slices as one, their mean; the geometry follows.
[[nodiscard]] Grid<float> merged_slices(const Grid<float>& hu, int count);
/// The same for labels: the middle slice's.
[[nodiscard]] Grid<std::uint8_t> merged_slices(const Grid<std::uint8_t>& labels, int count);

}  // namespace carpus::phantom
