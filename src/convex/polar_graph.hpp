// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The facets of a convex body as the vertices of its polar polytope, and the greedy walk on their
// graph that finds the facet through which the ray towards a point leaves the body.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "convex/convex_body.hpp"
#include "geometry/vec3.hpp"

namespace carpus::convex {

/// A row p . (v - origin) <= 1 of a body's facet, with its neighbours beside it: 32 bytes, so that
/// a step of the walk touches four pieces of memory and no list. Memory, not arithmetic, is what a
/// walk costs.
struct alignas(32) PolarRow {
  static constexpr std::uint64_t kIdBits = 21;
  static constexpr std::uint64_t kIdMask = (1U << kIdBits) - 1;
  static constexpr std::uint64_t kHasList = 1ULL << 63U;

  double x = 0;
  double y = 0;
  double z = 0;
  /// Three neighbours of 21 bits; with kHasList instead: 32 bits where the list starts, and above
  /// them 24 bits of its length.
  std::uint64_t links = 0;

  [[nodiscard]] double gauge(const Vec3& d) const noexcept { return x * d.x + y * d.y + z * d.z; }
  [[nodiscard]] Vec3 normal() const noexcept { return {x, y, z}; }
};

/// Where a walk ended.
struct PolarTop {
  std::uint32_t face = 0;   ///< number in the graph
  std::uint32_t steps = 0;  ///< faces walked over
  double gauge = 0;         ///< largest p . d: at most 1 inside the body
};

/// Built once per body and shared by its pairs; never changed.
///
/// The largest p . d over all faces is the gauge of d: d / gauge lies on the surface. The p are the
/// vertices of the polar polytope, on which a walk that always goes to the best neighbour ends at
/// the largest, because a linear function has no other local maximum on a convex polytope. That
/// needs rows scaled to p . v <= 1 about an origin strictly inside (the walk sticks on unit
/// normals with a . v - d) and merged faces (the triangles of one face are one vertex of the
/// polar).
class PolarGraph {
 public:
  static constexpr std::uint32_t kMostFaces = PolarRow::kIdMask;

  /// @throws InvalidInput with more than kMostFaces faces.
  explicit PolarGraph(const ConvexBody& body);

  /// False where the body is too thin, small, large or far from its frame's origin for rows in
  /// doubles to mean anything; then nothing else here may be used.
  [[nodiscard]] bool is_usable() const noexcept { return is_usable_; }

  [[nodiscard]] std::uint32_t size() const noexcept {
    return static_cast<std::uint32_t>(rows_.size());
  }
  /// About which rows and points are taken [mm, the body's frame]; the body's interior point.
  [[nodiscard]] const Vec3& origin() const noexcept { return origin_; }
  [[nodiscard]] const PolarRow& row(std::uint32_t face) const noexcept { return rows_[face]; }
  /// The ConvexBody's number of a face of this graph (which orders faces by direction).
  [[nodiscard]] std::uint32_t face_of_body(std::uint32_t face) const noexcept {
    return face_of_body_[face];
  }

  [[nodiscard]] std::uint32_t face_from_body(std::uint32_t face) const noexcept {
    return face_from_body_[face];
  }

  /// The face through which the ray from the origin along `d` leaves. O(1) steps on average: the
  /// table starts a walk about half a step from its end.
  [[nodiscard]] PolarTop top(const Vec3& d) const noexcept { return climb(start_for(d), d); }
  /// The same from a given face.
  [[nodiscard]] PolarTop climb(std::uint32_t start, const Vec3& d) const noexcept;
  /// The same by looking at every face.
  [[nodiscard]] PolarTop scan(const Vec3& d) const noexcept;
  /// A face near the ray's, by direction only.
  [[nodiscard]] std::uint32_t start_for(const Vec3& d) const noexcept;

  /// A ball about the origin inside the body; rounded down [mm].
  [[nodiscard]] double inner_radius_mm() const noexcept { return inner_radius_mm_; }
  /// A ball about the origin that holds the body; rounded up [mm].
  [[nodiscard]] double outer_radius_mm() const noexcept { return outer_radius_mm_; }
  /// Every row p holds p . (v - origin) <= reach() for all v of the body, exactly, as does a sum of
  /// such rows with weights >= 0 that add up to 1, computed in doubles.
  [[nodiscard]] double reach() const noexcept { return reach_; }

  /// An upper bound of the gauge of `d`, proven: rounding included. From the face's row where it
  /// exceeds its neighbours' by more than rounding, else from the vertices of the face. Tight to
  /// about 1e-15 times outer over inner radius if `face` is the one that top(d) gives, and true
  /// whatever it is.
  [[nodiscard]] double gauge_bound(std::uint32_t face, const Vec3& d) const noexcept;
  /// A vertex of the face, by its number in the body.
  [[nodiscard]] std::uint32_t corner_of(std::uint32_t face) const noexcept {
    return triangles_[first_triangle_[face]][0];
  }
  /// The faces about a vertex of the body, counter-clockwise from outside.
  [[nodiscard]] std::span<const std::uint32_t> faces_about(std::uint32_t vertex) const noexcept {
    return {fans_.data() + first_of_fan_[vertex], fans_.data() + first_of_fan_[vertex + 1]};
  }

 private:
  [[nodiscard]] double lead_of(std::uint32_t face, const Vec3& d) const noexcept;
  [[nodiscard]] double bound_by_corners(std::uint32_t face, const Vec3& d) const noexcept;
  void set_rows(const ConvexBody& body, const std::vector<std::uint32_t>& order);
  void set_links(const ConvexBody& body, const std::vector<std::uint32_t>& order);
  void set_triangles(const ConvexBody& body);
  void set_fans(const ConvexBody& body);
  void fill_table();
  [[nodiscard]] std::size_t cell_of(const Vec3& d) const noexcept;

