// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Do two convex bodies meet? By linear programming over the facets of both: the thesis's method
// [yaacoub2008] §5.3, eq. (5.1) to (5.7), with the dual's equality that a free X requires.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/aabb.hpp"
#include "geometry/convex_polytope.hpp"
#include "geometry/tolerance.hpp"

namespace carpus::collision {

/// Most pivots of one query. Trajectories over bones take 1 or 2, cold starts about 12, the worst
/// seen is 26; reaching the limit is counted, and the query answers PivotLimit.
inline constexpr int kMaxLpPivots = 96;

/// One half-space normal . x <= offset with a unit normal: a row of (5.1).
using LpRow = Plane;

/// The facets of a body that does not move in the frame of the program, as four arrays for fast
/// scans.
struct RowArrays {
  std::vector<double> nx;
  std::vector<double> ny;
  std::vector<double> nz;
  std::vector<double> offset;

  explicit RowArrays(std::span<const Plane> planes);
  RowArrays() = default;
  [[nodiscard]] std::uint32_t size() const noexcept {
    return static_cast<std::uint32_t>(offset.size());
  }
};

/// The program's rows, numbered: the first body's, the second body's, then six of `bounds`.
/// `bounds` holds every common point of the bodies (the overlap of their boxes); its rows change no
/// answer and give every query a vertex to start from.
struct LpRows {
  const RowArrays* first = nullptr;
  std::span<const LpRow> second;
  Aabb bounds;

  [[nodiscard]] std::uint32_t size() const noexcept {
    return first->size() + static_cast<std::uint32_t>(second.size()) + 6;
  }
  [[nodiscard]] LpRow row(std::uint32_t index) const noexcept;
};

enum class LpStatus : std::uint8_t {
  PivotLimit,  ///< no answer within kMaxLpPivots
  Feasible,    ///< the bodies have a common point
  Infeasible,  ///< they have none
};

/// What is maximised; the yes/no answer does not depend on it.
enum class LpObjective : std::uint8_t {
  /// The thesis's max (x + y + z). A kept basis may lose dual feasibility when bodies turn, and the
  /// query starts anew.
  Sum,
  /// The sum of the kept rows' normals, so that the last basis is always dual feasible.
  FollowBasis,
};

/// What is kept from query to query of one pair; any content is safe, stale rows cost pivots only.
struct LpMemory {
  std::array<std::uint32_t, 3> basis{};
  std::uint32_t conflict = 0;            ///< fourth row that proves infeasibility with the basis
  LpStatus last = LpStatus::PivotLimit;  ///< PivotLimit: nothing is kept
};

struct LpAnswer {
  LpStatus status = LpStatus::PivotLimit;
  std::int32_t pivots = 0;
  std::int32_t restarts = 0;
  bool from_memory = false;  ///< infeasible by the four rows of the last query alone
  /// Feasible: a common point, to within kContactToleranceMm of every row.
  Vec3 point;
  /// Infeasible: these rows, times these weights >= 0, add up to no normal and a negative offset
  /// (Farkas). The sum of weight * normal over the second body's rows separates the bodies.
  std::array<std::uint32_t, 4> rows{};
  std::array<double, 4> weights{};
};

/// Decides whether some X satisfies all rows, each to within kContactToleranceMm, by the dual
/// simplex method on a basis of three rows, solved afresh from the rows at every pivot so that no
/// error accumulates.
/// Real-time: no allocation, at most kMaxLpPivots pivots of one scan each, only + - * / sqrt.
[[nodiscard]] LpAnswer solve_collision_lp(const LpRows& rows,
                                          LpObjective objective,
                                          LpMemory& memory) noexcept;

}  // namespace carpus::collision
