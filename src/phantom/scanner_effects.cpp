// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "phantom/scanner_effects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/parallel.hpp"
#include "imaging/gaussian.hpp"
#include "phantom/coherent_noise.hpp"

namespace carpus::phantom {
namespace {

constexpr double kSigmaPerFwhm = 0.425;
constexpr double kSteelHu = 8000;
constexpr double kStreakReachMm = 12;
constexpr double kCorticalHu = 1200;
constexpr double kReferencePathMm = 20;
constexpr double kEnhancedFwhmMm = 0.9;

Vec3 at_centre(const GridGeometry& g, const VoxelIndex& v) {
  return g.patient_from_voxel(
      {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
}

GridGeometry merged_geometry(const GridGeometry& g, int count) {
  GridGeometry merged = g;
  merged.size[2] = g.size[2] / count;
  merged.spacing.z = g.spacing.z * count;
  merged.origin = g.patient_from_voxel({0, 0, 0.5 * (count - 1)});
  return merged;
}

/// Sums of cortical path along all lines of one direction (dx, dy) of a slice, back to each voxel.
void add_squared_paths(const GridView<const float>& hu,
                       int z,
                       int dx,
                       int dy,
                       std::vector<double>& squares) {
  const GridGeometry& g = hu.geometry();
  const double step_mm = length({dx * g.spacing.x, dy * g.spacing.y, 0});
  const int nx = g.size[0];
  const int ny = g.size[1];
  const auto run = [&](int x0, int y0) {
    double path = 0;
    for (int x = x0, y = y0; x >= 0 && x < nx && y >= 0 && y < ny; x += dx, y += dy) {
      path += std::max(0.0, static_cast<double>(hu[VoxelIndex{x, y, z}]) - 150) / kCorticalHu;
    }
    path *= step_mm / kReferencePathMm;
    for (int x = x0, y = y0; x >= 0 && x < nx && y >= 0 && y < ny; x += dx, y += dy) {
      squares[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) +
              static_cast<std::size_t>(x)] += path * path;
    }
  };
  for (int y = 0; y < ny; ++y) {
    for (int x = 0; x < nx; ++x) {
      const int before_x = x - dx;
      const int before_y = y - dy;
      if (before_x < 0 || before_x >= nx || before_y < 0 || before_y >= ny) run(x, y);
    }
  }
}

}  // namespace

void add_wire(const Wire& wire, double streaks_hu, std::uint64_t seed, Grid<float>& hu) {
  const GridGeometry& g = hu.geometry();
  const Vec3 axis = normalized_or(wire.to - wire.from, {0, 0, 1});
  const double length_mm = distance(wire.from, wire.to);
  // In an axial slice the wire's section is longest along its own direction there.
  const double longest = std::atan2(axis.y, axis.x);
  parallel_for(static_cast<std::size_t>(g.size[2]), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      for (int y = 0; y < g.size[1]; ++y) {
        for (int x = 0; x < g.size[0]; ++x) {
          const VoxelIndex v{x, y, static_cast<int>(k)};
          const Vec3 p = at_centre(g, v);
          const double along = std::clamp(dot(p - wire.from, axis), 0.0, length_mm);
          const Vec3 off = p - (wire.from + axis * along);
          const double from_axis = distance(p, wire.from + axis * along);
          if (from_axis < wire.radius_mm) {
            hu[v] = static_cast<float>(kSteelHu);
            continue;
          }
          if (std::abs(off.z) > 2 * wire.radius_mm + 2 || from_axis > 4 * kStreakReachMm) continue;
          const double angle = std::atan2(off.y, off.x) - longest;
          const double fan = coherent_noise({angle * 9, p.z * 0.8, 0}, 1.0, seed);
          const double star = -std::cos(2 * angle) * 0.7 + fan;
          hu[v] += static_cast<float>(streaks_hu * star * std::exp(-from_axis / kStreakReachMm));
        }
      }
    }
  });
}

void harden_beam(double darkening_hu, Grid<float>& hu) {
  if (!(darkening_hu > 0)) return;
  const GridGeometry& g = hu.geometry();
  const auto slice = static_cast<std::size_t>(g.size[0]) * static_cast<std::size_t>(g.size[1]);
  parallel_for(static_cast<std::size_t>(g.size[2]), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      std::vector<double> squares(slice, 0.0);
      for (const auto& [dx, dy] :
           std::array<std::array<int, 2>, 4>{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}}) {
        add_squared_paths(hu.view(), static_cast<int>(k), dx, dy, squares);
      }
      for (std::size_t i = 0; i < slice; ++i) {
        hu[k * slice + i] -= static_cast<float>(darkening_hu * squares[i] / 4);
      }
    }
  });
}

template <typename T>
void step_aside(int first, int step_voxels, T outside, Grid<T>& volume) {
  const GridGeometry& g = volume.geometry();
  for (int z = std::max(0, first); z < g.size[2]; ++z) {
    for (int y = 0; y < g.size[1]; ++y) {
      for (int x = g.size[0] - 1; x >= 0; --x) {
        volume[VoxelIndex{x, y, z}] =
            x >= step_voxels ? volume[VoxelIndex{x - step_voxels, y, z}] : outside;
      }
    }
  }
}
template void step_aside(int, int, float, Grid<float>&);
template void step_aside(int, int, std::uint8_t, Grid<std::uint8_t>&);

Grid<float> blurred_by_kernel(const Grid<float>& hu, const ScanOptions& options) {
  Grid<float> sharp =
      imaging::gaussian_smooth(hu.view(), options.point_spread_fwhm_mm * kSigmaPerFwhm);
  if (!(options.edge_enhancement > 0)) return sharp;
  const Grid<float> low = imaging::gaussian_smooth(sharp.view(), kEnhancedFwhmMm * kSigmaPerFwhm);
  const auto share = static_cast<float>(options.edge_enhancement);
  for (std::size_t i = 0; i < sharp.values().size(); ++i) {
    sharp[i] += share * (sharp[i] - low[i]);
  }
  return sharp;
}

Grid<float> merged_slices(const Grid<float>& hu, int count) {
  Grid<float> merged(merged_geometry(hu.geometry(), count));
  const GridGeometry& g = merged.geometry();
  for (std::size_t i = 0; i < merged.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    float sum = 0;
    for (int k = 0; k < count; ++k) sum += hu[VoxelIndex{v.x, v.y, v.z * count + k}];
    merged[i] = sum / static_cast<float>(count);
  }
  return merged;
}

Grid<std::uint8_t> merged_slices(const Grid<std::uint8_t>& labels, int count) {
  Grid<std::uint8_t> merged(merged_geometry(labels.geometry(), count));
  for (std::size_t i = 0; i < merged.values().size(); ++i) {
    const VoxelIndex v = merged.geometry().index_of(i);
    merged[i] = labels[VoxelIndex{v.x, v.y, v.z * count + count / 2}];
  }
  return merged;
}

}  // namespace carpus::phantom
