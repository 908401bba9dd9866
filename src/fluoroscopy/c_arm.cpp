// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/c_arm.hpp"

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "core/units.hpp"

namespace carpus::fluoroscopy {
namespace {

void check(const ViewAngles& view, const CArmGeometry& geometry) {
  if (!std::isfinite(view.rotation_deg) || !(std::abs(view.tilt_deg) <= kMaxTiltDeg)) {
    throw InvalidInput("C-arm: rotation " + std::to_string(view.rotation_deg) + " deg, tilt " +
                       std::to_string(view.tilt_deg) +
                       " deg; rotation must be finite and tilt within +-80 deg");
  }
  if (!(geometry.field_mm > 0 && geometry.pixels > 0 && geometry.source_to_target_mm > 0 &&
        geometry.source_to_receptor_mm > geometry.source_to_target_mm &&
        std::isfinite(geometry.source_to_receptor_mm) && std::isfinite(geometry.field_mm))) {
    throw InvalidInput(
        "C-arm: needs a field and pixels above 0 and the target between source and receptor (mm)");
  }
}

}  // namespace

std::optional<NamedView> find_view(std::string_view id) noexcept {
  for (const NamedView& view : kNamedViews) {
    if (view.id == id) return view;
  }
  return std::nullopt;
}

Point<frame::Patient> CArmPose::source_in_patient() const noexcept {
  return carm_from_patient.inverse() *
         Point<frame::CArm>{{0.0, 0.0, -geometry.source_to_receptor_mm}};
}

CArmPose make_c_arm_pose(const ViewAngles& view,
                         const Point<frame::Patient>& target_in_patient,
                         const Pose<frame::Wrist, frame::Patient>& wrist_from_patient,
                         const Direction<frame::Wrist>& ulnar_in_wrist,
                         const CArmGeometry& geometry) {
  check(view, geometry);
  const double rotation = radians_from_degrees(view.rotation_deg);
  const double tilt = radians_from_degrees(view.tilt_deg);
  const Vec3 proximal{1, 0, 0};
  const Vec3 dorsal{0, 0, -1};
  const Vec3 radial = -ulnar_in_wrist.v;
  // The source goes around the forearm from dorsal towards radial, then tilts along it.
  const Vec3 around = dorsal * std::cos(rotation) + radial * std::sin(rotation);
  const Vec3 towards_source = around * std::cos(tilt) + proximal * std::sin(tilt);
  const Vec3 beam = -towards_source;
  const Vec3 down = proximal * std::cos(tilt) - around * std::sin(tilt);
  const Vec3 right = cross(down, beam);

  const Pose<frame::CArm, frame::Wrist> turned{{{right, down, beam}}, {}};
  CArmPose pose{turned * wrist_from_patient, geometry};
  const Point<frame::CArm> target = pose.carm_from_patient * target_in_patient;
  const Vec3 wanted{0, 0, geometry.source_to_target_mm - geometry.source_to_receptor_mm};
  pose.carm_from_patient.translation += wanted - target.v;
  return pose;
}

std::optional<PixelPosition> project_point(const CArmPose& pose,
                                           const Point<frame::Patient>& point_in_patient) noexcept {
  const CArmGeometry& geometry = pose.geometry;
  const Vec3 p = (pose.carm_from_patient * point_in_patient).v;
  const double from_source = p.z + geometry.source_to_receptor_mm;
  if (!(from_source > 0)) return std::nullopt;
  const double scale = geometry.source_to_receptor_mm / from_source / geometry.pixel_mm();
  const double centre = 0.5 * (geometry.pixels - 1);
  return PixelPosition{centre + p.x * scale, centre + p.y * scale};
}

}  // namespace carpus::fluoroscopy
