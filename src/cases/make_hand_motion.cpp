// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Read the scan's own hand pose; lay the axes so that it is a node of both.
// 2. From there along deviation, then from each of these nodes both ways along flexion: model,
//    neighbour's correction (a little less of it), parting of the bones.
// 3. Round, so that a file holds the same bits; measure what is left.
#include "cases/make_hand_motion.hpp"

#include <algorithm>
#include <cmath>

#include "cases/detail/bone_scene.hpp"
#include "cases/detail/part_bones.hpp"
#include "cases/detail/stored_digits.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"

namespace carpus::cases {
namespace {

using anatomy::CarpalGroup;
using anatomy::CarpalKinematics;
using anatomy::HandPose;
using anatomy::kCarpalGroupCount;
using anatomy::kMovingGroups;
using detail::BoneScene;
using detail::GroupPoses;
using Motion = Pose<frame::Patient, frame::Bone>;

/// How much of a neighbour's correction a node starts from: less than all, so that a correction
/// fades where it is no longer needed.
constexpr double kInheritedShare = 0.9;
constexpr double kPronationStepDeg = 15;
/// Overlaps up to this are counted as none in the shares of the report [mm].
constexpr double kTenthMm = 0.1;
/// The part of the ulna's length, from its distal end, whose middle is taken for the head's [mm].
constexpr double kUlnarHeadMm = 8;

constexpr std::size_t index(CarpalGroup group) { return static_cast<std::size_t>(group); }

/// To millionths, which are printed in few digits and read back to the same bits.
using detail::rounded;
anatomy::Interval rounded(const anatomy::Interval& i) { return {rounded(i.low), rounded(i.high)}; }

/// Rises from `low` to `high` in equal steps of at most `step`, with `node` among them.
std::vector<double> axis_through(double low, double node, double high, double step) {
  std::vector<double> axis;
  const auto fill = [&](double from, double to) {
    const int steps = static_cast<int>(std::ceil((to - from) / step - 1e-9));
    for (int i = 0; i < steps; ++i) axis.push_back(rounded(from + (to - from) * i / steps));
  };
  fill(low, node);
  fill(node, high);
  axis.push_back(high);
  return axis;
}

std::array<double, 4> quaternion_of(const Mat3& m) {
  const auto& r = m.rows;
  const double trace = r[0].x + r[1].y + r[2].z;
  std::array<double, 4> q{};
  if (trace > 0) {
    const double s = 2 * std::sqrt(trace + 1);
    q = {s / 4, (r[2].y - r[1].z) / s, (r[0].z - r[2].x) / s, (r[1].x - r[0].y) / s};
  } else {  // turned by more than 120 degrees: the largest component first
    std::size_t i = r[1].y > r[0].x ? 1 : 0;
    if (r[2].z > r[i][i]) i = 2;
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    const double s = 2 * std::sqrt(1 + r[i][i] - r[j][j] - r[k][k]);
    q[0] = (r[k][j] - r[j][k]) / s;
    q[1 + i] = s / 4;
    q[1 + j] = (r[j][i] + r[i][j]) / s;
    q[1 + k] = (r[k][i] + r[i][k]) / s;
  }
  return q;
}

double angle_of(const Mat3& m) {
  const auto q = quaternion_of(m);
  return 2 * std::atan2(std::sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), std::abs(q[0]));
}

Mat3 scaled_turn(const Mat3& m, double share) {
  const auto q = quaternion_of(m);
  const Vec3 axis = normalized_or(Vec3{q[1], q[2], q[3]} * (q[0] < 0 ? -1.0 : 1.0), {0, 0, 0});
  if (!(length(axis) > 0)) return Mat3::identity();
  return rotation_about(axis, share * angle_of(m));
}

GroupMotion stored(const Motion& motion, const Vec3& reference) {
  GroupMotion result;
  result.quaternion = quaternion_of(motion.rotation);
  for (double& q : result.quaternion) q = rounded(q);
  result.shift = rounded((motion * Point<frame::Bone>{reference}).v - reference);
  return result;
}

class Maker {
 public:
  Maker(const CaseData& data, const HandMotionOptions& options)
      : data_(data), model_(CarpalKinematics::published()), scene_(data) {
    const Bone* capitate = find_bone(data, BoneId::Capitate);
    if (capitate == nullptr) {
      throw InvalidInput("hand motion: the case has no capitate to tell how the hand is held");
    }
    const Pose<frame::Patient, frame::Bone> as_scanned;
    landmarks_ =
        model_.landmarks_of(data.wrist_from_patient * as_scanned * capitate->surface, data.side);
    lay_out(radians_from_degrees(options.step_deg));
  }

