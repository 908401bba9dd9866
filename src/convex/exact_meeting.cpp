// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. The vertices of both bodies extreme along the direction v give the difference d = b - a with
//    the least v . d. If that is not less than on the active set, v is nearest: v . d > 0 for all.
// 2. Otherwise d joins the set, and the nearest point of its convex hull to the origin is found by
//    trying every subset that holds d: weights > 0, and no other corner nearer along v.
// 3. The subset replaces the set. The nearest point is the origin: the bodies meet.
// Every v is a polynomial of degree at most 3 in the differences, computed anew: nothing grows.
#include "convex/exact_meeting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "geometry/exact_number.hpp"
#include "geometry/tolerance.hpp"

namespace carpus::convex {
namespace {

bool is_in_range(const PlacedBody& placed) noexcept {
  for (const Vec3& v : {placed.rotation.rows[0], placed.rotation.rows[1], placed.rotation.rows[2],
                        placed.translation}) {
    for (const double c : {v.x, v.y, v.z}) {
      if (!(std::abs(c) <= kLargestCoordinate)) return false;
    }
  }
  return true;
}

/// rotation transposed times v.
ExactVec3 into_body(const Mat3& rotation, const ExactVec3& v) noexcept {
  if (rotation == Mat3::identity()) return v;
  const auto component = [&](std::size_t i) {
    return v.x * ExactNumber(rotation.rows[0][i]) + v.y * ExactNumber(rotation.rows[1][i]) +
           v.z * ExactNumber(rotation.rows[2][i]);
  };
  return {component(0), component(1), component(2)};
}

ExactVec3 placed_vertex(const PlacedBody& placed, std::uint32_t vertex) noexcept {
  const ExactVec3 v(placed.body->vertices()[vertex]);
  const auto component = [&](std::size_t i) {
    return dot(ExactVec3(placed.rotation.rows[i]), v) + ExactNumber(placed.translation[i]);
  };
  return {component(0), component(1), component(2)};
}

/// Climbs to the vertex that is extreme along a direction.
class Climb {
 public:
  Climb(const ConvexBody& body, const ExactVec3& direction) noexcept
      : body_(body), direction_(direction), rounded_(rounded_direction(direction)) {}

  [[nodiscard]] std::uint32_t from(std::uint32_t vertex) const noexcept {
    vertex = roughly_from(vertex);
    // A vertex with no better neighbour along an edge is extreme: its edges span the body.
    const auto better = [&](std::uint32_t neighbour) {
      return sign_of_step(vertex, neighbour) > 0;
    };
    while (true) {
      const std::span<const std::uint32_t> around = body_.vertex_neighbours(vertex);
      const auto found = std::find_if(around.begin(), around.end(), better);
      if (found == around.end()) return vertex;
      vertex = *found;
    }
  }

 private:
  [[nodiscard]] std::uint32_t roughly_from(std::uint32_t vertex) const noexcept {
    const std::span<const Vec3> vertices = body_.vertices();
    double best = dot(rounded_, vertices[vertex]);
    while (true) {
      const std::uint32_t from = vertex;
      for (const std::uint32_t n : body_.vertex_neighbours(from)) {
        const double value = dot(rounded_, vertices[n]);
        if (value > best) {
          best = value;
          vertex = n;
        }
      }
      if (vertex == from) return vertex;
    }
  }

  /// Sign of direction . (to - from).
  [[nodiscard]] int sign_of_step(std::uint32_t from, std::uint32_t to) const noexcept {
    const Vec3& a = body_.vertices()[from];
    const Vec3& b = body_.vertices()[to];
    const Vec3 step = b - a;
    const double px = rounded_.x * step.x;
    const double py = rounded_.y * step.y;
    const double pz = rounded_.z * step.z;
    // Components 2 u, differences u, products u, sums 2 u of the magnitudes; rounded up.
    const double bound =
        8 * kRoundoff * (std::abs(px) + std::abs(py) + std::abs(pz)) + kUnderflowBound;
    const double value = px + py + pz;
    if (value > bound) return 1;
    if (value < -bound) return -1;
    return dot(direction_, ExactVec3(b) - ExactVec3(a)).sign();
  }

  const ConvexBody& body_;
  const ExactVec3& direction_;
  Vec3 rounded_;
};

class ActiveSet {
 public:
  ActiveSet(const PlacedBody& first, const PlacedBody& second, const ExactHint& hint) noexcept
      : first_(first),
        second_(second),
        a_(hint.first_vertex),
        b_(hint.second_vertex),
        seeds_(hint.seeds),
        seed_count_(hint.seed_count) {}

  ExactAnswer run(const Vec3& direction) noexcept {
    if (take_seeds()) {
      if (is_origin_reached_from(0)) return answer(Verdict::Meet);
    } else {
      v_ = ExactVec3(direction);
      if (v_.is_zero()) v_ = ExactVec3(Vec3{1, 0, 0});
    }
    ExactVec3 d = extreme_difference();
    // Without corners any positive value separates; with them v . corner is positive.
    if (count_ == 0 ? dot(v_, d).sign() > 0 : dot(v_, d - corners_[0]).sign() >= 0) {
      return answer(Verdict::Apart);
    }
    while (true) {
      corners_[count_++] = d;
      if (is_origin_reached_from(count_ - 1)) return answer(Verdict::Meet);
      if (v_.x.is_overflown() || v_.y.is_overflown() || v_.z.is_overflown()) {
        return answer(Verdict::Unknown);
      }
      d = extreme_difference();
      const int nearer = dot(v_, d - corners_[0]).sign();
      if (nearer >= 0) return answer(Verdict::Apart);
    }
  }

