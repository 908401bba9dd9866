// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One step: every vertex that is nearer to another group's bone than it may be gives an equation
// "move apart along the surface's normal by what is missing", every joint wider than in the scan
// one at its narrowest place; the equations' damped least squares give each block's increment.
#include "cases/detail/part_bones.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace carpus::cases::detail {
namespace {

using anatomy::CarpalGroup;

constexpr int kMaxSteps = 50;
constexpr int kStepsWithDraw = 30;     ///< joints are drawn together in these only
constexpr int kStepsBetweenLooks = 8;  ///< after which the near vertices are gathered again
constexpr double kNearEnoughMm = 0.02;
constexpr double kLeverMm = 8;         ///< half a carpal bone: weighs turns against shifts
constexpr double kDamping = 1.0;       ///< in equations' worth
constexpr double kOverlapWeight = 10;  ///< of bone in bone, against room that is missing
constexpr double kDrawWeight = 0.5;
constexpr double kJointMm = 2.0;  ///< groups nearer than this in the scan share a joint
constexpr double kLongestStepMm = 1.0;
constexpr double kGreatestTurnRad = 0.1;

constexpr std::size_t kMaxUnknowns = 24;

struct NormalEquations {
  std::array<std::array<double, kMaxUnknowns>, kMaxUnknowns> matrix{};
  std::array<double, kMaxUnknowns> right{};
  std::size_t size = 0;
};

/// Derivatives of one distance by the unknowns, at most two blocks of six.
struct Row {
  std::array<std::size_t, 12> column{};
  std::array<double, 12> value{};
  std::size_t count = 0;
  void add(std::size_t c, double v) noexcept {
    column[count] = c;
    value[count++] = v;
  }
};

void add_equation(NormalEquations& system, const Row& row, double missing, double weight) noexcept {
  for (std::size_t i = 0; i < row.count; ++i) {
    system.right[row.column[i]] += weight * row.value[i] * missing;
    for (std::size_t j = 0; j < row.count; ++j) {
      system.matrix[row.column[i]][row.column[j]] += weight * row.value[i] * row.value[j];
    }
  }
}

/// Solves in place by Cholesky; the damped matrix is positive definite.
std::array<double, kMaxUnknowns> solve(NormalEquations& s) noexcept {
  auto& m = s.matrix;
  for (std::size_t j = 0; j < s.size; ++j) {
    for (std::size_t i = j; i < s.size; ++i) {
      double sum = m[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= m[i][k] * m[j][k];
      m[i][j] = i == j ? std::sqrt(std::max(sum, 1e-12)) : sum / m[j][j];
    }
  }
  std::array<double, kMaxUnknowns> x = s.right;
  for (std::size_t i = 0; i < s.size; ++i) {
    for (std::size_t k = 0; k < i; ++k) x[i] -= m[i][k] * x[k];
    x[i] /= m[i][i];
  }
  for (std::size_t i = s.size; i-- > 0;) {
    for (std::size_t k = i + 1; k < s.size; ++k) x[i] -= m[k][i] * x[k];
    x[i] /= m[i][i];
  }
  return x;
}

class Parting {
 public:
  Parting(const BoneScene& scene, const Freedom& freedom) : scene_(scene), freedom_(freedom) {
    std::size_t next = 0;
    for (int b = 0; b < freedom.block_count; ++b) {
      first_[static_cast<std::size_t>(b)] = next;
      next += freedom.block_turns[static_cast<std::size_t>(b)] ? 6 : 3;
    }
    unknowns_ = next;
    for (auto& row : joint_gap_) row.fill(BoneScene::kFarMm);
    for (std::size_t a = 0; a < scene.size(); ++a) {
      for (std::size_t b = 0; b < scene.size(); ++b) {
        double& gap = joint_gap_[index(scene.group_of(a))][index(scene.group_of(b))];
        if (a != b) gap = std::min(gap, scene.scan_gap_mm(a, b));
      }
    }
  }

  [[nodiscard]] GroupPoses run(GroupPoses poses) const {
    std::vector<NearPoint> near;
    for (int step = 0; step < kMaxSteps; ++step) {
      if (step % kStepsBetweenLooks == 0)
        near = movable(scene_.near_points(poses, BoneScene::kFarMm));
      const bool draws = step < kStepsWithDraw;
      NormalEquations system = equations(near, poses, draws);
      if (worst_ < kNearEnoughMm && (!draws || widest_ < 0.1)) break;
      apply(solve(system), poses);
    }
    return poses;
  }

 private:
  static std::size_t index(CarpalGroup group) noexcept { return static_cast<std::size_t>(group); }
  [[nodiscard]] int block_of(std::size_t body) const noexcept {
    return freedom_.block_of_group[index(scene_.group_of(body))];
  }

  [[nodiscard]] std::vector<NearPoint> movable(std::vector<NearPoint> near) const {
    std::erase_if(near, [&](const NearPoint& p) { return block_of(p.on) == block_of(p.to); });
    return near;
  }

  /// Derivative of the distance of a point at `p` [Patient] along `normal`, for body `body` moving
  /// with sign +1 (it carries the point) or -1 (it is what the point is near).
  void add_block(Row& row,
                 std::size_t body,
                 const Vec3& p,
                 const Vec3& normal,
                 double sign,
                 const GroupPoses& poses) const noexcept {
    const int block = block_of(body);
    if (block == Freedom::kFixed) return;
    const auto b = static_cast<std::size_t>(block);
    for (std::size_t i = 0; i < 3; ++i) row.add(first_[b] + i, sign * normal[i]);
    if (!freedom_.block_turns[b]) return;
    const Vec3 moment = cross(p - middle_of(scene_.group_of(body), poses), normal) / kLeverMm;
    for (std::size_t i = 0; i < 3; ++i) row.add(first_[b] + 3 + i, sign * moment[i]);
  }

  [[nodiscard]] Vec3 middle_of(CarpalGroup group, const GroupPoses& poses) const noexcept {
    return (poses[index(group)] * Point<frame::Bone>{scene_.middle_of(group)}).v;
  }

  [[nodiscard]] Row row_of(const NearPoint& near,
                           const Separation& separation,
                           const GroupPoses& poses) const noexcept {
    const Vec3 p = (poses[index(scene_.group_of(near.on))] * Point<frame::Bone>{near.point}).v;
    Row row;
    add_block(row, near.on, p, separation.outward, 1, poses);
    add_block(row, near.to, p, separation.outward, -1, poses);
    return row;
  }

  [[nodiscard]] NormalEquations equations(const std::vector<NearPoint>& near,
                                          const GroupPoses& poses,
                                          bool draws) const {
    struct Narrowest {
      double distance_mm = BoneScene::kFarMm;
      const NearPoint* at = nullptr;
      Separation separation;
    };
    std::array<std::array<Narrowest, anatomy::kCarpalGroupCount>, anatomy::kCarpalGroupCount>
        joints{};
    NormalEquations system;
    system.size = unknowns_;
    worst_ = 0;
    widest_ = 0;
    for (const NearPoint& point : near) {
      const Separation separation = scene_.separation_of(point, poses);
      const double scan_gap = scene_.scan_gap_mm(point.on, point.to);
      const double missing = std::min(scan_gap, kJointRoomMm) - separation.distance_mm;
      if (missing > 0) {
        worst_ = std::max(worst_, missing);
        const bool overlaps = separation.distance_mm < std::min(scan_gap, 0.0);
        add_equation(system, row_of(point, separation, poses), missing,
                     overlaps ? kOverlapWeight : 1.0);
      }
      auto& joint = joints[index(scene_.group_of(point.on))][index(scene_.group_of(point.to))];
      if (separation.distance_mm < joint.distance_mm) {
        joint = {separation.distance_mm, &point, separation};
      }
    }
    for (std::size_t a = 0; draws && a < joints.size(); ++a) {
      for (std::size_t b = 0; b < joints.size(); ++b) {
        const Narrowest& joint = joints[a][b];
        const double too_wide = joint.distance_mm - joint_gap_[a][b];
        if (joint.at == nullptr || !(joint_gap_[a][b] < kJointMm) || !(too_wide > 0)) continue;
        widest_ = std::max(widest_, too_wide);
        add_equation(system, row_of(*joint.at, joint.separation, poses), -too_wide, kDrawWeight);
      }
    }
    for (std::size_t i = 0; i < unknowns_; ++i) system.matrix[i][i] += kDamping;
    return system;
  }

  void apply(const std::array<double, kMaxUnknowns>& x, GroupPoses& poses) const noexcept {
    for (std::size_t g = 0; g < poses.size(); ++g) {
      const int block = freedom_.block_of_group[g];
      if (block == Freedom::kFixed) continue;
      const auto b = static_cast<std::size_t>(block);
      const std::size_t f = first_[b];
      Vec3 shift{x[f], x[f + 1], x[f + 2]};
      if (const double far = length(shift); far > kLongestStepMm) shift *= kLongestStepMm / far;
      if (!freedom_.block_turns[b]) {
        poses[g].translation += shift;
        continue;
      }
      const Vec3 turn = Vec3{x[f + 3], x[f + 4], x[f + 5]} / kLeverMm;
      const double angle = length(turn);
      if (!(angle > 0)) {
        poses[g].translation += shift;
        continue;
      }
      const Vec3 middle = middle_of(static_cast<CarpalGroup>(g), poses);
      const Mat3 r = rotation_about(turn / angle, std::min(angle, kGreatestTurnRad));
      poses[g] = {r * poses[g].rotation, r * (poses[g].translation - middle) + middle + shift};
    }
  }

  const BoneScene& scene_;
  const Freedom& freedom_;
  std::array<std::size_t, anatomy::kCarpalGroupCount> first_{};
  std::size_t unknowns_ = 0;
  std::array<std::array<double, anatomy::kCarpalGroupCount>, anatomy::kCarpalGroupCount>
      joint_gap_{};
  mutable double worst_ = 0;   ///< of the last equations: greatest missing room
  mutable double widest_ = 0;  ///< and by how much a joint is too wide
};

}  // namespace

Freedom carpal_freedom() noexcept {
  Freedom freedom;
  for (const CarpalGroup group : anatomy::kMovingGroups) {
    const auto block = static_cast<std::size_t>(freedom.block_count);
    freedom.block_of_group[static_cast<std::size_t>(group)] = freedom.block_count++;
    freedom.block_turns[block] = group != CarpalGroup::Hand;
  }
  return freedom;
}

Freedom pronation_freedom() noexcept {
  Freedom freedom;
  freedom.block_of_group.fill(0);
  freedom.block_of_group[static_cast<std::size_t>(CarpalGroup::Ulna)] = Freedom::kFixed;
  freedom.block_count = 1;
  return freedom;
}

GroupPoses part_bones(const BoneScene& scene, GroupPoses poses, const Freedom& freedom) {
  return Parting(scene, freedom).run(poses);
}

}  // namespace carpus::cases::detail