  HandMotion run() {
    table_.nodes.resize(rows() * columns());
    poses_.resize(table_.nodes.size());
    poses_[scan_row_ * columns() + scan_column_] = GroupPoses{};
    sweep_deviation();
    parallel_for(2 * columns(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t task = begin; task < end; ++task) sweep_flexion(task / 2, task % 2 == 0);
    });
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      for (const CarpalGroup group : kMovingGroups) {
        table_.nodes[i].groups[index(group)] =
            stored(poses_[i][index(group)], table_.reference[index(group)]);
      }
    }
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      if (is_reachable(i)) reachable_.push_back(i);
    }
    sweep_pronation();
    report_corrections();
    report_overlaps();
    return std::move(table_);
  }

 private:
  [[nodiscard]] std::size_t rows() const { return table_.flexion_rad.size(); }
  [[nodiscard]] std::size_t columns() const { return table_.deviation_rad.size(); }

  void lay_out(double step_rad) {
    const anatomy::HandLimits& limits = model_.limits();
    table_.limits = {rounded(limits.flexion_rad), rounded(limits.radial_deviation_rad),
                     rounded(limits.pronation_rad), limits.traction_n};
    table_.scan = table_.limits.clamp({rounded(landmarks_.scan.flexion_rad),
                                       rounded(landmarks_.scan.radial_deviation_rad), 0, 0});
    landmarks_.scan = table_.scan;
    table_.flexion_rad = axis_through(table_.limits.flexion_rad.low, table_.scan.flexion_rad,
                                      table_.limits.flexion_rad.high, step_rad);
    table_.deviation_rad =
        axis_through(table_.limits.radial_deviation_rad.low, table_.scan.radial_deviation_rad,
                     table_.limits.radial_deviation_rad.high, step_rad);
    const auto place = [](const std::vector<double>& axis, double value) {
      return static_cast<std::size_t>(std::find(axis.begin(), axis.end(), value) - axis.begin());
    };
    scan_row_ = place(table_.flexion_rad, table_.scan.flexion_rad);
    scan_column_ = place(table_.deviation_rad, table_.scan.radial_deviation_rad);
    for (const CarpalGroup group : kMovingGroups) {
      table_.reference[index(group)] = rounded(scene_.middle_of(group));
    }
    const auto patient_from_wrist = data_.wrist_from_patient.inverse();
    table_.hand_axis =
        rounded((patient_from_wrist * Direction<frame::Wrist>{landmarks_.hand_axis}).v);
    table_.radiocarpal_mm_per_n = model_.radiocarpal_mm_per_n();
    table_.midcarpal_mm_per_n = model_.midcarpal_mm_per_n();
    // Pronation takes the radius over the front of the ulna: about -x on a left wrist.
    const double towards = data_.side == Side::Left ? -1 : 1;
    table_.pronation_axis =
        rounded((patient_from_wrist * Direction<frame::Wrist>{{towards, 0, 0}}).v);
    table_.pronation_centre = rounded(ulnar_head());
  }

  /// Middle of the ulna's distal end; without an ulna, where the radius' frame has its origin.
  [[nodiscard]] Vec3 ulnar_head() const {
    const auto patient_from_wrist = data_.wrist_from_patient.inverse();
    const Bone* ulna = find_bone(data_, BoneId::Ulna);
    if (ulna == nullptr || ulna->surface.vertices.empty()) return patient_from_wrist.translation;
    const Vec3 proximal = (patient_from_wrist * Direction<frame::Wrist>{{1, 0, 0}}).v;
    double distal_end = 1e30;
    for (const Vec3& v : ulna->surface.vertices) {
      distal_end = std::min(distal_end, dot(v, proximal));
    }
    Aabb head;
    for (const Vec3& v : ulna->surface.vertices) {
      if (dot(v, proximal) - distal_end < kUlnarHeadMm) head.include(v);
    }
    return head.centre();
  }

  [[nodiscard]] GroupPoses model_poses(const HandPose& pose) const {
    GroupPoses poses{};
    const auto& wrist_from_patient = data_.wrist_from_patient;
    for (const CarpalGroup group : kMovingGroups) {
      const auto motion = model_.motion_from_scan(group, pose, landmarks_, data_.side);
      const auto in_patient = wrist_from_patient.inverse() * motion * wrist_from_patient;
      poses[index(group)] = {in_patient.rotation, in_patient.translation};
    }
    return poses;
  }

  [[nodiscard]] HandPose pose_at(std::size_t row, std::size_t column) const {
    return {table_.flexion_rad[row], table_.deviation_rad[column], 0, 0};
  }

  /// Whether the hand can be held so.
  [[nodiscard]] bool is_reachable(std::size_t node) const {
    return table_.limits.reach(pose_at(node / columns(), node % columns())) <= 1 + 1e-9;
  }
  /// Whether a pose within the envelope may be read from this node: it or a neighbour is.
  [[nodiscard]] bool is_read(std::size_t row, std::size_t column) const {
    for (std::size_t r = row > 0 ? row - 1 : 0; r <= std::min(row + 1, rows() - 1); ++r) {
      for (std::size_t c = column > 0 ? column - 1 : 0; c <= std::min(column + 1, columns() - 1);
           ++c) {
        if (is_reachable(r * columns() + c)) return true;
      }
    }
    return false;
  }

  /// A node from a neighbour's: the same correction about each group's middle, then parting.
  [[nodiscard]] GroupPoses node_from(std::size_t row,
                                     std::size_t column,
                                     std::size_t from_row,
                                     std::size_t from_column) const {
    GroupPoses poses = model_poses(pose_at(row, column));
    const GroupPoses there = model_poses(pose_at(from_row, from_column));
    const GroupPoses& corrected = poses_[from_row * columns() + from_column];
    for (const CarpalGroup group : kMovingGroups) {
      const std::size_t g = index(group);
      const Point<frame::Bone> middle{table_.reference[g]};
      const Mat3 turn =
          scaled_turn(corrected[g].rotation * there[g].rotation.transposed(), kInheritedShare);
      const Vec3 shift = ((corrected[g] * middle).v - (there[g] * middle).v) * kInheritedShare;
      const Vec3 here = (poses[g] * middle).v;
      poses[g] = {turn * poses[g].rotation, turn * (poses[g].translation - here) + here + shift};
    }
    if (!is_read(row, column)) return poses;
    return detail::part_bones(scene_, poses, detail::carpal_freedom());
  }

  void sweep_deviation() {
    for (std::size_t c = scan_column_ + 1; c < columns(); ++c) {
      poses_[scan_row_ * columns() + c] = node_from(scan_row_, c, scan_row_, c - 1);
    }
    for (std::size_t c = scan_column_; c-- > 0;) {
      poses_[scan_row_ * columns() + c] = node_from(scan_row_, c, scan_row_, c + 1);
    }
  }

  void sweep_flexion(std::size_t column, bool flexes) {
    if (flexes) {
      for (std::size_t r = scan_row_ + 1; r < rows(); ++r) {
        poses_[r * columns() + column] = node_from(r, column, r - 1, column);
      }
    } else {
      for (std::size_t r = scan_row_; r-- > 0;) {
        poses_[r * columns() + column] = node_from(r, column, r + 1, column);
      }
    }
  }

  void sweep_pronation() {
    const anatomy::Interval& range = table_.limits.pronation_rad;
    table_.pronation_rad =
        axis_through(range.low, 0, range.high, radians_from_degrees(kPronationStepDeg));
    const auto& axis = table_.pronation_rad;
    const auto middle =
        static_cast<std::size_t>(std::find(axis.begin(), axis.end(), 0.0) - axis.begin());
    std::vector<Vec3> shifts(axis.size());
    const auto parted = [&](std::size_t i, const Vec3& start) {
      HandPose pose = table_.scan;
      pose.pronation_rad = axis[i];
      GroupPoses poses = table_.poses_at(pose);  // without a shift as yet
      const Vec3 before = poses[index(CarpalGroup::Radius)].translation;
      for (std::size_t g = 0; g < poses.size(); ++g) {
        if (g != index(CarpalGroup::Ulna)) poses[g].translation += start * kInheritedShare;
      }
      poses = detail::part_bones(scene_, poses, detail::pronation_freedom());
      return rounded(poses[index(CarpalGroup::Radius)].translation - before);
    };
    for (std::size_t i = middle + 1; i < axis.size(); ++i) shifts[i] = parted(i, shifts[i - 1]);
    for (std::size_t i = middle; i-- > 0;) shifts[i] = parted(i, shifts[i + 1]);
    table_.pronation_shift = std::move(shifts);
  }

  void report_corrections() {
    for (const CarpalGroup group : kMovingGroups) {
      const std::size_t g = index(group);
      if (!scene_.has(group)) continue;
      GroupCorrection& c = table_.report.corrections[g];
      const Point<frame::Bone> middle{table_.reference[g]};
      const double count = static_cast<double>(reachable_.size());
      for (const std::size_t i : reachable_) {
        const Motion model = model_poses(pose_at(i / columns(), i % columns()))[g];
        const double shift = distance((poses_[i][g] * middle).v, (model * middle).v);
        const double turn_deg =
            degrees_from_radians(angle_of(poses_[i][g].rotation * model.rotation.transposed()));
        c.mean_shift_mm += shift / count;
        c.mean_turn_deg += turn_deg / count;
        c.greatest_shift_mm = std::max(c.greatest_shift_mm, shift);
        c.greatest_turn_deg = std::max(c.greatest_turn_deg, turn_deg);
      }
      c = {rounded(c.mean_shift_mm), rounded(c.greatest_shift_mm), rounded(c.mean_turn_deg),
           rounded(c.greatest_turn_deg)};
    }
  }

  struct Overlaps {
    double greatest_mm = 0;
    double share_over_tenth = 0;
  };
  /// Measured side by side, combined in order.
  template <typename PoseAt>
  [[nodiscard]] Overlaps overlaps_of(std::size_t count, const PoseAt& poses_at) const {
    std::vector<double> overlap(count);
    parallel_for(count, 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) overlap[i] = scene_.overlap_mm(poses_at(i));
    });
    Overlaps result;
    for (const double o : overlap) {
      result.greatest_mm = std::max(result.greatest_mm, o);
      if (o > kTenthMm) result.share_over_tenth += 1.0 / static_cast<double>(count);
    }
    return {rounded(result.greatest_mm), rounded(result.share_over_tenth)};
  }

  void report_overlaps() {
    HandMotionReport& report = table_.report;
    report.scan_overlap_mm = rounded(scene_.scan_overlap_mm());
    const auto node_pose = [&](std::size_t i) {
      return pose_at(reachable_[i] / columns(), reachable_[i] % columns());
    };
    report.overlap_of_model_mm = overlaps_of(reachable_.size(), [&](std::size_t i) {
                                   return model_poses(node_pose(i));
                                 }).greatest_mm;
    const Overlaps nodes = overlaps_of(
        reachable_.size(), [&](std::size_t i) { return table_.poses_at(node_pose(i)); });
    report.overlap_at_nodes_mm = nodes.greatest_mm;
    report.nodes_over_tenth_mm = nodes.share_over_tenth;
    const std::size_t cells_across = columns() - 1;
    const Overlaps cells = overlaps_of((rows() - 1) * cells_across, [&](std::size_t i) {
      const std::size_t r = i / cells_across;
      const std::size_t c = i % cells_across;
      const HandPose a = pose_at(r, c);
      const HandPose b = pose_at(r + 1, c + 1);
      return table_.poses_at({(a.flexion_rad + b.flexion_rad) / 2,
                              (a.radial_deviation_rad + b.radial_deviation_rad) / 2, 0, 0});
    });
    report.overlap_between_nodes_mm = cells.greatest_mm;
    report.cells_over_tenth_mm = cells.share_over_tenth;
    report.overlap_in_pronation_mm = overlaps_of(table_.pronation_rad.size(), [&](std::size_t i) {
                                       HandPose pose = table_.scan;
                                       pose.pronation_rad = table_.pronation_rad[i];
                                       return table_.poses_at(pose);
                                     }).greatest_mm;
  }

  const CaseData& data_;
  const CarpalKinematics& model_;
  BoneScene scene_;
  anatomy::WristLandmarks landmarks_;
  HandMotion table_;
  std::vector<GroupPoses> poses_;
  std::vector<std::size_t> reachable_;  ///< nodes within the envelope
  std::size_t scan_row_ = 0;
  std::size_t scan_column_ = 0;
};

}  // namespace

HandMotion make_hand_motion(const CaseData& data, const HandMotionOptions& options) {
  return Maker(data, options).run();
}

void ensure_hand_motion(CaseData& data) {
  if (data.hand_motion.is_empty()) data.hand_motion = make_hand_motion(data);
}

double overlap_at(const CaseData& data, const HandMotion& motion, const anatomy::HandPose& pose) {
  return detail::BoneScene(data).overlap_mm(motion.poses_at(pose));
}

}  // namespace carpus::cases
