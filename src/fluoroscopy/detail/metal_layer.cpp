// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/detail/metal_layer.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.hpp"
#include "fluoroscopy/detail/pixel_box.hpp"
#include "fluoroscopy/detail/ray_fan.hpp"

namespace carpus::fluoroscopy::detail {

void add_metal(AttenuationMap& map, const CArmPose& pose, std::span<const MetalCylinder> metal) {
  constexpr std::size_t kRowGrain = 8;
  map.metal.clear();
  if (metal.empty()) return;
  const RayFan rays = fan_in_patient(pose);
  const auto side = static_cast<std::size_t>(pose.geometry.pixels);
  map.metal.resize(side * side);
  std::vector<PixelBox> boxes;
  for (const MetalCylinder& rod : metal) {
    boxes.push_back(box_of(rod, pose).within(pose.geometry.pixels));
  }
  parallel_for(side, kRowGrain, [&](std::size_t from, std::size_t to) {
    for (std::size_t j = from; j < to; ++j) {
      for (std::size_t m = 0; m < metal.size(); ++m) {
        const PixelBox& box = boxes[m];
        if (box.is_empty() || static_cast<int>(j) < box.top || static_cast<int>(j) > box.bottom) {
          continue;
        }
        for (auto i = static_cast<std::size_t>(box.left); i <= static_cast<std::size_t>(box.right);
             ++i) {
          if (std::isnan(map.values[j * side + i])) continue;
          map.metal[j * side + i] +=
              static_cast<float>(line_integral(metal[m], rays.source, rays.pixel(i, j)));
        }
      }
      for (std::size_t i = 0; i < side; ++i) map.values[j * side + i] += map.metal[j * side + i];
    }
  });
}

}  // namespace carpus::fluoroscopy::detail
