// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Four rows of the growth program and what follows from them, solved anew for every pose and pivot
// so that no error accumulates.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "convex/relative_pose.hpp"
#include "geometry/vec3.hpp"

namespace carpus::convex {

/// A row of one of the bodies, in that body's frame, about its origin: normal . s <= t.
struct GrowthRow {
  Vec3 normal;
  std::uint32_t face = kNoFace;  ///< of the body's graph; kNoFace: a row implied by all of them
  bool is_second = false;

  static constexpr std::uint32_t kNoFace = 0xFFFFFFFF;
};

/// Minimise t subject to g_i . x - c_i <= t for the four rows, in the first body's frame. With
/// weights w >= 0, sum w = 1 and sum w_i g_i = 0 the least t is - sum w_i c_i, reached where all
/// four are equal.
class GrowthBasis {
 public:
  /// Works on the caller's rows in place: what remains there is the last basis.
  explicit GrowthBasis(std::array<GrowthRow, 4>& rows_of_caller) noexcept : rows(rows_of_caller) {}

  /// Replaces row i; `turned` is its normal in the first's frame.
  void set(std::size_t i,
           const GrowthRow& row,
           const Vec3& turned,
           const RelativePose& pose) noexcept {
    rows[i] = row;
    g_[i] = turned;
    c_[i] = row.is_second ? dot(turned, pose.offset) : 0;
  }
  /// Brings all rows to a new pose.
  void place(const RelativePose& pose) noexcept {
    for (std::size_t i = 0; i < 4; ++i) place(i, pose);
  }

  /// False where the four normals lie in one plane.
  bool solve() noexcept {
    const Vec3 e1 = g_[1] - g_[0];
    const Vec3 e2 = g_[2] - g_[0];
    const Vec3 e3 = g_[3] - g_[0];
    cofactor1_ = cross(e2, e3);
    cofactor2_ = cross(e3, e1);
    cofactor3_ = cross(e1, e2);
    determinant_ = dot(e1, cofactor1_);
    inverse_ = 1 / determinant_;
    const double w1 = -dot(g_[0], cofactor1_) * inverse_;
    const double w2 = -dot(g_[0], cofactor2_) * inverse_;
    const double w3 = -dot(g_[0], cofactor3_) * inverse_;
    weights = {1 - (w1 + w2 + w3), w1, w2, w3};
    t = -(weights[0] * c_[0] + w1 * c_[1] + w2 * c_[2] + w3 * c_[3]);
    return std::abs(inverse_) <= 1e300;  // false for NaN
  }
  [[nodiscard]] Vec3 point() const noexcept {
    return (cofactor1_ * (c_[1] - c_[0]) + cofactor2_ * (c_[2] - c_[0]) +
            cofactor3_ * (c_[3] - c_[0])) *
           inverse_;
  }
  /// Position of the most negative weight.
  [[nodiscard]] std::size_t worst() const noexcept {
    const std::size_t low = weights[1] < weights[0] ? 1 : 0;
    const std::size_t high = weights[3] < weights[2] ? 3 : 2;
    return weights[high] < weights[low] ? high : low;
  }
  /// The direction in which a row must reach to take the place of row i and leave weights >= 0.
  [[nodiscard]] Vec3 beyond(std::size_t i) const noexcept {
    const double sign = determinant_ > 0 ? 1 : -1;
    if (i == 0) return (cofactor1_ + cofactor2_ + cofactor3_) * sign;
    return (i == 1 ? cofactor1_ : (i == 2 ? cofactor2_ : cofactor3_)) * -sign;
  }
  /// Which row leaves for one with normal g (in the first's frame): the smallest weight over its
  /// share in g, so that the weights stay >= 0. Some share is positive: they add up to 1.
  [[nodiscard]] std::size_t leaving(const Vec3& g) const noexcept {
    const Vec3 d = g - g_[0];
    const double s1 = dot(d, cofactor1_) * inverse_;
    const double s2 = dot(d, cofactor2_) * inverse_;
    const double s3 = dot(d, cofactor3_) * inverse_;
    const std::array<double, 4> share{1 - (s1 + s2 + s3), s1, s2, s3};
    std::size_t best = 4;
    double best_ratio = HUGE_VAL;
    for (std::size_t i = 0; i < 4; ++i) {
      const double ratio = std::max(weights[i], 0.0) / share[i];
      if (share[i] > kLeastShare && ratio < best_ratio) {
        best_ratio = ratio;
        best = i;
      }
    }
    return best;
  }

  std::array<GrowthRow, 4>& rows;
  std::array<double, 4> weights{};
  double t = 0;  ///< lower bound of the program's value where all weights are >= 0

 private:
  static constexpr double kLeastShare = 1e-12;

  void place(std::size_t i, const RelativePose& pose) noexcept {
    const GrowthRow& row = rows[i];
    if (row.is_second) {
      g_[i] = pose.rotation * row.normal;
      c_[i] = dot(g_[i], pose.offset);
    } else {
      g_[i] = row.normal;
      c_[i] = 0;
    }
  }

  std::array<Vec3, 4> g_;
  std::array<double, 4> c_{};
  Vec3 cofactor1_;
  Vec3 cofactor2_;
  Vec3 cofactor3_;
  double determinant_ = 0;
  double inverse_ = 0;
};

}  // namespace carpus::convex
