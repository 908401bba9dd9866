// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/edge_excess.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "imaging/box_maximum.hpp"

namespace carpus::imaging {
namespace {

/// Muscle, tendon, cartilage and fluid lie in this range; fat and air below, bone above.
constexpr float kSoftTissueLowHu = -50;
constexpr float kSoftTissueHighHu = 150;
/// Where no such tissue is seen (a bone in air), muscle's usual density.
constexpr float kUsualSoftTissueHu = 45;
/// Of the local maxima within bone so many are below a thick cortex'.
constexpr double kThickCortexQuantile = 0.9;
/// Values that one task of a loop over voxels takes at least.
constexpr std::size_t kGrain = 1U << 16U;

/// What the scan's thick cortex reaches [HU].
float thick_cortex(const Grid<float>& local_maxima, const GridView<const std::uint8_t>& mask) {
  constexpr std::size_t kEvery = 7;
  std::vector<float> values;
  for (std::size_t i = 0; i < local_maxima.values().size(); i += kEvery) {
    if (mask[i] != 0) values.push_back(local_maxima[i]);
  }
  if (values.empty()) return 0;
  const auto rank =
      static_cast<std::ptrdiff_t>(kThickCortexQuantile * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return *(values.begin() + rank);
}

}  // namespace

float median_soft_tissue(const GridView<const float>& smoothed_hu,
                         const GridView<const std::uint8_t>& mask) {
  std::vector<float> values;
  for (std::size_t i = 0; i < mask.values().size(); ++i) {
    const float v = smoothed_hu[i];
    if (mask[i] == 0 && v >= kSoftTissueLowHu && v <= kSoftTissueHighHu) values.push_back(v);
  }
  if (values.empty()) return kUsualSoftTissueHu;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Grid<float> measure_edge_excess(const GridView<const float>& smoothed_hu,
                                const GridView<const std::uint8_t>& mask,
                                float soft_tissue_hu,
                                const BoneSegmentationOptions& options) {
  Grid<float> inside(smoothed_hu.geometry());
  parallel_for(inside.values().size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      inside[i] = mask[i] != 0 ? smoothed_hu[i] : soft_tissue_hu;
    }
  });
  Grid<float> excess = box_maximum(std::move(inside), options.rim_reach_mm);
  const auto half = static_cast<float>(options.rim_fraction);
  const auto most = std::max(half, static_cast<float>(options.thin_rim_fraction));
  const float thick = half * std::max(0.0F, thick_cortex(excess, mask) - soft_tissue_hu);
  parallel_for(excess.values().size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const float range = excess[i] - soft_tissue_hu;
      if (range > 0) {
        const float fraction = std::clamp(thick / range, half, most);
        excess[i] = (smoothed_hu[i] - soft_tissue_hu) / range - fraction;
      } else {
        excess[i] = -half;
      }
    }
  });
  return excess;
}

}  // namespace carpus::imaging
