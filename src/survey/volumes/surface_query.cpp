// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A pair of nodes whose volumes are not apart is replaced by two: the larger node's children with
// the other one. Nodes of the second tree are moved once, when they are first met on a path, and
// kept on the stack with it.
#include "survey/volumes/surface_query.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/tolerance.hpp"

namespace carpus::survey {

bool is_usable(const convex::PairPose& pose, double size_mm) noexcept {
  double largest = 0;
  for (const Vec3& row : pose.rotation.rows) {
    if (!is_finite(row)) return false;
    largest = std::max({largest, std::abs(row.x), std::abs(row.y), std::abs(row.z)});
  }
  const Vec3& t = pose.translation;
  const double offset = std::max({std::abs(t.x), std::abs(t.y), std::abs(t.z)});
  return is_finite(t) && largest * size_mm + offset <= kLargestCoordinate;
}

template <typename Volume>
bool SurfaceQuery<Volume>::leaves_meet(const Leaves& leaves,
                                       const convex::PairPose& pose) noexcept {
  ++counts_.triangle_tests;
  const TrianglePoints& t = second_.triangle(leaves.second);
  return triangles_meet(
      first_.triangle(leaves.first),
      {moved_corner(pose, t[0]), moved_corner(pose, t[1]), moved_corner(pose, t[2])});
}

template <typename Volume>
std::optional<typename SurfaceQuery<Volume>::Leaves> SurfaceQuery<Volume>::descend(
    const convex::PairPose& pose,
    const Motion& motion) noexcept {
  Open* const open = open_.data();
  const auto* const first_nodes = first_.nodes().data();
  const auto* const second_nodes = second_.nodes().data();
  std::size_t count = 1;
  open[0] = {0, 0, second_nodes[0].volume.moved(motion)};
  std::uint64_t volume_tests = 0;
  std::optional<Leaves> found;
  while (count > 0 && !found) {
    Open& at = open[count - 1];
    const auto& a = first_nodes[at.first];
    const auto& b = second_nodes[at.second];
    ++volume_tests;
    if (a.volume.is_apart(at.moved, motion)) {
      --count;
    } else if (a.is_leaf && b.is_leaf) {
      const Leaves leaves{a.first, b.first};
      --count;
      if (leaves_meet(leaves, pose)) found = leaves;
    } else if (b.is_leaf || (!a.is_leaf && a.size >= b.size)) {
      at.first = a.first + 1;
      open[count] = {a.first, at.second, at.moved};
      ++count;
    } else {
      const std::uint32_t left = b.first;
      open[count] = {at.first, left, second_nodes[left].volume.moved(motion)};
      at.second = left + 1;
      at.moved = second_nodes[left + 1].volume.moved(motion);
      ++count;
    }
  }
  counts_.volume_tests += volume_tests;
  return found;
}

template <typename Volume>
SurfaceAnswer SurfaceQuery<Volume>::query(const convex::PairPose& first_from_second) noexcept {
  ++counts_.queries;
  SurfaceAnswer answer;
  if (!is_usable(first_from_second, second_.size_mm())) return answer;
  answer.touch = SurfaceTouch::Apart;
  answer.decided_by_roots = first_.nodes().empty() || second_.nodes().empty();
  if (answer.decided_by_roots) return answer;

  if (last_ && leaves_meet(*last_, first_from_second)) {
    ++counts_.decided_by_memory;
    answer.touch = SurfaceTouch::Touch;
    answer.contact = contact_of(*last_);
    return answer;
  }
  last_.reset();
  const Vec3& t = first_from_second.translation;
  const auto& rows = first_from_second.rotation.rows;
  double largest = 1;
  for (const Vec3& row : rows) {
    largest = std::max({largest, std::abs(row.x), std::abs(row.y), std::abs(row.z)});
  }
  const double sizes = first_.size_mm() + largest * second_.size_mm() + std::abs(t.x) +
                       std::abs(t.y) + std::abs(t.z);
  const Motion motion(first_from_second, kVolumeRounding * sizes + kLeastTriangleCoordinate);
  const std::uint64_t tests_before = counts_.volume_tests;
  last_ = descend(first_from_second, motion);
  if (last_) {
    answer.touch = SurfaceTouch::Touch;
    answer.contact = contact_of(*last_);
  } else {
    answer.decided_by_roots = counts_.volume_tests == tests_before + 1;
  }
  return answer;
}

template class SurfaceQuery<AxisBox>;
template class SurfaceQuery<OrientedBox>;
template class SurfaceQuery<KDop<6>>;
template class SurfaceQuery<KDop<14>>;
template class SurfaceQuery<KDop<18>>;
template class SurfaceQuery<KDop<26>>;

}  // namespace carpus::survey
