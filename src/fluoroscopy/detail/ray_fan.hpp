// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The rays of a picture: from the source to every pixel.
#pragma once

#include <cstddef>

#include "fluoroscopy/c_arm.hpp"
#include "geometry/grid.hpp"

namespace carpus::fluoroscopy::detail {

/// Where the pixels' rays are, in one frame.
struct RayFan {
  Vec3 source;
  Vec3 corner;  ///< centre of the top left pixel
  Vec3 right;   ///< to the next pixel
  Vec3 down;

  [[nodiscard]] Vec3 pixel(double i, double j) const { return corner + right * i + down * j; }
  [[nodiscard]] Vec3 pixel(std::size_t i, std::size_t j) const {
    return pixel(static_cast<double>(i), static_cast<double>(j));
  }
};

/// Whether the round diaphragm covers a pixel.
[[nodiscard]] inline bool is_outside_field(std::size_t i, std::size_t j, int pixels) noexcept {
  const double centre = 0.5 * (pixels - 1);
  const double x = static_cast<double>(i) - centre;
  const double y = static_cast<double>(j) - centre;
  return x * x + y * y > 0.25 * pixels * pixels;
}

/// In Patient [mm].
[[nodiscard]] inline RayFan fan_in_patient(const CArmPose& pose) {
  const Pose<frame::Patient, frame::CArm> patient_from_carm = pose.carm_from_patient.inverse();
  const double pixel = pose.geometry.pixel_mm();
  const double first = -0.5 * (pose.geometry.pixels - 1) * pixel;
  return {pose.source_in_patient().v, (patient_from_carm * Point<frame::CArm>{{first, first, 0}}).v,
          (patient_from_carm * Direction<frame::CArm>{{pixel, 0, 0}}).v,
          (patient_from_carm * Direction<frame::CArm>{{0, pixel, 0}}).v};
}

/// The same in a grid's voxel coordinates.
[[nodiscard]] inline RayFan in_voxels(const RayFan& fan, const GridGeometry& geometry) {
  const Vec3 corner = geometry.voxel_from_patient(fan.corner);
  return {geometry.voxel_from_patient(fan.source), corner,
          geometry.voxel_from_patient(fan.corner + fan.right) - corner,
          geometry.voxel_from_patient(fan.corner + fan.down) - corner};
}

/// The same in frame Bone of a body that has moved.
[[nodiscard]] inline RayFan in_bone(const RayFan& fan,
                                    const Pose<frame::Bone, frame::Patient>& bone_from_patient) {
  const auto point = [&](const Vec3& p) {
    return (bone_from_patient * Point<frame::Patient>{p}).v;
  };
  const auto way = [&](const Vec3& d) {
    return (bone_from_patient * Direction<frame::Patient>{d}).v;
  };
  return {point(fan.source), point(fan.corner), way(fan.right), way(fan.down)};
}

}  // namespace carpus::fluoroscopy::detail
