// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/scan_cuts.hpp"

#include <array>

namespace carpus::fluoroscopy {
namespace {

/// HU above which a voxel on the scan's border is part of a limb that goes on beyond it.
constexpr std::int16_t kTissueHu = -300;
/// A border cuts a limb when more of it than this is tissue.
constexpr double kCutFraction = 0.02;
/// How far inside the scan's end the collimator closes: rays diverge by up to 7 degrees, over half
/// a wrist's thickness of 25 mm.
constexpr double kLeafMarginMm = 3.0;

}  // namespace

std::vector<ScanCut> find_scan_cuts(const GridView<const std::int16_t>& ct) {
  std::vector<ScanCut> cuts;
  const GridGeometry& g = ct.geometry();
  if (g.voxel_count() == 0) return cuts;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t across = (axis + 1) % 3;
    const std::size_t along = (axis + 2) % 3;
    const double margin = kLeafMarginMm / g.spacing[axis];
    for (const bool is_high_end : {false, true}) {
      const double last = g.size[axis] - 1;
      double tissue = 0;
      Vec3 sum;
      std::array<int, 3> v{};
      v[axis] = is_high_end ? g.size[axis] - 1 : 0;
      for (v[along] = 0; v[along] < g.size[along]; ++v[along]) {
        for (v[across] = 0; v[across] < g.size[across]; ++v[across]) {
          if (ct[VoxelIndex{v[0], v[1], v[2]}] <= kTissueHu) continue;
          tissue += 1;
          sum +=
              Vec3{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
        }
      }
      if (!(tissue > kCutFraction * g.size[across] * g.size[along])) continue;
      cuts.push_back({axis, is_high_end, is_high_end ? last - margin : margin,
                      g.patient_from_voxel(sum / tissue)});
    }
  }
  return cuts;
}

}  // namespace carpus::fluoroscopy
