// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Do two surfaces of triangles touch? Descends two trees of bounding volumes together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "convex/pair_query.hpp"
#include "survey/volumes/volume_tree.hpp"

namespace carpus::survey {

/// Two triangles that have a point in common.
struct TriangleContact {
  std::uint32_t first_facet = 0;
  std::uint32_t second_facet = 0;
  bool operator==(const TriangleContact&) const = default;
};

enum class SurfaceTouch : std::uint8_t {
  Unknown,  ///< the pose is not finite, or moves corners beyond kLargestCoordinate
  Apart,
  Touch,
};

struct SurfaceAnswer {
  SurfaceTouch touch = SurfaceTouch::Unknown;
  /// With Touch: the pair of the last query if it touches still, else the first one found.
  TriangleContact contact;
  bool decided_by_roots = false;  ///< the outermost volumes are apart
};

/// Sums over all queries since the start.
struct SurfaceQueryCounts {
  std::uint64_t queries = 0;
  std::uint64_t decided_by_memory = 0;
  std::uint64_t volume_tests = 0;
  std::uint64_t triangle_tests = 0;
};

/// A corner v of the second surface in the first one's frame: rotation * v + translation, rounded,
/// within 4 u (|v|_1 max |rotation_ij| + |translation_i|) on each axis, u = kRoundoff: 1e-13 mm for
/// a wrist. Corners that are the same stay the same, so that a closed surface stays closed.
[[nodiscard]] inline Vec3 moved_corner(const convex::PairPose& pose, const Vec3& v) noexcept {
  return without_tiny_coordinates(pose.rotation * v + pose.translation);
}

/// The pose is finite, and moves what lies within size_mm to at most kLargestCoordinate.
[[nodiscard]] bool is_usable(const convex::PairPose& pose, double size_mm) noexcept;

/// Surfaces are closed sets: touching is contact. Surfaces, not bodies: of one within another the
/// answer is Apart. Exact for corners as moved_corner() rounds them.
/// Real-time: noexcept, no allocation; at worst all pairs of nodes are visited, O(n m).
template <typename Volume>
class SurfaceQuery {
 public:
  using Tree = VolumeTree<Volume>;

  /// Both must outlive the query.
  SurfaceQuery(const Tree& first, const Tree& second)
      : first_(first), second_(second), open_(first.depth() + second.depth() + 2) {}

  [[nodiscard]] SurfaceAnswer query(const convex::PairPose& first_from_second) noexcept;
  void forget() noexcept { last_.reset(); }
  [[nodiscard]] const SurfaceQueryCounts& counts() const noexcept { return counts_; }

 private:
  struct Leaves {
    std::uint32_t first = 0;
    std::uint32_t second = 0;
  };
  using Motion = typename Volume::Motion;
  /// Two nodes still to be looked at, the second one moved.
  struct Open {
    std::uint32_t first = 0;
    std::uint32_t second = 0;
    typename Volume::Moved moved;
  };

  [[nodiscard]] bool leaves_meet(const Leaves& leaves, const convex::PairPose& pose) noexcept;
  [[nodiscard]] std::optional<Leaves> descend(const convex::PairPose& pose,
                                              const Motion& motion) noexcept;
  [[nodiscard]] TriangleContact contact_of(const Leaves& leaves) const noexcept {
    return {first_.facet(leaves.first), second_.facet(leaves.second)};
  }

  const Tree& first_;
  const Tree& second_;
  /// Each step takes one pair and leaves two, one level further down in one of the trees.
  std::vector<Open> open_;
  std::optional<Leaves> last_;
  SurfaceQueryCounts counts_;
};

extern template class SurfaceQuery<AxisBox>;
extern template class SurfaceQuery<OrientedBox>;
extern template class SurfaceQuery<KDop<6>>;
extern template class SurfaceQuery<KDop<14>>;
extern template class SurfaceQuery<KDop<18>>;
extern template class SurfaceQuery<KDop<26>>;

}  // namespace carpus::survey