 private:
  [[nodiscard]] ExactAnswer answer(Verdict verdict) const noexcept { return {verdict, rounds_}; }

  /// b - a with the least v . (b - a).
  ExactVec3 extreme_difference() noexcept {
    ++rounds_;
    const ExactVec3 along_first = into_body(first_.rotation, v_);
    const ExactVec3 along_second = -into_body(second_.rotation, v_);
    a_ = Climb(*first_.body, along_first).from(a_);
    b_ = Climb(*second_.body, along_second).from(b_);
    return placed_vertex(second_, b_) - placed_vertex(first_, a_);
  }

  /// The seeds become the set; false if there are none.
  bool take_seeds() noexcept {
    for (std::uint32_t i = 0; i < seed_count_; ++i) {
      corners_[count_++] =
          placed_vertex(second_, seeds_[i][1]) - placed_vertex(first_, seeds_[i][0]);
    }
    return count_ > 0;
  }

  /// Reduces the set to the corners about its nearest point; of these the last is at `least` or
  /// after it. Only one subset qualifies: seeds begin with triangles because they should be about
  /// one, a new corner with itself because that is the least work.
  bool is_origin_reached_from(std::size_t least) noexcept {
    const bool is_found = least == 0
                              ? find_triangle(0) || find_edge(0) || find_corner(0)
                              : find_corner(least) || find_edge(least) || find_triangle(least);
    return !is_found || v_.is_zero();  // not found: a tetrahedron around the origin
  }

  bool find_corner(std::size_t least) noexcept {
    for (std::size_t k = least; k < count_; ++k) {
      if (try_corner(k)) return true;
    }
    return false;
  }

  bool find_edge(std::size_t least) noexcept {
    for (std::size_t j = std::max<std::size_t>(least, 1); j < count_; ++j) {
      for (std::size_t i = 0; i < j; ++i) {
        if (try_edge(i, j)) return true;
      }
    }
    return false;
  }

  bool find_triangle(std::size_t least) noexcept {
    for (std::size_t k = std::max<std::size_t>(least, 2); k < count_; ++k) {
      for (std::size_t i = 0; i < k; ++i) {
        for (std::size_t j = i + 1; j < k; ++j) {
          if (try_triangle(i, j, k)) return true;
        }
      }
    }
    return false;
  }

  /// v becomes the set's nearest point if no other corner is nearer along it.
  bool accept(const ExactVec3& v, std::initializer_list<std::size_t> kept) noexcept {
    for (std::size_t i = 0; i < count_; ++i) {
      if (std::find(kept.begin(), kept.end(), i) != kept.end()) continue;
      if (dot(v, corners_[i] - corners_[*kept.begin()]).sign() < 0) return false;
    }
    v_ = v;
    std::size_t place = 0;
    for (const std::size_t i : kept) corners_[place++] = corners_[i];  // ascending
    count_ = place;
    return true;
  }

  bool try_corner(std::size_t i) noexcept {
    const ExactVec3 v = corners_[i];
    return accept(v, {i});
  }

  bool try_edge(std::size_t i, std::size_t j) noexcept {
    const ExactVec3& a = corners_[i];
    const ExactVec3& b = corners_[j];
    const ExactVec3 edge = b - a;
    const ExactNumber weight_a = dot(b, edge);
    const ExactNumber weight_b = -dot(a, edge);
    if (weight_a.sign() <= 0 || weight_b.sign() <= 0) return false;
    return accept(a * weight_a + b * weight_b, {i, j});
  }

  bool try_triangle(std::size_t i, std::size_t j, std::size_t k) noexcept {
    const ExactVec3& a = corners_[i];
    const ExactVec3& b = corners_[j];
    const ExactVec3& c = corners_[k];
    const ExactVec3 normal = cross(b - a, c - a);
    if (normal.is_zero() || dot(normal, cross(b, c)).sign() <= 0 ||
        dot(normal, cross(c, a)).sign() <= 0 || dot(normal, cross(a, b)).sign() <= 0) {
      return false;
    }
    const int height = dot(normal, a).sign();
    if (height == 0) {
      v_ = ExactVec3(Vec3{});
      return true;
    }
    return accept(height > 0 ? normal : -normal, {i, j, k});
  }

  const PlacedBody& first_;
  const PlacedBody& second_;
  std::uint32_t a_;
  std::uint32_t b_;
  const std::array<std::array<std::uint32_t, 2>, 4>& seeds_;
  std::uint32_t seed_count_;
  std::uint32_t rounds_ = 0;
  std::size_t count_ = 0;
  std::array<ExactVec3, 4> corners_;
  ExactVec3 v_;
};

}  // namespace

ExactAnswer exactly_meet(const PlacedBody& first,
                         const PlacedBody& second,
                         const ExactHint& hint) noexcept {
  if (!is_in_range(first) || !is_in_range(second)) return {};
  const bool is_direction = is_finite(hint.direction) &&
                            std::abs(hint.direction.x) <= kLargestCoordinate &&
                            std::abs(hint.direction.y) <= kLargestCoordinate &&
                            std::abs(hint.direction.z) <= kLargestCoordinate;
  return ActiveSet(first, second, hint).run(is_direction ? hint.direction : Vec3{1, 0, 0});
}

}  // namespace carpus::convex
