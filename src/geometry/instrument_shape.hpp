// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The instruments' shapes for contact with true surfaces. Each is exactly the union of balls whose
// centres run along the shaft and whose radius changes linearly between a few knots; so its
// distance to anything is one minimum along one line.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "geometry/vec3.hpp"

namespace carpus {

// Frame Tool throughout: the foremost point of the shape is the origin, +z runs along the shaft
// towards the hand. Lengths are over all, ends included [mm].

/// A ball: probe tip, burr. Its centre is (0, 0, radius).
struct SphereShape {
  double radius_mm = 1.5;
};

/// A round bar with half balls at both ends: probe, driver, shaft.
struct CapsuleShape {
  double radius_mm = 1.5;
  double length_mm = 60.0;
};

/// A pointed bar: wire, drill. A circular cone with its apex at the origin that would reach
/// `radius_mm` at `cone_mm`, then a round bar with a half ball at its end. Where cone and bar meet,
/// the edge is rounded by the ball that touches both: with c = sqrt(radius^2 + cone^2) it lies
/// sqrt((c - cone)^2 + radius^2) - radius under the sharp edge (wire 0.57 x 1.5: 0.010 mm).
struct ConeTipShape {
  double radius_mm = 0.57;
  double cone_mm = 1.5;
  double length_mm = 80.0;
};

/// A screw: what its thread's crests sweep when it turns, a round bar of `crest_radius_mm` with
/// half balls at both ends. Contact is decided on that envelope; the contact patch says how many
/// turns of the thread it holds and where the core touches as well.
struct ThreadedCylinderShape {
  double core_radius_mm = 1.0;
  double crest_radius_mm = 1.5;
  double pitch_mm = 1.0;  ///< crest to crest along the axis, single start
  double length_mm = 24.0;
};

enum class ShapeKind : std::uint8_t { Sphere, Capsule, ConeTip, ThreadedCylinder };

/// A ball of the union: centre (0, 0, z_mm).
struct AxisKnot {
  double z_mm = 0;
  double radius_mm = 0;
};

struct ScrewThread {
  double depth_mm = 0;  ///< crest radius less core radius
  double pitch_mm = 0;
};

/// Any of the four shapes, as the contact search takes it. Immutable, small, to be copied.
class InstrumentShape {
 public:
  /// @throws InvalidInput if a measure is not finite and positive, a length is too short for its
  ///     rounded ends, or a core is not thinner than its crest.
  explicit InstrumentShape(const SphereShape& shape);
  explicit InstrumentShape(const CapsuleShape& shape);
  explicit InstrumentShape(const ConeTipShape& shape);
  explicit InstrumentShape(const ThreadedCylinderShape& shape);

  [[nodiscard]] ShapeKind kind() const noexcept { return kind_; }
  /// One to three, z rising; between two the radius is linear and steeper than nowhere 1.
  [[nodiscard]] std::span<const AxisKnot> knots() const noexcept { return {knots_.data(), count_}; }
  [[nodiscard]] double front_z_mm() const noexcept { return knots_[0].z_mm; }
  [[nodiscard]] double back_z_mm() const noexcept { return knots_[count_ - 1].z_mm; }
  [[nodiscard]] double least_radius_mm() const noexcept { return knots_[0].radius_mm; }
  [[nodiscard]] double greatest_radius_mm() const noexcept { return knots_[count_ - 1].radius_mm; }
  /// Only of a threaded cylinder.
  [[nodiscard]] const std::optional<ScrewThread>& thread() const noexcept { return thread_; }

  /// Radius of the ball centred at z; z is clamped to the axis.
  [[nodiscard]] double radius_at(double z_mm) const noexcept;

  /// Exact signed distance of a point in frame Tool to the shape [mm], negative inside.
  [[nodiscard]] double signed_distance(const Vec3& point) const noexcept;

 private:
  std::array<AxisKnot, 3> knots_{};
  std::size_t count_ = 1;
  ShapeKind kind_;
  std::optional<ScrewThread> thread_;
};

}  // namespace carpus
