// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Seeded pairs of convex bodies and poses that a method between convex bodies must survive: apart,
// deep, nested, touching to 1e-3 ... 1e-12 mm and to the last bit, solids with parallel and
// coplanar faces on lattices, needles and plates, far apart, far from the origin, large and small,
// matrices a little off a rotation.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/rng.hpp"
#include "geometry/convex_polytope.hpp"
#include "geometry/mat3.hpp"
#include "hull/quickhull.hpp"
#include "oracles/exact_meet.hpp"

namespace carpus::oracles {

struct Placement {
  Mat3 rotation;
  Vec3 translation;
  bool is_near = false;  ///< made to touch, give or take less than 1e-5 of its size
};

class PairGenerator {
 public:
  explicit PairGenerator(std::uint64_t seed) : random_(seed * 0x9E3779B9ULL + 5) {
    constexpr std::array kSizes{1.0, 1.0, 1.0, 1e-3, 1e3, 0.1};
    size_mm = kSizes[random_.below(kSizes.size())];
    is_lattice_ = random_.below(3) == 0;
    if (is_lattice_) size_mm = 1;
    first = solid();
    second = solid();
    if (random_.below(6) == 0) scale(second, is_lattice_ ? 0.25 : 0.2);  // fits into the first
    if (random_.below(6) == 0) {  // a CT's origin may be anywhere
      const double far_mm = random_.below(2) == 0 ? 1e6 : 1e4;
      origin_ = {far_mm, -far_mm, far_mm};
      shift(first);
      shift(second);
    }
    exact_.emplace(first.vertices, second.vertices);
  }

  [[nodiscard]] Placement next() {
    Placement p;
    p.rotation = is_lattice_ && random_.below(4) != 0 ? axis_rotation() : any_rotation();
    const Vec3 direction = any_direction();
    const std::uint64_t kind = random_.below(is_lattice_ ? 9 : 8);
    double away = random_.uniform(0, 14);
    if (kind == 0) away = random_.uniform(0, 0.5);                                 // deep or nested
    if (kind == 1) away = random_.uniform(15, 60);                                 // apart
    if (kind == 2 && random_.below(4) == 0) away = 1e3 / std::max(size_mm, 1e-3);  // far apart
    if (kind == 3 && !is_lattice_) bend(p.rotation);
    Vec3 centre = direction * (away * size_mm);
    if (kind == 8 || (is_lattice_ && kind >= 4)) {  // faces, edges and corners that touch exactly
      for (std::size_t i = 0; i < 3; ++i) {
        centre[i] = 0.5 * (static_cast<double>(random_.below(40)) - 20);
      }
    }
    // The second's middle, which lies at origin_ in its own frame, goes to the first's plus centre.
    p.translation = origin_ + centre - p.rotation * origin_;
    if (kind >= 4 && kind < 8 && (!is_lattice_ || random_.below(2) == 0)) touch(p);
    return p;
  }

  ConvexPolytope first;
  ConvexPolytope second;
  double size_mm = 1;

 private:
  void touch(Placement& p) {
    p.is_near = true;
    p.translation = exact_->touching(p.rotation, p.translation).translation;
    constexpr std::array kGaps{0.0, 0.0, 1e-6, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13};
    const double gap = kGaps[random_.below(kGaps.size())] * size_mm;
    p.translation += any_direction() * gap;
    for (std::uint64_t i = random_.below(3); i > 0; --i) {  // to the last bit
      double& x = p.translation[random_.below(3)];
      x = std::nextafter(x, random_.below(2) == 0 ? 1e300 : -1e300);
    }
  }

  [[nodiscard]] Vec3 any_direction() {
    return normalized_or({random_.normal(), random_.normal(), random_.normal()}, {1, 0, 0});
  }
  [[nodiscard]] Mat3 any_rotation() {
    return rotation_about(any_direction(), random_.uniform(0, 6.3));
  }
  /// One of the 24 rotations that permute the axes: exact in doubles.
  [[nodiscard]] Mat3 axis_rotation() {
    for (;;) {
      Mat3 m{};
      const std::uint64_t turn = random_.below(3);
      const bool swap = random_.below(2) == 0;
      for (std::size_t i = 0; i < 3; ++i) {
        std::size_t j = (i + turn) % 3;
        if (swap && j != 0) j = 3 - j;
        m.rows[i] = {};
        m.rows[i][j] = random_.below(2) == 0 ? 1 : -1;
      }
      if (m.determinant() > 0) return m;
    }
  }
  /// As products of many rotations drift.
  void bend(Mat3& m) {
    for (Vec3& row : m.rows) {
      for (std::size_t j = 0; j < 3; ++j) row[j] += random_.uniform(-1e-9, 1e-9);
    }
  }

