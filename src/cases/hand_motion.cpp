// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/hand_motion.hpp"

#include <cmath>

namespace carpus::cases {
namespace {

using anatomy::CarpalGroup;
using anatomy::kCarpalGroupCount;
using Motion = Pose<frame::Patient, frame::Bone>;

/// The cell of a rising axis that holds `value`, and how far into it (0 to 1).
struct Cell {
  std::size_t low = 0;
  std::size_t high = 0;
  double share = 0;
};

Cell cell_of(const std::vector<double>& axis, double value) noexcept {
  if (axis.size() < 2) return {};
  std::size_t low = 0;
  std::size_t high = axis.size() - 1;
  while (high - low > 1) {  // at most log2 of the axis
    const std::size_t middle = (low + high) / 2;
    (value < axis[middle] ? high : low) = middle;
  }
  double share = (value - axis[low]) / (axis[high] - axis[low]);
  share = share > 0 ? (share < 1 ? share : 1.0) : 0.0;
  return {low, high, share};
}

/// Rotation of a quaternion that need not be of unit length; the identity for none.
Mat3 rotation_of(const std::array<double, 4>& q) noexcept {
  const double n2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  if (!(n2 > 0)) return {};
  return rotation_from_quaternion(q[0], q[1], q[2], q[3]);
}

GroupMotion mixed(const std::array<const GroupMotion*, 4>& corners,
                  const std::array<double, 4>& weights) noexcept {
  GroupMotion sum;
  sum.quaternion = {0, 0, 0, 0};
  const auto& first = corners[0]->quaternion;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& q = corners[i]->quaternion;
    // q and -q are one rotation: add those of one half.
    const double with = q[0] * first[0] + q[1] * first[1] + q[2] * first[2] + q[3] * first[3];
    const double weight = with < 0 ? -weights[i] : weights[i];
    for (std::size_t k = 0; k < 4; ++k) sum.quaternion[k] += weight * q[k];
    sum.shift += corners[i]->shift * weights[i];
  }
  return sum;
}

Motion motion_of(const GroupMotion& motion, const Vec3& reference) noexcept {
  const Mat3 turn = rotation_of(motion.quaternion);
  return {turn, reference - turn * reference + motion.shift};
}

/// Along the hand's axis: the proximal row by what the radiocarpal joint opens, the hand by both.
double opening_mm_per_n(const HandMotion& table, CarpalGroup group) noexcept {
  switch (group) {
    case CarpalGroup::Hand:
      return table.radiocarpal_mm_per_n + table.midcarpal_mm_per_n;
    case CarpalGroup::Scaphoid:
    case CarpalGroup::Lunate:
    case CarpalGroup::Triquetrum:
      return table.radiocarpal_mm_per_n;
    default:
      return 0;
  }
}

/// Turns radius and hand about the ulna.
Motion pronation_of(const HandMotion& table, double angle_rad) noexcept {
  const CosSin half = cos_sin_of_small(angle_rad / 2);
  const Vec3 axis = table.pronation_axis * half.sine;
  const Mat3 turn = rotation_of({half.cosine, axis.x, axis.y, axis.z});
  Motion motion{turn, table.pronation_centre - turn * table.pronation_centre};
  if (!table.pronation_shift.empty()) {
    const Cell cell = cell_of(table.pronation_rad, angle_rad);
    motion.translation += table.pronation_shift[cell.low] * (1 - cell.share) +
                          table.pronation_shift[cell.high] * cell.share;
  }
  return motion;
}

}  // namespace

CosSin cos_sin_of_small(double x) noexcept {
  // Taylor series about 0; at 45 degrees the first term left out is 1e-14 of the cosine.
  const double y = x * x;
  const double c =
      1 -
      y / 2 *
          (1 - y / 12 * (1 - y / 30 * (1 - y / 56 * (1 - y / 90 * (1 - y / 132 * (1 - y / 182))))));
  const double s =
      x * (1 - y / 6 * (1 - y / 20 * (1 - y / 42 * (1 - y / 72 * (1 - y / 110 * (1 - y / 156))))));
  return {c, s};
}

std::array<Motion, kCarpalGroupCount> HandMotion::poses_at(
    const anatomy::HandPose& wanted) const noexcept {
  std::array<Motion, kCarpalGroupCount> poses{};
  if (is_empty()) return poses;
  const anatomy::HandPose pose = limits.clamp(wanted);
  const Cell f = cell_of(flexion_rad, pose.flexion_rad);
  const Cell r = cell_of(deviation_rad, pose.radial_deviation_rad);
  const std::size_t columns = deviation_rad.size();
  const std::array<std::size_t, 4> corners{f.low * columns + r.low, f.low * columns + r.high,
                                           f.high * columns + r.low, f.high * columns + r.high};
  const std::array<double, 4> weights{(1 - f.share) * (1 - r.share), (1 - f.share) * r.share,
                                      f.share * (1 - r.share), f.share * r.share};
  for (const CarpalGroup group : anatomy::kMovingGroups) {
    const auto g = static_cast<std::size_t>(group);
    poses[g] = motion_of(mixed({&nodes[corners[0]].groups[g], &nodes[corners[1]].groups[g],
                                &nodes[corners[2]].groups[g], &nodes[corners[3]].groups[g]},
                               weights),
                         reference[g]);
  }
  if (pose.traction_n > 0) {
    const Vec3 axis = poses[static_cast<std::size_t>(CarpalGroup::Hand)].rotation * hand_axis;
    for (const CarpalGroup group : anatomy::kMovingGroups) {
      poses[static_cast<std::size_t>(group)].translation +=
          axis * (opening_mm_per_n(*this, group) * pose.traction_n);
    }
  }
  if (pose.pronation_rad != 0) {
    const Motion turned = pronation_of(*this, pose.pronation_rad);
    for (std::size_t g = 0; g < kCarpalGroupCount; ++g) {
      if (g == static_cast<std::size_t>(CarpalGroup::Ulna)) continue;
      poses[g] = {turned.rotation * poses[g].rotation,
                  turned.rotation * poses[g].translation + turned.translation};
    }
  }
  return poses;
}

Motion HandMotion::pose_of(BoneId bone, const anatomy::HandPose& pose) const noexcept {
  return poses_at(pose)[static_cast<std::size_t>(anatomy::group_of(bone))];
}

}  // namespace carpus::cases
