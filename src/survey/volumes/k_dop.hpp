// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Discrete orientation polytopes for VolumeTree: intersections of slabs across fixed directions
// with components -1, 0 and 1. Source: [klosowski1998efficient].
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "convex/pair_query.hpp"
#include "geometry/vec3.hpp"
#include "survey/volumes/triangle_contact.hpp"

namespace carpus::survey {

/// The directions of the k-DOPs of §3: 6 to faces of a cube, 14 with its corners too, 18 with its
/// edges, 26 with both. Of i and i + K / 2 one is minus the other. Not of unit length.
template <std::size_t K>
class DopDirections {
  static_assert(K == 6 || K == 14 || K == 18 || K == 26);

 public:
  static constexpr bool kHasEdges = K == 18 || K == 26;
  static constexpr bool kHasCorners = K == 14 || K == 26;

  constexpr DopDirections() {
    std::size_t count = 0;
    for (int code = 14; code < 27; ++code) {  // the half of them that comes after (0, 0, 0)
      const std::array<int, 3> v{code / 9 - 1, code / 3 % 3 - 1, code % 3 - 1};
      const int ends = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
      if ((ends == 2 && !kHasEdges) || (ends == 3 && !kHasCorners)) continue;
      vectors_[count] = v;
      numbers_[static_cast<std::size_t>(code)] = static_cast<std::uint8_t>(count);
      numbers_[static_cast<std::size_t>(26 - code)] = static_cast<std::uint8_t>(count + K / 2);
      ++count;
    }
  }
  /// @param i  below K / 2.
  [[nodiscard]] constexpr Vec3 vector(std::size_t i) const noexcept {
    return {static_cast<double>(vectors_[i][0]), static_cast<double>(vectors_[i][1]),
            static_cast<double>(vectors_[i][2])};
  }
  /// Of the direction with components code / 9 - 1, code / 3 % 3 - 1, code % 3 - 1.
  [[nodiscard]] constexpr std::uint8_t number(std::ptrdiff_t code) const noexcept {
    return numbers_[static_cast<std::size_t>(code)];
  }

 private:
  std::array<std::array<int, 3>, K / 2> vectors_{};
  std::array<std::uint8_t, 27> numbers_{};
};

/// A vector as a sum of three of the directions with weights that are not negative, so that the
/// reach along it is at most the weighted sum of theirs.
struct DopSum {
  std::array<std::uint8_t, 3> directions{};
  std::array<double, 3> weights{};
};

template <std::size_t K>
[[nodiscard]] DopSum dop_sum(const Vec3& d) noexcept;

/// Turned DOPs are fitted anew (§4) from three faces each: a turned direction is a sum of three of
/// the fixed ones, the same three for all nodes, found once a query. The paper projects each
/// node's corners, up to 2 k - 4 of them, onto k / 2 directions; both enclose the turned volume,
/// and for k = 6 they are the same.
template <std::size_t K>
struct KDop {
  static constexpr DopDirections<K> kDirections{};
  static constexpr std::size_t kSlabs = K / 2;

  std::array<double, K> reach{};  ///< largest direction . p

  struct Motion {
    std::array<DopSum, kSlabs> sums;
    std::array<double, kSlabs> offsets{};
    double slack_mm = 0;

    Motion(const convex::PairPose& first_from_second, double slack) : slack_mm(slack) {
      const auto& rows = first_from_second.rotation.rows;
      for (std::size_t i = 0; i < kSlabs; ++i) {
        const Vec3 e = kDirections.vector(i);
        sums[i] = dop_sum<K>(rows[0] * e.x + rows[1] * e.y + rows[2] * e.z);
        offsets[i] = dot(e, first_from_second.translation);
      }
    }
  };
  using Moved = KDop;

  [[nodiscard]] static KDop around(std::span<const TrianglePoints> triangles) {
    KDop dop;
    dop.reach.fill(-std::numeric_limits<double>::infinity());
    for (const TrianglePoints& t : triangles) {
      for (const Vec3& v : t) {
        for (std::size_t i = 0; i < kSlabs; ++i) {
          const double s = dot(kDirections.vector(i), v);
          dop.reach[i] = s > dop.reach[i] ? s : dop.reach[i];
          dop.reach[i + kSlabs] = -s > dop.reach[i + kSlabs] ? -s : dop.reach[i + kSlabs];
        }
      }
    }
    return dop;
  }
  [[nodiscard]] double size() const noexcept {
    double sum = 0;
    for (std::size_t i = 0; i < K; ++i) sum += reach[i];
    return sum;
  }

  [[nodiscard]] Moved moved(const Motion& motion) const noexcept {
    KDop dop;
    for (std::size_t i = 0; i < kSlabs; ++i) {
      const auto& [at, weights] = motion.sums[i];
      const auto opposite = [](std::size_t n) { return n < kSlabs ? n + kSlabs : n - kSlabs; };
      dop.reach[i] = weights[0] * reach[at[0]] + weights[1] * reach[at[1]] +
                     weights[2] * reach[at[2]] + (motion.offsets[i] + motion.slack_mm);
      dop.reach[i + kSlabs] =
          weights[0] * reach[opposite(at[0])] + weights[1] * reach[opposite(at[1])] +
          weights[2] * reach[opposite(at[2])] - (motion.offsets[i] - motion.slack_mm);
    }
    return dop;
  }
  [[nodiscard]] bool is_apart(const Moved& other, const Motion& /*motion*/) const noexcept {
    for (std::size_t i = 0; i < kSlabs; ++i) {
      if (reach[i] + other.reach[i + kSlabs] < 0 || reach[i + kSlabs] + other.reach[i] < 0) {
        return true;
      }
    }
    return false;
  }
};

template <std::size_t K>
DopSum dop_sum(const Vec3& d) noexcept {
  double a = std::abs(d.x);
  double b = std::abs(d.y);
  double c = std::abs(d.z);
  std::ptrdiff_t of_a = d.x < 0 ? -9 : 9;
  std::ptrdiff_t of_b = d.y < 0 ? -3 : 3;
  std::ptrdiff_t of_c = d.z < 0 ? -1 : 1;
  const auto sort_two = [](double& x, double& y, std::ptrdiff_t& of_x, std::ptrdiff_t& of_y) {
    if (x >= y) return;
    std::swap(x, y);
    std::swap(of_x, of_y);
  };
  sort_two(a, b, of_a, of_b);
  sort_two(b, c, of_b, of_c);
  sort_two(a, b, of_a, of_b);
  const auto number = [](std::ptrdiff_t code) { return KDop<K>::kDirections.number(13 + code); };
  const std::uint8_t face = number(of_a);
  if constexpr (K == 6) {
    return {{face, number(of_b), number(of_c)}, {a, b, c}};
  } else if constexpr (K == 14) {
    return {{face, number(of_a + of_b + of_c), number(of_a + of_b - of_c)},
            {a - b, (b + c) / 2, (b - c) / 2}};
  } else if constexpr (K == 18) {
    const std::uint8_t ab = number(of_a + of_b);
    const std::uint8_t ac = number(of_a + of_c);
    if (a >= b + c) return {{face, ab, ac}, {a - b - c, b, c}};
    return {{ab, ac, number(of_b + of_c)}, {(a + b - c) / 2, (a + c - b) / 2, (b + c - a) / 2}};
  } else {
    return {{face, number(of_a + of_b), number(of_a + of_b + of_c)}, {a - b, b - c, c}};
  }
}

}  // namespace carpus::survey
