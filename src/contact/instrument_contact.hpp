// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Contact of one instrument with the true surface of one bone: how deep, where, which way out, and
// along which stretches of the shaft.
#pragma once

#include <array>
#include <cstdint>

#include "fields/contact_field.hpp"
#include "fields/cut_bone.hpp"
#include "geometry/instrument_shape.hpp"
#include "geometry/pose.hpp"

namespace carpus::contact {

enum class ContactOutcome : std::uint8_t {
  NotKnown,  ///< the pose is not finite, or the shape is too thick for the field: take the last
             ///< safe answer
  Far,       ///< farther than was asked for; only gap_mm and its bounds are given
  Near,      ///< apart, within what was asked for
  Touching,  ///< touching or overlapping
  Buried,    ///< the axis may lie deeper in the bone than the field reaches: the depth is at least
             ///< -highest_gap_mm, and point and normal need not be those of the nearest surface
};

/// Stretches of the shaft that touch which are told one by one; the deepest are kept.
inline constexpr std::size_t kMaxStretches = 4;

/// A part of the shaft that touches without interruption.
struct ContactStretch {
  double from_mm = 0;  ///< z of the first and the last touching ball in frame Tool
  double to_mm = 0;
  double z_mm = 0;  ///< of its deepest ball
  double depth_mm = 0;
  Point<frame::Bone> point{};       ///< of the surface, nearest to that ball's centre
  Direction<frame::Bone> normal{};  ///< unit, out of the bone; zero where the field has no slope
};

/// What of the instrument touches.
struct ContactPatch {
  double length_mm = 0;    ///< of the shaft, all stretches
  double area_mm2 = 0;     ///< of the instrument's section with the surface, each part taken flat
  double centre_z_mm = 0;  ///< along the shaft, weighted by depth: where a uniform bed would push
  double core_length_mm = 0;  ///< threaded cylinder: where the core touches too
  double thread_turns = 0;    ///< threaded cylinder: turns of the thread on length_mm
  std::array<ContactStretch, kMaxStretches> stretches{};  ///< along the shaft
  std::uint8_t stretch_count = 0;
  std::uint16_t stretches_found = 0;  ///< more than stretch_count if not all were kept
};

/// The gap is the least of (distance of a ball's centre to the surface) - (its radius) over all
/// balls of the shape: the distance where they are apart; less than 0, the depth by which the most
/// deeply sunk ball must move along its normal.
///
/// gap_mm is that gap for the field's surface, to 1e-6 mm. For the true surface it lies between
/// lowest_gap_mm and highest_gap_mm, which follow from the two bounds of contact_field.hpp: never
/// wider than +-field.error_mm(), and about 3 h^2 / (8 r) on the deep side for a bar of radius r
/// that meets a surface from outside (h: spacing).
struct SurfaceContact {
  ContactOutcome outcome = ContactOutcome::NotKnown;
  double gap_mm = 0;
  double lowest_gap_mm = 0;
  double highest_gap_mm = 0;
  double z_mm = 0;                  ///< centre of the ball that is nearest or deepest, frame Tool
  Point<frame::Bone> point{};       ///< of the surface, nearest to that centre
  Direction<frame::Bone> normal{};  ///< unit, out of the bone; zero where the field has no slope
  /// Length of the field's gradient there: about 1 where one part of the surface is nearest, less
  /// where two compete and the normal is their compromise.
  double steepness = 0;
  ContactPatch patch{};

  [[nodiscard]] bool has_contact() const noexcept {
    return outcome == ContactOutcome::Touching || outcome == ContactOutcome::Buried;
  }
  [[nodiscard]] double depth_mm() const noexcept { return has_contact() ? -gap_mm : 0.0; }
};

/// The largest gap that a field can tell for a shape; negative: the shape is too thick for it.
[[nodiscard]] inline double greatest_gap_mm(const fields::ContactField& field,
                                            const InstrumentShape& shape) noexcept {
  return field.reach_mm() - field.error_mm() - shape.greatest_radius_mm();
}

/// The least true gap where the field's gap is at least `field_gap_mm` all along the shape: bound
/// (1) does not depend on the radius, bound (2) is weakest for the thinnest ball.
[[nodiscard]] double lowest_gap_mm(const fields::ContactField& field,
                                   const InstrumentShape& shape,
                                   double field_gap_mm) noexcept;

/// @param within_mm  gaps up to this are told as Near; at most greatest_gap_mm().
/// Depends on its arguments alone. Real-time: no allocation, only + - * / and sqrt. Cost: one
/// polynomial for each cell that the axis meets near the surface, strides of the field's value
/// elsewhere; at most 3 cells per spacing of the axis within the grid.
/// Source: the strides are those of sphere tracing [hart1996sphere] §2, along a line.
[[nodiscard]] SurfaceContact find_contact(const fields::ContactField& field,
                                          const InstrumentShape& shape,
                                          const Pose<frame::Bone, frame::Tool>& bone_from_tool,
                                          double within_mm = 0) noexcept;

/// The same for what is left of a bone that was cut. gap_mm is that of max(f_d, f_c), to 1e-4 mm
/// (fields/cut_field.hpp); as before if nothing was cut, in every bit. lowest_gap_mm stands as it
/// does for a whole bone. highest_gap_mm needs a place that is proven to be bone beneath the
/// surface found; where what is left is too thin for that, or where the surface that the field
/// tells of was drilled away, it is infinite. Buried begins at depths of fields::kCutDepthMm. Cost:
/// within the cuts one more polynomial, cells half as wide.
[[nodiscard]] SurfaceContact find_contact(const fields::CutBone& left,
                                          const InstrumentShape& shape,
                                          const Pose<frame::Bone, frame::Tool>& bone_from_tool,
                                          double within_mm = 0) noexcept;

}  // namespace carpus::contact
