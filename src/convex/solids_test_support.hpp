// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bodies and poses for the tests of this folder: regular ones, on which everything ties, thin ones,
// and round ones with many corners.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"
#include "core/rng.hpp"
#include "core/units.hpp"
#include "hull/fast_hull.hpp"

namespace carpus::convex::test {

inline ConvexBody body_of(const std::vector<Vec3>& points) {
  return ConvexBody(hull::build_fast_hull(points).polytope);
}

inline std::vector<Vec3> box_points(const Vec3& half) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) {
    points.push_back({(i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                      (i & 4) != 0 ? half.z : -half.z});
  }
  return points;
}

inline std::vector<Vec3> prism_points(int sides, double radius, double half_length) {
  std::vector<Vec3> points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * kPi * i / sides;
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), half_length});
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), -half_length});
  }
  return points;
}

inline std::vector<Vec3> lattice_ball_points(int radius) {
  std::vector<Vec3> points;
  for (int x = -radius; x <= radius; ++x) {
    for (int y = -radius; y <= radius; ++y) {
      for (int z = -radius; z <= radius; ++z) {
        if (x * x + y * y + z * z <= radius * radius) {
          points.push_back({double(x), double(y), double(z)});
        }
      }
    }
  }
  return points;
}

inline Vec3 random_direction(Rng& rng) {
  return normalized_or({rng.normal(), rng.normal(), rng.normal()}, {1, 0, 0});
}

inline std::vector<Vec3> round_points(Rng& rng, int count, const Vec3& radii) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const Vec3 d = random_direction(rng);
    points.push_back({d.x * radii.x, d.y * radii.y, d.z * radii.z});
  }
  return points;
}

struct Solid {
  std::string name;
  ConvexBody body;
};

/// At most some 60 corners each, so that exhaustive oracles stay affordable.
inline const std::vector<Solid>& small_solids() {
  static const std::vector<Solid> solids = [] {
    Rng rng(20260101);
    std::vector<Solid> s;
    s.push_back({"cube", body_of(box_points({1, 1, 1}))});
    s.push_back({"slab", body_of(box_points({3, 2, 0.01}))});
    s.push_back({"octahedron",
                 body_of({{2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 2}, {0, 0, -2}})});
    s.push_back({"tetrahedron", body_of({{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}})});
    s.push_back({"prism", body_of(prism_points(16, 1.5, 1))});
    s.push_back({"lattice ball", body_of(lattice_ball_points(2))});
    s.push_back({"needle", body_of(box_points({0.01, 0.013, 10}))});
    s.push_back({"cloud", body_of(round_points(rng, 30, {3, 2, 1}))});
    s.push_back(
        {"sliver",
         body_of({{-2, 0, 0}, {2, 1e-7, 0}, {0, 1e-6, 2}, {0.3, 1e-3, -2}, {0.1, -1e-6, 1.9}})});
    return s;
  }();
  return solids;
}

/// The same body with its coordinates about another point of its frame.
inline ConvexBody shifted(const ConvexBody& body, const Vec3& by) {
  std::vector<Vec3> points;
  for (const Vec3& v : body.vertices()) points.push_back(v + by);
  return body_of(points);
}

/// One of the 24 rotations of a cube onto itself: exact, and everything ties.
inline Mat3 lattice_rotation(Rng& rng) {
  std::array<std::size_t, 3> order{0, 1, 2};
  std::swap(order[0], order[rng.below(3)]);
  std::swap(order[1], order[1 + rng.below(2)]);
  Mat3 m{{Vec3{}, Vec3{}, Vec3{}}};
  for (std::size_t i = 0; i < 3; ++i) m.rows[i][order[i]] = rng.below(2) == 0 ? 1 : -1;
  if (m.determinant() < 0) m.rows[0] *= -1;
  return m;
}

inline Mat3 random_rotation(Rng& rng) {
  return rotation_from_quaternion(rng.normal(), rng.normal(), rng.normal(), rng.normal());
}

/// Any pose, or one on which features are parallel and offsets lie on a grid; nearly so, too.
inline PairPose random_pose(Rng& rng, double reach_mm) {
  PairPose pose;
  const std::uint64_t kind = rng.below(4);
  if (kind == 0) {
    pose.rotation = random_rotation(rng);
    pose.translation = random_direction(rng) * rng.uniform(0, reach_mm);
    return pose;
  }
  pose.rotation = lattice_rotation(rng);
  for (std::size_t i = 0; i < 3; ++i) {
    pose.translation[i] = 0.5 * std::floor(rng.uniform(-2 * reach_mm, 2 * reach_mm) + 0.5);
  }
  if (kind == 2) {  // nearly parallel
    const std::array angles{1e-3, 1e-6, 1e-9, 1e-12, 1e-15};
    pose.rotation =
        rotation_about(random_direction(rng), angles[rng.below(angles.size())]) * pose.rotation;
  }
  if (kind == 3) pose.translation += random_direction(rng) * rng.uniform(0, 1e-6);
  return pose;
}

/// A smooth course of poses about a body: near, into and away again.
inline PairPose pose_on_a_course(double t, double reach_mm) {
  return {rotation_about({0.6, 0, 0.8}, t),
          Vec3{reach_mm * (1 + 0.25 * std::sin(3 * t)), reach_mm * 0.3 * std::sin(t),
               reach_mm * 0.2 * std::cos(2 * t)}};
}

/// Cases of a test: `usual`, a tenth with CARPUS_QUICK=1, a hundred times as many with
/// CARPUS_LONG=1.
inline std::uint64_t cases(std::uint64_t usual) {
  const auto is_set = [](const char* name) {
    const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
    return value != nullptr && std::string(value) == "1";
  };
  if (is_set("CARPUS_LONG")) return usual * 100;
  return is_set("CARPUS_QUICK") ? usual / 10 + 1 : usual;
}

}  // namespace carpus::convex::test
