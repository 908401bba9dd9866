// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// IVRI-CD, the thesis's baseline [yaacoub2008] §5.4.1, eq. (5.8) to (5.15): a linear program over
// the *vertices* of two bodies. A point sum(alpha_i v_i) of the first and a point sum(beta_i w_i)
// of the second are drawn together along a fixed line u until what is left of u, phi u, is least.
//
// What the thesis leaves open, and what stands here:
// - u is "the distance between" two points of the bodies, which points is not said: two vertices,
//   the farthest of each body towards the other's mean vertex. If u = 0 they are a common point.
// - epsilon of the test mu phi <= epsilon is "a very small quantity": kContactToleranceMm. So the
//   method is not exact: bodies that are nearer than epsilon along u count as touching.
// - How the program is solved is not said: primal simplex on the five rows of (5.14), from the
//   basic solution phi = 1 that u provides; largest reduced cost, and Bland's rule
//   [bland1977finite] where steps make no progress.
// - "A contains all the elements constituting the objects" (p. 64), the thesis says, while its own
//   program takes hulls; the answer is the same on both, so any set of points is taken here.
// - mu phi is the Chebyshev length of a gap along u: an upper bound of the distance, not the
//   distance.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "convex/pair_query.hpp"
#include "geometry/tolerance.hpp"
#include "geometry/vec3.hpp"

namespace carpus::survey {

/// Most pivots of one query; bones with all their vertices take about 20.
inline constexpr std::int32_t kMaxIvriPivots = 400;

enum class IvriStatus : std::uint8_t {
  PivotLimit,  ///< no answer within kMaxIvriPivots, or a basis became singular
  NotFinite,   ///< the pose holds NaN or infinity
  Apart,
  Meet,
};

struct IvriAnswer {
  IvriStatus status = IvriStatus::PivotLimit;
  std::int32_t pivots = 0;
  double residual_mm = 0;  ///< mu phi at the end
  Vec3 on_first;           ///< sum(alpha_i v_i) [mm], in the first body's frame
  Vec3 on_second;          ///< sum(beta_i w_i), likewise; on_first + phi u
};

struct IvriStatistics {
  std::uint64_t queries = 0;
  std::uint64_t pivots = 0;
  std::uint64_t warm_starts = 0;   ///< began from the points of the last answer
  std::uint64_t bland_pivots = 0;  ///< chosen by Bland's rule
  std::uint64_t pivot_limits = 0;
};

class IvriCd {
 public:
  /// @param first, second  points whose hulls are the bodies [mm], all vertices of a surface or
  ///        those of its hull; not all in one plane.
  /// @throws InvalidInput if there are fewer than four points or one is not finite.
  IvriCd(std::span<const Vec3> first,
         std::span<const Vec3> second,
         double epsilon_mm = kContactToleranceMm);

  /// The second body is { rotation * w + translation }. The last answer's points, carried along by
  /// the new pose, are the new u where that is possible.
  /// Real-time: no allocation, each pivot prices all vertices once; only + - * / and comparisons.
  [[nodiscard]] IvriAnswer query(const convex::PairPose& first_from_second) noexcept;

  void forget() noexcept { has_basis_ = false; }
  [[nodiscard]] const IvriStatistics& statistics() const noexcept { return statistics_; }

 private:
  class Simplex;
  struct Points {  ///< coordinates apart, for pricing
    std::vector<double> x, y, z;
    Vec3 mean;
    explicit Points(std::span<const Vec3> points);
    [[nodiscard]] std::uint32_t size() const noexcept {
      return static_cast<std::uint32_t>(x.size());
    }
    [[nodiscard]] Vec3 operator[](std::uint32_t i) const noexcept { return {x[i], y[i], z[i]}; }
  };

  Points first_;
  Points second_;
  double epsilon_mm_;
  /// The last answer's columns (first body's, then second's, then phi) and their values.
  std::array<std::uint32_t, 5> basis_{};
  std::array<double, 5> values_{};
  bool has_basis_ = false;
  IvriStatistics statistics_;
};

/// `ivri` in the list of methods: IvriCd on the vertices of the hulls.
[[nodiscard]] std::unique_ptr<convex::PairQuery> make_ivri_query(const convex::ConvexBody& first,
                                                                 const convex::ConvexBody& second);

}  // namespace carpus::survey
