// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What `carpus collide` finds out about two hulls.
#pragma once

#include <optional>
#include <string>

#include "convex/pair_query.hpp"
#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"
#include "survey/methods.hpp"
#include "survey/motion/contact_interval.hpp"

namespace carpus::cli {

/// A body's place in the common frame.
struct Placement {
  Mat3 rotation;
  Vec3 translation;  ///< mm
  [[nodiscard]] Vec3 operator()(const Vec3& p) const { return rotation * p + translation; }
};

struct CollideBody {
  std::string name;
  convex::ConvexBody hull;
  Placement placement;
};

/// Positions and directions in the common frame; methods by their names.
struct CollideReport {
  convex::Verdict verdict = convex::Verdict::Unknown;
  const survey::Method* method = nullptr;
  double query_us = 0;  ///< of one verdict without memory of an earlier one, median of 21

  const survey::Method* distance_method = nullptr;  ///< null: none was asked
  std::optional<convex::Closest> closest;
  const survey::Method* depth_method = nullptr;
  std::optional<convex::Penetration> penetration;

  std::optional<Vec3> velocity_mm_per_s;  ///< of the second body against the first
  survey::ContactInterval sweep;
};

/// @param method  null: the verdict by lp_growth, distance by closest_active_set, depth by
///        depth_exact, or what else gives them; otherwise all by this one, as far as it can.
[[nodiscard]] CollideReport collide(const CollideBody& first,
                                    const CollideBody& second,
                                    const survey::Method* method,
                                    const std::optional<Vec3>& velocity_mm_per_s);

}  // namespace carpus::cli
