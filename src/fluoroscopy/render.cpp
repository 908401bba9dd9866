// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/render.hpp"

#include <cstddef>
#include <limits>
#include <vector>

#include "core/parallel.hpp"
#include "fluoroscopy/detail/metal_layer.hpp"
#include "fluoroscopy/detail/ray_fan.hpp"

namespace carpus::fluoroscopy {
namespace {

constexpr std::size_t kRowGrain = 8;
}  // namespace

FluoroscopyRenderer::FluoroscopyRenderer(const GridView<const std::int16_t>& ct)
    : ct_(ct), cuts_(find_scan_cuts(ct)) {}

AttenuationMap FluoroscopyRenderer::project(const CArmPose& pose,
                                            std::span<const MetalCylinder> metal) const {
  const detail::RayFan rays = detail::in_voxels(detail::fan_in_patient(pose), ct_.geometry());
  const auto side = static_cast<std::size_t>(pose.geometry.pixels);
  const double at_target = pose.geometry.source_to_target_mm / pose.geometry.source_to_receptor_mm;
  AttenuationMap map{
      pose.geometry.pixels, pose.geometry.pixels, std::vector<float>(side * side), {}};
  parallel_for(side, kRowGrain, [&](std::size_t from, std::size_t to) {
    for (std::size_t j = from; j < to; ++j) {
      for (std::size_t i = 0; i < side; ++i) {
        const Vec3 pixel = rays.pixel(i, j);
        const bool is_dark = detail::is_outside_field(i, j, pose.geometry.pixels) ||
                             is_covered(cuts_, rays.source + (pixel - rays.source) * at_target);
        map.values[j * side + i] = is_dark ? std::numeric_limits<float>::quiet_NaN()
                                           : ct_.line_integral(rays.source, pixel);
      }
    }
  });
  detail::add_metal(map, pose, metal);
  return map;
}

Image FluoroscopyRenderer::render(const CArmPose& pose,
                                  std::span<const MetalCylinder> metal,
                                  const Exposure& exposure) const {
  const AttenuationMap map = project(pose, metal);
  return display(detect(map, pose.geometry, exposure), map, pose.geometry, exposure);
}

}  // namespace carpus::fluoroscopy
