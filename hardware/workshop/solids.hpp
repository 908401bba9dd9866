// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Shapes of what is bought: enough to see it and to keep clear of it. And where things lie.
#pragma once

#include "geometry/mat3.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::hardware {

/// A rigid motion: rotation first.
struct Place {
  Mat3 rotation;
  Vec3 translation;

  [[nodiscard]] Vec3 operator*(const Vec3& p) const noexcept { return rotation * p + translation; }
  [[nodiscard]] Place operator*(const Place& inner) const noexcept {
    return {rotation * inner.rotation, rotation * inner.translation + translation};
  }
};
[[nodiscard]] Place at(const Vec3& translation);
[[nodiscard]] Place turned(const Vec3& axis, double degrees);
/// z along `from` to `to`, origin at `from`.
[[nodiscard]] Place along(const Vec3& from, const Vec3& to);

[[nodiscard]] TriangleMesh moved(const TriangleMesh& mesh, const Place& place);
void append(TriangleMesh& mesh, const TriangleMesh& other);

[[nodiscard]] TriangleMesh box(const Vec3& low, const Vec3& high);
/// About z, from z = `low` to z = `high`.
[[nodiscard]] TriangleMesh cylinder(double radius, double low, double high, int sides = 32);
[[nodiscard]] TriangleMesh ring(double inner,
                                double outer,
                                double low,
                                double high,
                                int sides = 32);
[[nodiscard]] TriangleMesh ball(double radius, int sides = 24);

}  // namespace carpus::hardware
