// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/render.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "core/parallel.hpp"

namespace carpus::fluoroscopy {
namespace {

constexpr std::size_t kRowGrain = 8;
/// How far inside the scan's end the collimator closes: rays diverge by up to 7 degrees, over half
/// a wrist's thickness of 25 mm.
constexpr double kLeafMarginMm = 3.0;

/// Where the pixels' rays are, in one frame.
struct RayFan {
  Vec3 source;
  Vec3 corner;  ///< centre of the top left pixel
  Vec3 right;   ///< to the next pixel
  Vec3 down;

  [[nodiscard]] Vec3 pixel(std::size_t i, std::size_t j) const {
    return corner + right * static_cast<double>(i) + down * static_cast<double>(j);
  }
};

RayFan fan_in_patient(const CArmPose& pose) {
  const Pose<frame::Patient, frame::CArm> patient_from_carm = pose.carm_from_patient.inverse();
  const double pixel = pose.geometry.pixel_mm();
  const double first = -0.5 * (pose.geometry.pixels - 1) * pixel;
  return {pose.source_in_patient().v, (patient_from_carm * Point<frame::CArm>{{first, first, 0}}).v,
          (patient_from_carm * Direction<frame::CArm>{{pixel, 0, 0}}).v,
          (patient_from_carm * Direction<frame::CArm>{{0, pixel, 0}}).v};
}

RayFan in_voxels(const RayFan& fan, const GridGeometry& geometry) {
  const Vec3 corner = geometry.voxel_from_patient(fan.corner);
  return {geometry.voxel_from_patient(fan.source), corner,
          geometry.voxel_from_patient(fan.corner + fan.right) - corner,
          geometry.voxel_from_patient(fan.corner + fan.down) - corner};
}

/// The part of the picture that metal can fall on.
struct PixelBox {
  int left, top, right, bottom;  ///< inclusive
  [[nodiscard]] bool holds(std::size_t i, std::size_t j) const {
    return static_cast<int>(i) >= left && static_cast<int>(i) <= right &&
           static_cast<int>(j) >= top && static_cast<int>(j) <= bottom;
  }
};

PixelBox box_of(const MetalCylinder& rod, const CArmPose& pose) {
  const PixelBox all{0, 0, pose.geometry.pixels - 1, pose.geometry.pixels - 1};
  const std::optional<PixelPosition> a = project_point(pose, {rod.start});
  const std::optional<PixelPosition> b = project_point(pose, {rod.end});
  if (!a || !b) return all;
  // A rod's edge is at most twice as far out as in a parallel beam while it keeps clear of the
  // source by half its distance; nearer ones get the whole picture.
  const Vec3 source = pose.source_in_patient().v;
  const double nearest = std::min(distance(rod.start, source), distance(rod.end, source));
  if (nearest < pose.geometry.source_to_receptor_mm / 4) return all;
  const double radius = std::max(rod.start_radius_mm, rod.end_radius_mm);
  const double reach =
      2 + 2 * radius * pose.geometry.source_to_receptor_mm / nearest / pose.geometry.pixel_mm();
  const auto pixel = [&](double value) { return static_cast<int>(std::clamp(value, -1e6, 1e6)); };
  return {pixel(std::min(a->x, b->x) - reach), pixel(std::min(a->y, b->y) - reach),
          pixel(std::max(a->x, b->x) + reach), pixel(std::max(a->y, b->y) + reach)};
}

/// The collimator: a round diaphragm, and leaves at the scan's ends.
class Collimator {
 public:
  Collimator(const CArmPose& pose, const CtProjector& ct, const RayFan& voxels)
      : pixels_(pose.geometry.pixels),
        share_(pose.geometry.source_to_target_mm / pose.geometry.source_to_receptor_mm),
        voxels_(voxels) {
    const GridGeometry& grid = ct.geometry();
    for (std::size_t a = 0; a < 3; ++a) {
      const double margin = kLeafMarginMm / grid.spacing[a];
      low_[a] = ct.is_cut_at(a, 0) ? margin : -std::numeric_limits<double>::infinity();
      high_[a] =
          ct.is_cut_at(a, 1) ? grid.size[a] - 1 - margin : std::numeric_limits<double>::infinity();
    }
  }

  [[nodiscard]] bool covers(std::size_t i, std::size_t j) const {
    const double centre = 0.5 * (pixels_ - 1);
    const double x = static_cast<double>(i) - centre;
    const double y = static_cast<double>(j) - centre;
    if (x * x + y * y > 0.25 * pixels_ * pixels_) return true;
    const Vec3 at_target = voxels_.source + (voxels_.pixel(i, j) - voxels_.source) * share_;
    for (std::size_t a = 0; a < 3; ++a) {
      if (at_target[a] < low_[a] || at_target[a] > high_[a]) return true;
    }
    return false;
  }

 private:
  double pixels_;
  double share_;
  RayFan voxels_;
  Vec3 low_;
  Vec3 high_;
};

}  // namespace

FluoroscopyRenderer::FluoroscopyRenderer(const GridView<const std::int16_t>& ct) : ct_(ct) {}

AttenuationMap FluoroscopyRenderer::project(const CArmPose& pose,
                                            std::span<const MetalCylinder> metal) const {
  const RayFan rays = fan_in_patient(pose);
  const RayFan voxel_rays = in_voxels(rays, ct_.geometry());
  const Collimator collimator(pose, ct_, voxel_rays);
  std::vector<PixelBox> boxes;
  for (const MetalCylinder& rod : metal) boxes.push_back(box_of(rod, pose));

  const auto side = static_cast<std::size_t>(pose.geometry.pixels);
  AttenuationMap map{
      pose.geometry.pixels, pose.geometry.pixels, std::vector<float>(side * side), {}};
  if (!metal.empty()) map.metal.resize(side * side);
  parallel_for(side, kRowGrain, [&](std::size_t from, std::size_t to) {
    for (std::size_t j = from; j < to; ++j) {
      for (std::size_t i = 0; i < side; ++i) {
        float& value = map.values[j * side + i];
        if (collimator.covers(i, j)) {
          value = std::numeric_limits<float>::quiet_NaN();
          continue;
        }
        value = ct_.line_integral(voxel_rays.source, voxel_rays.pixel(i, j));
        for (std::size_t m = 0; m < metal.size(); ++m) {
          if (!boxes[m].holds(i, j)) continue;
          map.metal[j * side + i] +=
              static_cast<float>(line_integral(metal[m], rays.source, rays.pixel(i, j)));
        }
        if (!metal.empty()) value += map.metal[j * side + i];
      }
    }
  });
  return map;
}

Image FluoroscopyRenderer::render(const CArmPose& pose,
                                  std::span<const MetalCylinder> metal,
                                  const Exposure& exposure) const {
  const AttenuationMap map = project(pose, metal);
  return display(detect(map, pose.geometry, exposure), map, pose.geometry, exposure);
}

}  // namespace carpus::fluoroscopy
