// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a peer is given so that it runs at its best: support points by climbing along the hull's
// edges from where the last climb ended, and the direction that separated the pair last time,
// which is tried before the peer is asked.
#pragma once

#include <cstdint>
#include <span>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"

namespace carpus::bench {

class ClimbingPair {
 public:
  ClimbingPair(const convex::ConvexBody& first, const convex::ConvexBody& second)
      : first_(&first), second_(&second) {}

  void place(const convex::PairPose& pose) noexcept { pose_ = pose; }
  [[nodiscard]] const convex::PairPose& pose() const noexcept { return pose_; }
  void forget() noexcept {
    has_axis_ = false;
    first_at_ = second_at_ = 0;
  }

  /// Farthest vertex of the first along `direction`, in its frame.
  [[nodiscard]] Vec3 first_support(const Vec3& direction) noexcept {
    asked_ = direction;
    first_at_ = climb(*first_, first_at_, direction);
    return first_->vertices()[first_at_];
  }
  /// Farthest vertex of the second along `direction`, all in the first's frame.
  [[nodiscard]] Vec3 second_support(const Vec3& direction) noexcept {
    return pose_.rotation * second_local_support(turned_back(direction)) + pose_.translation;
  }
  /// The same in the second's own frame.
  [[nodiscard]] Vec3 second_local_support(const Vec3& direction) noexcept {
    second_at_ = climb(*second_, second_at_, direction);
    return second_->vertices()[second_at_];
  }
  [[nodiscard]] Vec3 turned_back(const Vec3& d) const noexcept {
    const auto& r = pose_.rotation.rows;
    return r[0] * d.x + r[1] * d.y + r[2] * d.z;
  }
  [[nodiscard]] Vec3 first_centre() const noexcept { return first_->interior_point(); }
  [[nodiscard]] Vec3 second_centre() const noexcept {
    return pose_.rotation * second_->interior_point() + pose_.translation;
  }

  [[nodiscard]] bool last_axis_separates() noexcept {
    if (!has_axis_) return false;
    const Vec3 n = axis_;
    return dot(n, first_support(n)) < dot(n, second_support(-n));
  }
  /// The last direction in which the peer asked for a support point of the first is kept.
  [[nodiscard]] convex::Verdict answered(bool meet) noexcept {
    if (!meet) {
      axis_ = asked_;
      has_axis_ = true;
    }
    return meet ? convex::Verdict::Meet : convex::Verdict::Apart;
  }
  [[nodiscard]] bool has_axis() const noexcept { return has_axis_; }
  [[nodiscard]] const Vec3& axis() const noexcept { return axis_; }

 private:
  static std::uint32_t climb(const convex::ConvexBody& body,
                             std::uint32_t at,
                             const Vec3& direction) noexcept {
    const std::span<const Vec3> vertices = body.vertices();
    double height = dot(vertices[at], direction);
    for (;;) {
      std::uint32_t next = at;
      for (const std::uint32_t n : body.vertex_neighbours(at)) {
        const double here = dot(vertices[n], direction);
        if (here > height) {
          height = here;
          next = n;
        }
      }
      if (next == at) return at;
      at = next;
    }
  }

  const convex::ConvexBody* first_;
  const convex::ConvexBody* second_;
  convex::PairPose pose_;
  Vec3 asked_;
  Vec3 axis_;
  bool has_axis_ = false;
  std::uint32_t first_at_ = 0;
  std::uint32_t second_at_ = 0;
};

/// A side of the pair as peers with C callbacks see it.
struct ClimbingSide {
  ClimbingPair* pair = nullptr;
  bool is_second = false;
  [[nodiscard]] Vec3 support(const Vec3& d) const noexcept {
    return is_second ? pair->second_support(d) : pair->first_support(d);
  }
  [[nodiscard]] Vec3 centre() const noexcept {
    return is_second ? pair->second_centre() : pair->first_centre();
  }
};

}  // namespace carpus::bench
