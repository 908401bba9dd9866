// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "collision/lp/hull_collider.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"
#include "core/units.hpp"

namespace carpus::collision {
namespace {

bool is_finite_pose(const Pose<frame::Bone, frame::Tool>& pose) noexcept {
  return is_finite(pose.translation) && is_finite(pose.rotation.rows[0]) &&
         is_finite(pose.rotation.rows[1]) && is_finite(pose.rotation.rows[2]);
}

/// Both boxes hold their bodies, so this holds whatever they share; grown by the tolerance because
/// the boxes are computed from moved vertices and the rows from moved planes.
Aabb overlap_of(const Aabb& a, const Aabb& b) noexcept {
  Aabb both;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    both.low[axis] = std::max(a.low[axis], b.low[axis]) - kContactToleranceMm;
    both.high[axis] = std::min(a.high[axis], b.high[axis]) + kContactToleranceMm;
  }
  return both;
}

/// From the first box towards the second, along the axis of the widest gap.
Vec3 gap_direction(const Aabb& from, const Aabb& to) noexcept {
  Vec3 direction;
  double widest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double above = to.low[axis] - from.high[axis];
    const double below = from.low[axis] - to.high[axis];
    if (std::max(above, below) > widest) {
      widest = std::max(above, below);
      direction = {};
      direction[axis] = above > below ? 1.0 : -1.0;
    }
  }
  return direction;
}

/// A face of the bounds is a face of the box that set it there.
bool belongs_to_bone(const LpRows& rows, std::uint32_t index, const Aabb& bone_box) noexcept {
  const std::uint32_t first_face = rows.size() - 6;
  if (index < first_face) return index < rows.first->size();
  const std::size_t axis = (index - first_face) / 2;
  return (index - first_face) % 2 == 0
             ? rows.bounds.high[axis] == bone_box.high[axis] + kContactToleranceMm
             : rows.bounds.low[axis] == bone_box.low[axis] - kContactToleranceMm;
}

}  // namespace

HullCollider::HullCollider(std::span<const ConvexPolytope> bones,
                           const ConvexPolytope& tool,
                           LpObjective objective)
    : tool_vertices_(tool.vertices), tool_planes_(tool.planes), objective_(objective) {
  if (tool.planes.size() < 4 || tool.planes.size() > kMaxToolFacets) {
    throw InvalidInput("collision: the instrument's hull has " +
                       std::to_string(tool.planes.size()) + " facets; 4 to " +
                       std::to_string(kMaxToolFacets) + " are possible");
  }
  for (const ConvexPolytope& bone : bones) {
    if (bone.planes.size() < 4) throw InvalidInput("collision: a bone's hull has no planes");
    bones_.push_back({RowArrays(bone.planes), bounds_of(bone.vertices), {}});
  }
}

void HullCollider::forget() noexcept {
  for (BoneState& bone : bones_) bone.memory = {};
}

HullContact HullCollider::query(std::size_t bone,
                                const Pose<frame::Bone, frame::Tool>& bone_from_tool) noexcept {
  BoneState& state = bones_[bone];
  HullContact contact;
  ++counts_.queries;
  Aabb tool_box;
  for (const Vec3& v : tool_vertices_) {
    tool_box.include(bone_from_tool.rotation * v + bone_from_tool.translation);
  }
  if (!is_finite_pose(bone_from_tool)) {
    ++counts_.not_finite;
    return contact;
  }
  if (!state.box.overlaps(tool_box.grown(kContactToleranceMm))) {
    contact.status = LpStatus::Infeasible;
    contact.decided_by_boxes = true;
    contact.separating_normal = {gap_direction(state.box, tool_box)};
    ++counts_.decided_by_boxes;
    return contact;
  }

  for (std::size_t i = 0; i < tool_planes_.size(); ++i) {
    const Vec3 normal = bone_from_tool.rotation * tool_planes_[i].normal;
    moved_planes_[i] = {normal, tool_planes_[i].offset + dot(normal, bone_from_tool.translation)};
  }
  const LpRows rows{
      &state.rows, {moved_planes_.data(), tool_planes_.size()}, overlap_of(state.box, tool_box)};
  const LpAnswer answer = solve_collision_lp(rows, objective_, state.memory);
  contact.status = answer.status;
  contact.pivots = answer.pivots;
  contact.common_point = {answer.point};
  contact.decided_by_memory = answer.from_memory;
  if (answer.status == LpStatus::Infeasible) {
    // Bone rows and tool rows weigh each other out.
    Vec3 from_bone;
    for (std::size_t i = 0; i < 4; ++i) {
      if (belongs_to_bone(rows, answer.rows[i], state.box)) {
        from_bone += rows.row(answer.rows[i]).normal * answer.weights[i];
      }
    }
    contact.separating_normal = {normalized_or(from_bone, gap_direction(state.box, tool_box))};
  }
  counts_.pivots += static_cast<std::uint64_t>(answer.pivots);
  counts_.restarts += static_cast<std::uint64_t>(answer.restarts);
  counts_.decided_by_memory += answer.from_memory ? 1U : 0U;
  counts_.pivot_limits += answer.status == LpStatus::PivotLimit ? 1U : 0U;
  return contact;
}

std::vector<Vec3> wire_corners(const WireShape& shape) {
  if (!(shape.radius_mm > 0 && shape.tip_mm >= 0 && shape.length_mm > shape.tip_mm &&
        shape.sides >= 3)) {
    throw InvalidInput("wire: radius > 0 mm, 0 <= tip < length and at least 3 sides are required");
  }
  const double corner_radius_mm = shape.radius_mm / std::cos(kPi / shape.sides);
  std::vector<Vec3> corners;
  if (shape.tip_mm > 0) corners.push_back({0, 0, 0});
  for (const double z : {shape.tip_mm, shape.length_mm}) {
    for (int i = 0; i < shape.sides; ++i) {
      const double angle = 2 * kPi * i / shape.sides;
      corners.push_back(
          {corner_radius_mm * std::cos(angle), corner_radius_mm * std::sin(angle), z});
    }
  }
  return corners;
}

}  // namespace carpus::collision
