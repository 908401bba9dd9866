// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Do two convex bodies meet, exactly, on doubles as given? The bodies are the hulls of the vertices
// v of the first and { rotation * w + translation } of the second, evaluated without rounding;
// touching is meeting.
//
// They meet iff the origin lies in D = { v - w' }. From a point c of D a ray runs through the
// origin; the triangle of points of D through which it passes is pushed outward to the support
// point along its normal until none lies beyond: its plane then bounds D, and the side of the
// origin decides. Floating point guesses that triangle, and signs that exceed a bound of their
// error settle most cases; all others are walked again in integers.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/rng.hpp"
#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"

namespace carpus::oracles {

using Integer = boost::multiprecision::cpp_int;
using IntegerVector = std::array<Integer, 3>;

/// value = mantissa * 2^exponent, exactly; mantissa odd or zero.
struct Dyadic {
  std::int64_t mantissa = 0;
  int exponent = 0;
  explicit Dyadic(double value) {
    if (value == 0) return;
    constexpr int kMantissaBits = std::numeric_limits<double>::digits;
    mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), kMantissaBits));
    exponent -= kMantissaBits;
    while (mantissa % 2 == 0) {
      mantissa /= 2;
      ++exponent;
    }
  }
  /// value * 2^scale, which the scale must make an integer.
  [[nodiscard]] Integer scaled(int scale) const {
    return mantissa == 0 ? Integer(0)
                         : Integer(Integer(mantissa) << static_cast<unsigned>(exponent + scale));
  }
};

inline int scale_of(std::span<const Vec3> vectors) {
  int lowest = 0;
  for (const Vec3& v : vectors) {
    for (std::size_t i = 0; i < 3; ++i) lowest = std::min(lowest, Dyadic(v[i]).exponent);
  }
  return -lowest;
}