  [[nodiscard]] ConvexPolytope solid() {
    for (;;) {
      std::vector<Vec3> points = is_lattice_ ? lattice_points() : smooth_points();
      for (Vec3& p : points) p *= size_mm;
      hull::HullResult result = hull::build_convex_hull(points);
      if (result.status == hull::HullStatus::Ok) return std::move(result.polytope);
    }
  }
  [[nodiscard]] std::vector<Vec3> smooth_points() {
    const std::uint64_t kind = random_.below(6);
    Vec3 radii{random_.uniform(3, 8), random_.uniform(3, 8), random_.uniform(3, 8)};
    std::uint64_t count = 12 + random_.below(30);
    if (kind == 0) radii = {0.4, 0.4, 12};               // needle
    if (kind == 1) radii = {6, 6, 0.05};                 // plate
    if (kind == 2) count = 4 + random_.below(4);         // few corners
    if (kind == 3) return prism(3 + random_.below(30));  // coplanar faces, but for rounding
    std::vector<Vec3> points;
    for (std::uint64_t i = 0; i < count; ++i) {
      const Vec3 d = any_direction();
      points.push_back({radii.x * d.x, radii.y * d.y, radii.z * d.z});
    }
    return points;
  }
  [[nodiscard]] std::vector<Vec3> prism(std::uint64_t sides) {
    constexpr double kTurn = 6.283185307179586;
    const double radius = random_.uniform(1, 6);
    const double half = random_.uniform(1, 8);
    std::vector<Vec3> points;
    for (std::uint64_t i = 0; i < sides; ++i) {
      const double a = kTurn * static_cast<double>(i) / static_cast<double>(sides);
      for (const double z : {-half, half}) {
        points.push_back({radius * std::cos(a), radius * std::sin(a), z});
      }
    }
    return points;
  }
  [[nodiscard]] std::vector<Vec3> lattice_points() {
    std::vector<Vec3> points;
    const auto add_signs = [&](double x, double y, double z) {
      for (int i = 0; i < 8; ++i) {
        points.push_back({(i & 1) != 0 ? x : -x, (i & 2) != 0 ? y : -y, (i & 4) != 0 ? z : -z});
      }
    };
    switch (random_.below(6)) {
      case 0:
        add_signs(4, 4, 4);
        break;
      case 1:
        add_signs(5, 0, 0);
        add_signs(0, 5, 0);
        add_signs(0, 0, 5);
        break;
      case 2:
        add_signs(1, 1, 8);
        break;
      case 3:
        add_signs(2, 3, 6);
        add_signs(6, 2, 3);
        add_signs(3, 6, 2);
        break;
      case 4: {  // the lattice points of a ball
        for (int x = -4; x <= 4; ++x) {
          for (int y = -4; y <= 4; ++y) {
            for (int z = -4; z <= 4; ++z) {
              if (x * x + y * y + z * z <= 17) {
                points.push_back(
                    {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
              }
            }
          }
        }
        break;
      }
      default:
        for (std::uint64_t i = 4 + random_.below(16); i > 0; --i) {
          const auto c = [&] { return static_cast<double>(random_.below(11)) - 5; };
          const double x = c();
          const double y = c();
          points.push_back({x, y, c()});
        }
    }
    return points;
  }

  static void scale(ConvexPolytope& body, double factor) {
    for (Vec3& v : body.vertices) v *= factor;
    rebuild(body);
  }
  void shift(ConvexPolytope& body) const {
    for (Vec3& v : body.vertices) v += origin_;
    rebuild(body);
  }
  /// Rounding may have moved corners into the hull of the others.
  static void rebuild(ConvexPolytope& body) {
    hull::HullResult result = hull::build_convex_hull(body.vertices);
    if (result.status == hull::HullStatus::Ok) body = std::move(result.polytope);
  }

  Rng random_;
  bool is_lattice_ = false;
  Vec3 origin_;
  std::optional<ExactMeet> exact_;
};

}  // namespace carpus::oracles