  std::vector<PolarRow> rows_;
  std::vector<std::uint32_t> lists_;
  /// Faces, shifted right by table_shift_: a start need not be exact, and faces of near numbers
  /// are near each other.
  std::vector<std::uint16_t> table_;
  std::uint32_t table_side_ = 16;
  std::uint32_t table_shift_ = 0;
  double table_scale_ = 8;
  Vec3 origin_;
  double inner_radius_mm_ = 0;
  double outer_radius_mm_ = 0;
  double reach_ = 1;
  double gauge_slack_ = 0;
  double row_error_ = 0;  // of a row's gauge of d, per |d.x| + |d.y| + |d.z|
  bool is_usable_ = false;
  std::vector<std::uint32_t> first_of_fan_;  // by vertex, and the end
  std::vector<std::uint32_t> fans_;          // faces of this graph
  // What proofs need, apart from what the walk touches.
  std::vector<std::uint32_t> first_triangle_;            // of each face, and the end
  std::vector<std::array<std::uint32_t, 3>> triangles_;  // vertices of the body
  std::vector<Vec3> spokes_;                             // vertices - origin
  std::vector<std::uint32_t> face_of_body_;
  std::vector<std::uint32_t> face_from_body_;
};

inline std::size_t PolarGraph::cell_of(const Vec3& d) const noexcept {
  const double ax = std::abs(d.x);
  const double ay = std::abs(d.y);
  const double az = std::abs(d.z);
  double major = d.z;
  double u = d.x;
  double v = d.y;
  std::size_t side = 4;
  if (ax >= ay && ax >= az) {
    major = d.x;
    u = d.y;
    v = d.z;
    side = 0;
  } else if (ay >= az) {
    major = d.y;
    u = d.z;
    v = d.x;
    side = 2;
  }
  if (!(std::abs(major) > 1e-280 && std::abs(major) < 1e280)) return 0;  // no direction
  if (major < 0) ++side;
  const double scale = table_scale_ / std::abs(major);
  const double last = 2 * table_scale_ - 1;
  // min and max in this order also make a cell of what is not a number.
  const auto place = [&](double w) {
    return static_cast<std::size_t>(
        static_cast<std::int32_t>(std::max(0.0, std::min(last, w * scale + table_scale_))));
  };
  return (side * table_side_ + place(u)) * table_side_ + place(v);
}

/// By how much the face's gauge exceeds those of its neighbours.
inline double PolarGraph::lead_of(std::uint32_t face, const Vec3& d) const noexcept {
  const std::uint64_t links = rows_[face].links;
  double next = -HUGE_VAL;
  if ((links & PolarRow::kHasList) == 0) {
    for (unsigned i = 0; i < 3; ++i) {
      next = std::max(next, rows_[links >> i * PolarRow::kIdBits & PolarRow::kIdMask].gauge(d));
    }
  } else {
    const auto first = static_cast<std::uint32_t>(links);
    const auto last = first + static_cast<std::uint32_t>(links >> 32U & 0xFFFFFFU);
    for (std::uint32_t i = first; i < last; ++i) next = std::max(next, rows_[lists_[i]].gauge(d));
  }
  return rows_[face].gauge(d) - next;
}

inline double PolarGraph::gauge_bound(std::uint32_t face, const Vec3& d) const noexcept {
  // A vertex of the polar that is certainly above its neighbours is above all.
  const double error = row_error_ * (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
  if (lead_of(face, d) > 2 * error) return rows_[face].gauge(d) + error;
  return bound_by_corners(face, d);
}

inline std::uint32_t PolarGraph::start_for(const Vec3& d) const noexcept {
  return static_cast<std::uint32_t>(table_[cell_of(d)]) << table_shift_;
}

inline PolarTop PolarGraph::climb(std::uint32_t start, const Vec3& d) const noexcept {
  PolarTop best{start, 0, rows_[start].gauge(d)};
  while (true) {
    const std::uint64_t links = rows_[best.face].links;
    const std::uint32_t from = best.face;
    if ((links & PolarRow::kHasList) == 0) {
      const auto i = static_cast<std::uint32_t>(links & PolarRow::kIdMask);
      const auto j = static_cast<std::uint32_t>(links >> PolarRow::kIdBits & PolarRow::kIdMask);
      const auto k = static_cast<std::uint32_t>(links >> 2 * PolarRow::kIdBits & PolarRow::kIdMask);
      const double gi = rows_[i].gauge(d);
      const double gj = rows_[j].gauge(d);
      const double gk = rows_[k].gauge(d);
      const bool is_j = gj > gi;
      const double gij = is_j ? gj : gi;
      const std::uint32_t ij = is_j ? j : i;
      const bool is_k = gk > gij;
      const double gijk = is_k ? gk : gij;
      if (!(gijk > best.gauge)) return best;
      best.gauge = gijk;
      best.face = is_k ? k : ij;
    } else {
      const auto first = static_cast<std::uint32_t>(links);
      const auto last = first + static_cast<std::uint32_t>(links >> 32U & 0xFFFFFFU);
      for (std::uint32_t i = first; i < last; ++i) {
        const double gauge = rows_[lists_[i]].gauge(d);
        if (gauge > best.gauge) {
          best.gauge = gauge;
          best.face = lists_[i];
        }
      }
      if (best.face == from) return best;
    }
    ++best.steps;
  }
}

}  // namespace carpus::convex