inline IntegerVector minus(const IntegerVector& a, const IntegerVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline IntegerVector cross_of(const IntegerVector& a, const IntegerVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Integer dot_of(const IntegerVector& a, const IntegerVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vec3 minus(const Vec3& a, const Vec3& b) { return a - b; }
inline Vec3 cross_of(const Vec3& a, const Vec3& b) { return cross(a, b); }
inline double dot_of(const Vec3& a, const Vec3& b) { return dot(a, b); }

inline double to_double(const Integer& value) { return value.convert_to<double>(); }

/// The direction of an integer vector, entries at most 1, each within 2 units in the last place of
/// the largest.
inline Vec3 direction_of(const IntegerVector& n) {
  std::size_t bits = 0;
  for (const Integer& x : n) {
    if (x != 0) bits = std::max<std::size_t>(bits, msb(abs(x)));
  }
  const std::size_t drop = bits > 62 ? bits - 62 : 0;
  const auto part = [&](const Integer& x) {
    const Integer top = abs(x) >> drop;
    return (x < 0 ? -1 : 1) * to_double(top) * 0x1p-63;
  };
  return {part(n[0]), part(n[1]), part(n[2])};
}

/// One point of D: a vertex of each body.
struct Corner {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  bool operator==(const Corner&) const = default;
};

class ExactMeet {
 public:
  ExactMeet(std::span<const Vec3> first, std::span<const Vec3> second)
      : first_(first.begin(), first.end()),
        second_(second.begin(), second.end()),
        first_scale_(scale_of(first)),
        second_scale_(scale_of(second)) {
    pick_inner_points();
  }

  struct Answer {
    bool meet = false;
    bool needed_integers = false;  ///< nearer to touching than rounding can tell
  };

  [[nodiscard]] Answer query(const Mat3& rotation, const Vec3& translation) {
    place(rotation, translation);
    const Portal guess = walk_in_doubles();
    if (const std::optional<bool> sure = certified(guess)) return {*sure, false};
    return {walk_in_integers(guess), true};
  }

  /// Where the bodies all but touch: the second is moved along the line through c and the origin,
  /// to rounding; `normal` is that of their common plane, unit, from the first to the second.
  struct Touching {
    Vec3 translation;
    Vec3 normal;
  };
  [[nodiscard]] Touching touching(const Mat3& rotation, const Vec3& translation) {
    place(rotation, translation);
    const Portal p = walk_in_doubles();
    const Vec3 n = normal_of(p.points);
    const double to_plane = dot(n, p.points[0]);
    const double along = dot(n, -centre_);
    const Vec3 shift = along == 0 ? Vec3{} : (-centre_) * (to_plane / along);
    return {translation + shift, normalized_or(n, {1, 0, 0})};
  }

 private:
  static constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  static constexpr int kWeightBits = 12;
  static constexpr int kMostSteps = 300;

  struct Portal {
    std::array<Corner, 3> corners;
    std::array<Vec3, 3> points;  ///< of D, rounded
    bool is_start = true;        ///< still a face of the tetrahedron that the walk starts from
    bool ended = false;
  };

  /// Four vertices of the first far apart from each other, and one point of the second.
  void pick_inner_points() {
    const auto farthest = [&](auto&& measure) {
      std::uint32_t best = 0;
      double most = -1;
      for (std::uint32_t i = 0; i < first_.size(); ++i) {
        const double value = measure(first_[i]);
        if (value > most) {
          most = value;
          best = i;
        }
      }
      return best;
    };
    anchors_[0] = farthest([&](const Vec3& v) { return distance(v, first_[0]); });
    const Vec3 a = first_[anchors_[0]];
    anchors_[1] = farthest([&](const Vec3& v) { return distance(v, a); });
    const Vec3 ab = first_[anchors_[1]] - a;
    anchors_[2] = farthest([&](const Vec3& v) { return length(cross(ab, v - a)); });
    const Vec3 n = cross(ab, first_[anchors_[2]] - a);
    anchors_[3] = farthest([&](const Vec3& v) { return std::abs(dot(n, v - a)); });
    for (std::size_t i = 0; i < 4; ++i) {
      second_anchors_[i] = static_cast<std::uint32_t>(random_.below(second_.size()));
    }
    new_weights();
  }

  /// c is a weighted mean; random weights keep the ray off edges.
  void new_weights() {
    constexpr int kSum = 1 << kWeightBits;
    for (auto* weights : {&weights_, &second_weights_}) {
      int rest = kSum;
      for (std::size_t i = 0; i < 3; ++i) {
        (*weights)[i] = kSum / 6 + static_cast<int>(random_.below(kSum / 8));
        rest -= (*weights)[i];
      }
      (*weights)[3] = rest;
    }
  }

  void place(const Mat3& rotation, const Vec3& translation) {
    rotation_ = rotation;
    translation_ = translation;
    placed_.resize(second_.size());
    magnitude_ = 0;
    for (const Vec3& v : first_)
      magnitude_ = std::max({magnitude_, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    double second = 0;
    for (const Vec3& w : second_)
      second = std::max({second, std::abs(w.x), std::abs(w.y), std::abs(w.z)});
    double row = 0;
    double shift = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& r = rotation.rows[i];
      row = std::max(row, std::abs(r.x) + std::abs(r.y) + std::abs(r.z));
      shift = std::max(shift, std::abs(translation[i]));
    }
    magnitude_ += row * second + shift;
    for (std::size_t i = 0; i < second_.size(); ++i)
      placed_[i] = rotation * second_[i] + translation;
    set_centre();
    has_integers_ = false;
  }

  void set_centre() {
    constexpr double kUnit = 1.0 / (1 << kWeightBits);
    Vec3 inner;
    inner_second_ = {};
    for (std::size_t i = 0; i < 4; ++i) {
      inner += first_[anchors_[i]] * (weights_[i] * kUnit);
      inner_second_ += placed_[second_anchors_[i]] * (second_weights_[i] * kUnit);
    }
    centre_ = inner - inner_second_;
  }

  static Vec3 normal_of(const std::array<Vec3, 3>& p) { return cross(p[1] - p[0], p[2] - p[0]); }

  /// The faces of a tetrahedron with corners 0..3, either all seen from outside or all from inside.
  static constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{
      {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}}};

  /// The face by which the ray leaves the tetrahedron around c; e: its corners from c.
  template <typename Vector>
  static std::optional<std::array<std::size_t, 3>> starting_face(const std::array<Vector, 4>& e,
                                                                 const Vector& ray) {
    for (std::array<std::size_t, 3> f : kFaces) {
      const auto volume = dot_of(e[f[0]], cross_of(e[f[1]], e[f[2]]));
      if (volume == 0) return std::nullopt;
      if (volume < 0) std::swap(f[1], f[2]);
      if (contains_ray<Vector>({e[f[0]], e[f[1]], e[f[2]]}, ray)) return f;
    }
    return std::nullopt;
  }

  template <typename Vector>
  static bool contains_ray(const std::array<Vector, 3>& e, const Vector& ray) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(dot_of(ray, cross_of(e[i], e[(i + 1) % 3])) > 0)) return false;
    }
    return true;
  }

  /// The corner of the triangle that a new point beyond it replaces: the ray passes through the
  /// cone of the new point and the other two. 3: the ray meets an edge.
  template <typename Vector>
  static std::size_t replaced(const std::array<Vector, 3>& e,
                              const Vector& fresh,
                              const Vector& ray) {
    const Vector side = cross_of(ray, fresh);
    std::array<int, 3> sign{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto s = dot_of(side, e[i]);
      sign[i] = s > 0 ? 1 : (s < 0 ? -1 : 0);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      if (sign[i] > 0 && sign[(i + 1) % 3] < 0) return (i + 2) % 3;
    }
    return 3;
  }

  template <typename Better>
  static std::uint32_t extreme(const std::vector<Vec3>& vertices, const Vec3& n, Better better) {
    std::uint32_t best = 0;
    double value = dot(n, vertices[0]);
    for (std::uint32_t i = 1; i < vertices.size(); ++i) {
      const double here = dot(n, vertices[i]);
      if (better(here, value)) {
        value = here;
        best = i;
      }
    }
    return best;
  }
  [[nodiscard]] Corner support(const Vec3& n) const {
    return {extreme(first_, n, std::greater<>()), extreme(placed_, n, std::less<>())};
  }

  Portal walk_in_doubles() const {
    Portal portal;
    std::array<Vec3, 4> e;
    for (std::size_t i = 0; i < 4; ++i) e[i] = first_[anchors_[i]] - inner_second_ - centre_;
    const Vec3 ray = -centre_;
    const auto face = starting_face<Vec3>(e, ray);
    if (!face) return portal;
    for (std::size_t i = 0; i < 3; ++i) portal.points[i] = e[(*face)[i]] + centre_;
    int fresh_corners = 0;
    for (int step = 0; step < kMostSteps; ++step) {
      const Vec3 n = normal_of(portal.points);
      const Corner corner = support(n);
      const Vec3 point = first_[corner.first] - placed_[corner.second];
      if (dot(n, point - portal.points[0]) <= 8 * kEpsilon * magnitude_ * length(n)) break;
      std::array<Vec3, 3> from;
      for (std::size_t i = 0; i < 3; ++i) from[i] = portal.points[i] - centre_;
      const std::size_t out = replaced<Vec3>(from, point - centre_, ray);
      if (out == 3) return portal;
      portal.points[out] = point;
      portal.corners[out] = corner;
      fresh_corners |= 1 << out;
    }
    portal.is_start = fresh_corners != 7;
    portal.ended = true;
    return portal;
  }

  /// What the rounded triangle proves in spite of rounding.
  [[nodiscard]] std::optional<bool> certified(const Portal& portal) const {
    if (!portal.ended) return std::nullopt;
    const Vec3 n = normal_of(portal.points);
    const Corner most = support(n);
    const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    if (dot(n, first_[most.first]) - dot(n, placed_[most.second]) <
        -32 * kEpsilon * sum * magnitude_) {
      return false;  // n itself is exact; only the products with vertices are rounded
    }
    std::array<Vec3, 3> e;
    double size = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      e[i] = portal.points[i] - centre_;
      for (const Vec3& v : {e[i], portal.points[i], centre_}) {
        size = std::max({size, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
      }
    }
    const double error = 400 * size * size * (64 * kEpsilon * magnitude_ + kEpsilon * size);
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(dot(-centre_, cross(e[i], e[(i + 1) % 3])) > error)) return std::nullopt;
    }
    if (!(dot(n, e[0]) > error && dot(n, portal.points[0]) > error)) return std::nullopt;
    return true;  // the origin is inside the tetrahedron of c and the triangle, all of D
  }

  // Integers: everything times 2^(scale + kWeightBits).
  void prepare_integers() {
    if (has_integers_) return;
    has_integers_ = true;
    const int rotation_scale = scale_of(rotation_.rows);
    scale_ = std::max({first_scale_, rotation_scale + second_scale_, scale_of({&translation_, 1})});
    product_shift_ = scale_ - rotation_scale - second_scale_;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        exact_rotation_[i][j] = Dyadic(rotation_.rows[i][j]).scaled(rotation_scale);
      }
      exact_translation_[i] = Dyadic(translation_[i]).scaled(scale_);
    }
    set_exact_centre();
  }
  [[nodiscard]] IntegerVector exact_first(std::uint32_t i) const {
    IntegerVector p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = Dyadic(first_[i][k]).scaled(scale_ + kWeightBits);
    return p;
  }
  [[nodiscard]] IntegerVector exact_second(std::uint32_t i) const {
    IntegerVector w;
    for (std::size_t k = 0; k < 3; ++k) w[k] = Dyadic(second_[i][k]).scaled(second_scale_);
    IntegerVector p;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = ((dot_of(exact_rotation_[k], w) << static_cast<unsigned>(product_shift_)) +
              exact_translation_[k])
             << kWeightBits;
    }
    return p;
  }
  void set_exact_centre() {
    exact_inner_second_ = {};
    exact_centre_ = {};
    for (std::size_t i = 0; i < 4; ++i) {
      const IntegerVector a = exact_first(anchors_[i]);
      const IntegerVector b = exact_second(second_anchors_[i]);
      for (std::size_t k = 0; k < 3; ++k) {
        exact_centre_[k] += (a[k] >> kWeightBits) * weights_[i];
        exact_inner_second_[k] += (b[k] >> kWeightBits) * second_weights_[i];
      }
    }
    exact_centre_ = minus(exact_centre_, exact_inner_second_);
  }
  [[nodiscard]] IntegerVector exact_point(const Corner& c) const {
    return minus(exact_first(c.first), exact_second(c.second));
  }

  /// The vertex farthest along n, exactly: doubles rule out all but those within their error.
  template <typename Exact>
  [[nodiscard]] std::uint32_t exact_extreme(const std::vector<Vec3>& vertices,
                                            const IntegerVector& n,
                                            const Vec3& rounded,
                                            double sign,
                                            Exact exact) const {
    double most = -std::numeric_limits<double>::infinity();
    for (const Vec3& v : vertices) most = std::max(most, sign * dot(rounded, v));
    const double error = 64 * kEpsilon * magnitude_;  // |rounded| <= 1 in each entry
    std::uint32_t best = 0;
    std::optional<Integer> value;
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
      if (sign * dot(rounded, vertices[i]) < most - 2 * error) continue;
      Integer here = dot_of(n, exact(i));
      if (sign < 0) here = -here;
      if (!value || here > *value) {
        value = here;
        best = i;
      }
    }
    return best;
  }

  bool walk_in_integers(const Portal& guess) {
    prepare_integers();
    if (guess.ended && !guess.is_start) {
      std::array<IntegerVector, 3> p;
      std::array<IntegerVector, 3> e;
      for (std::size_t i = 0; i < 3; ++i) {
        p[i] = exact_point(guess.corners[i]);
        e[i] = minus(p[i], exact_centre_);
      }
      if (contains_ray<IntegerVector>(e, negated(exact_centre_)) &&
          dot_of(e[0], cross_of(e[1], e[2])) > 0) {
        if (const std::optional<bool> answer = push_outward(p)) return *answer;
      }
    }
    for (;;) {  // random weights put the ray on an edge with a chance of nearly nothing
      std::array<IntegerVector, 4> corners;
      std::array<IntegerVector, 4> e;
      for (std::size_t i = 0; i < 4; ++i) {
        corners[i] = minus(exact_first(anchors_[i]), exact_inner_second_);
        e[i] = minus(corners[i], exact_centre_);
      }
      const IntegerVector ray = negated(exact_centre_);
      if (ray == IntegerVector{}) return true;  // the origin is c, a point of D
      if (const auto face = starting_face<IntegerVector>(e, ray)) {
        const std::array<IntegerVector, 3> p{corners[(*face)[0]], corners[(*face)[1]],
                                             corners[(*face)[2]]};
        if (const std::optional<bool> answer = push_outward(p)) return *answer;
      }
      new_weights();
      set_centre();
      set_exact_centre();
    }
  }
  static IntegerVector negated(const IntegerVector& a) { return {-a[0], -a[1], -a[2]}; }

  std::optional<bool> push_outward(std::array<IntegerVector, 3> p) const {
    const IntegerVector ray = negated(exact_centre_);
    for (;;) {
      const IntegerVector n = cross_of(minus(p[1], p[0]), minus(p[2], p[0]));
      const Vec3 rounded = direction_of(n);
      const Corner corner{
          exact_extreme(first_, n, rounded, 1, [&](std::uint32_t i) { return exact_first(i); }),
          exact_extreme(placed_, n, rounded, -1, [&](std::uint32_t i) { return exact_second(i); })};
      const IntegerVector point = exact_point(corner);
      if (point == IntegerVector{}) return true;
      if (dot_of(n, minus(point, p[0])) <= 0) return dot_of(n, p[0]) >= 0;
      std::array<IntegerVector, 3> e;
      for (std::size_t i = 0; i < 3; ++i) e[i] = minus(p[i], exact_centre_);
      const std::size_t out = replaced<IntegerVector>(e, minus(point, exact_centre_), ray);
      if (out == 3) return lies_between(point, p) ? std::optional(true) : std::nullopt;
      p[out] = point;
    }
  }

  /// Whether the origin lies on a segment from the point, of D, to one of the others: then every
  /// ray from any c meets that edge.
  static bool lies_between(const IntegerVector& point, const std::array<IntegerVector, 3>& others) {
    for (const IntegerVector& other : others) {
      if (cross_of(point, other) == IntegerVector{} && dot_of(point, other) <= 0) return true;
    }
    return false;
  }

  std::vector<Vec3> first_;
  std::vector<Vec3> second_;
  std::vector<Vec3> placed_;
  int first_scale_ = 0;
  int second_scale_ = 0;
  Rng random_{17};
  std::array<std::uint32_t, 4> anchors_{};
  std::array<std::uint32_t, 4> second_anchors_{};
  std::array<int, 4> weights_{};
  std::array<int, 4> second_weights_{};
  Mat3 rotation_;
  Vec3 translation_;
  double magnitude_ =
      0;  ///< no coordinate of either placed body is larger, nor any part of its sum
  Vec3 inner_second_;
  Vec3 centre_;  ///< c
  bool has_integers_ = false;
  int scale_ = 0;
  int product_shift_ = 0;
  std::array<IntegerVector, 3> exact_rotation_;
  IntegerVector exact_translation_;
  IntegerVector exact_inner_second_;
  IntegerVector exact_centre_;
};

}  // namespace carpus::oracles
