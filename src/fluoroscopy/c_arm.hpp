// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a mini C-arm stands and which views of the wrist it takes. Frame CArm is the receptor: +x
// to the right of the picture, +y down, +z along the beam, away from the source, origin at the
// receptor's centre. The picture is seen as the source sees the hand, fingers up: a left hand's PA
// has its thumb to the right, as hand radiographs are hung. docs/units_and_frames.md draws it.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "geometry/pose.hpp"

namespace carpus::fluoroscopy {

/// Cone beam and receptor. The defaults are those of a mini C-arm: source to receptor 45 cm, the
/// hand 9 cm above the receptor (magnification 1.25), collimated to the wrist.
struct CArmGeometry {
  double source_to_receptor_mm = 450.0;
  double source_to_target_mm = 360.0;
  double field_mm = 80.0;  ///< side of the square picture and diameter of the round field
  int pixels = 512;        ///< per side

  [[nodiscard]] constexpr double pixel_mm() const noexcept { return field_mm / pixels; }
  [[nodiscard]] constexpr double magnification() const noexcept {
    return source_to_receptor_mm / source_to_target_mm;
  }
  constexpr bool operator==(const CArmGeometry&) const = default;
};

/// Angles of a view relative to the wrist.
struct ViewAngles {
  /// About the forearm's long axis: 0 is PA (source dorsal), 90 lateral (source radial), 180 AP.
  /// Positive, for either side, are the *pronated* obliques between PA and lateral; the supinated
  /// ones, seen along the same line, are negative.
  double rotation_deg = 0.0;
  double tilt_deg = 0.0;  ///< source towards proximal (positive) or distal
  constexpr bool operator==(const ViewAngles&) const = default;
};

/// A view with a name. Obliques are named as in [kim2008pronated]: degrees of forearm rotation from
/// neutral, that is from lateral, so 60 degrees pronated is 30 degrees from PA.
struct NamedView {
  std::string_view id;     ///< "oblique_45_pronated", as in the protocol
  std::string_view label;  ///< "45P", as on the page's buttons
  ViewAngles angles;
};

/// PA, lateral, the obliques in which a penetrating screw shows (45 degrees pronated most of all,
/// as clinical series found), and the skyline view of the proximal pole [skyline2021]: the beam 30
/// degrees from the forearm's axis, from dorsal and distal over the flexed wrist.
inline constexpr std::array<NamedView, 6> kNamedViews{{
    {"pa", "PA", {0.0, 0.0}},
    {"lateral", "LAT", {90.0, 0.0}},
    {"oblique_45_pronated", "45P", {45.0, 0.0}},
    {"oblique_45_supinated", "45S", {-45.0, 0.0}},
    {"oblique_60_pronated", "60P", {30.0, 0.0}},
    {"skyline", "SKY", {0.0, -60.0}},
}};

/// The view with this id, or nothing.
[[nodiscard]] std::optional<NamedView> find_view(std::string_view id) noexcept;

/// A C-arm in place.
struct CArmPose {
  Pose<frame::CArm, frame::Patient> carm_from_patient;
  CArmGeometry geometry;

  /// Focal spot [mm].
  [[nodiscard]] Point<frame::Patient> source_in_patient() const noexcept;
};

/// Largest tilt for which the picture's "down" is still well defined by the forearm.
inline constexpr double kMaxTiltDeg = 80.0;

/// Turns the C-arm to a view with its central ray through `target_in_patient` [mm].
/// @param wrist_from_patient  of the forearm from which the view's angles count.
/// @param ulnar_in_wrist  unit vector towards ulnar: +y on a left wrist, -y on a right one.
/// @throws InvalidInput for angles that are not finite, |tilt| above kMaxTiltDeg, or a geometry
///   without a positive field, pixels, and target between source and receptor.
[[nodiscard]] CArmPose make_c_arm_pose(const ViewAngles& view,
                                       const Point<frame::Patient>& target_in_patient,
                                       const Pose<frame::Wrist, frame::Patient>& wrist_from_patient,
                                       const Direction<frame::Wrist>& ulnar_in_wrist,
                                       const CArmGeometry& geometry = {});

/// Position in the picture: the centre of the top left pixel is (0, 0).
struct PixelPosition {
  double x = 0.0;
  double y = 0.0;
};

/// Where a point of the patient falls in the picture, inside its borders or not; nothing for a
/// point level with the source or behind it.
[[nodiscard]] std::optional<PixelPosition> project_point(
    const CArmPose& pose,
    const Point<frame::Patient>& point_in_patient) noexcept;

}  // namespace carpus::fluoroscopy
