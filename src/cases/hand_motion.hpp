// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where every bone of this wrist is for any way the hand is held: a table over flexion and
// deviation, made once from carpal kinematics and the bones' surfaces (make_hand_motion.hpp), and
// its reading in the 1 kHz step. The ulna stays where it was scanned.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "anatomy/carpal_kinematics.hpp"
#include "anatomy/hand_pose.hpp"
#include "geometry/pose.hpp"

namespace carpus::cases {

/// Motion of one group from where it was scanned: it turns about `HandMotion::reference` of its
/// group by a unit quaternion (w, x, y, z), and that point moves by `shift` [mm]. Frame Patient.
struct GroupMotion {
  std::array<double, 4> quaternion{1, 0, 0, 0};
  Vec3 shift;
  bool operator==(const GroupMotion&) const = default;
};

/// One way of holding the hand that is in the table: a motion a group, the forearm's at rest.
struct HandMotionNode {
  std::array<GroupMotion, anatomy::kCarpalGroupCount> groups;
  bool operator==(const HandMotionNode&) const = default;
};

/// What the correction against overlap did to one group, over the nodes within the envelope.
struct GroupCorrection {
  double mean_shift_mm = 0;  ///< of the group's middle
  double greatest_shift_mm = 0;
  double mean_turn_deg = 0;
  double greatest_turn_deg = 0;
  bool operator==(const GroupCorrection&) const = default;
};

/// What making the table cost and what it left, over the nodes within the envelope of hand poses
/// and the middles of the cells between nodes (drawn to the envelope where they lie beyond it).
/// Overlap counts how deep one bone's surface lies in
/// another, beyond what the scan itself has between those two [mm].
struct HandMotionReport {
  std::array<GroupCorrection, anatomy::kCarpalGroupCount> corrections;
  double scan_overlap_mm = 0;           ///< the deepest overlap that the scan itself has
  double overlap_of_model_mm = 0;       ///< greatest at a node before correction
  double overlap_at_nodes_mm = 0;       ///< greatest at a node after it
  double overlap_between_nodes_mm = 0;  ///< greatest at the middles of the table's cells
  double nodes_over_tenth_mm = 0;       ///< share of the nodes with more than 0.1 mm, 0 to 1
  double cells_over_tenth_mm = 0;       ///< share of the middles with more than 0.1 mm, 0 to 1
  double overlap_in_pronation_mm = 0;   ///< greatest of ulna and the rest over pronation's nodes
  bool operator==(const HandMotionReport&) const = default;
};

/// The table. Frame Patient; Bone is Patient as scanned, so that the pose of a bone is the identity
/// in the pose of the scan (which is a node of both axes, stored as exactly that).
struct HandMotion {
  anatomy::HandLimits limits;
  anatomy::HandPose scan;             ///< how the hand was held; pronation and traction are 0
  std::vector<double> flexion_rad;    ///< rising; from the lower to the upper limit
  std::vector<double> deviation_rad;  ///< rising; radial is positive
  std::vector<HandMotionNode> nodes;  ///< [flexion * deviation count + deviation]
  std::array<Vec3, anatomy::kCarpalGroupCount> reference;  ///< the groups' middles as scanned [mm]

  Vec3 hand_axis;                   ///< unit, along the capitate towards distal, as scanned
  double radiocarpal_mm_per_n = 0;  ///< opening by traction along that axis
  double midcarpal_mm_per_n = 0;

  Vec3 pronation_axis;                ///< unit; a positive turn about it pronates
  Vec3 pronation_centre;              ///< a point of that axis, in the ulna's head [mm]
  std::vector<double> pronation_rad;  ///< rising; nodes of `pronation_shift`
  std::vector<Vec3> pronation_shift;  ///< moves all but the ulna, so that it does not meet it [mm]

  HandMotionReport report;

  bool operator==(const HandMotion&) const = default;
  [[nodiscard]] bool is_empty() const noexcept { return nodes.empty(); }

  /// Where each group is, by CarpalGroup. `pose` is clamped to `limits` first. Continuous:
  /// bilinear in flexion and deviation, with normalised quaternions; linear between nodes of
  /// pronation. Real-time: no allocation, bounded, only + - * / and sqrt. The identity where
  /// is_empty().
  [[nodiscard]] std::array<Pose<frame::Patient, frame::Bone>, anatomy::kCarpalGroupCount> poses_at(
      const anatomy::HandPose& pose) const noexcept;

  /// The same for one bone.
  [[nodiscard]] Pose<frame::Patient, frame::Bone> pose_of(
      BoneId bone,
      const anatomy::HandPose& pose) const noexcept;
};

/// Cosine and sine of an angle of at most 45 degrees, by polynomials: off by less than 1e-13, with
/// only + - *, so that a step may call it and every machine gives the same bits.
struct CosSin {
  double cosine = 1;
  double sine = 0;
};
[[nodiscard]] CosSin cos_sin_of_small(double angle_rad) noexcept;

}  // namespace carpus::cases
