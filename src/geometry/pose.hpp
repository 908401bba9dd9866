// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames as types: a pose maps from one named frame to another, and composing two compiles only
// when the inner frames agree. docs/units_and_frames.md draws every frame.
#pragma once

#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"

namespace carpus {

namespace frame {
struct Patient;  ///< LPS of the CT, right-handed, mm: +x left, +y posterior, +z superior.
struct Wrist;    ///< Radius coordinate system: +x proximal, +z volar, +y ulnar (left) or radial
                 ///< (right).
struct Bone;     ///< A bone as it lay in the CT; equals Patient until the bone is moved.
struct Tool;     ///< Instrument: origin at the tip, +z along the shaft towards the hand.
struct CArm;     ///< Receptor: +x to the right of the picture, +y down, +z along the beam, away.
}  // namespace frame

/// A position [mm] expressed in frame F.
template <typename F>
struct Point {
  Vec3 v;
  constexpr bool operator==(const Point&) const = default;
};

/// A displacement [mm] or direction [1] expressed in frame F.
template <typename F>
struct Direction {
  Vec3 v;
  constexpr bool operator==(const Direction&) const = default;
};

template <typename F>
[[nodiscard]] constexpr Direction<F> operator-(const Point<F>& a, const Point<F>& b) noexcept {
  return {a.v - b.v};
}
template <typename F>
[[nodiscard]] constexpr Point<F> operator+(const Point<F>& a, const Direction<F>& d) noexcept {
  return {a.v + d.v};
}

/// Rigid motion that takes coordinates in frame Of to coordinates in frame In: `Pose<In, Of>` is
/// named `in_from_of`. `rotation` is orthonormal with determinant +1; `translation` in mm.
template <typename In, typename Of>
struct Pose {
  Mat3 rotation;
  Vec3 translation;

  constexpr bool operator==(const Pose&) const = default;

  [[nodiscard]] constexpr Point<In> operator*(const Point<Of>& p) const noexcept {
    return {rotation * p.v + translation};
  }
  [[nodiscard]] constexpr Direction<In> operator*(const Direction<Of>& d) const noexcept {
    return {rotation * d.v};
  }
  [[nodiscard]] constexpr Pose<Of, In> inverse() const noexcept {
    const Mat3 rt = rotation.transposed();
    return {rt, -(rt * translation)};
  }
};

template <typename A, typename B, typename C>
[[nodiscard]] constexpr Pose<A, C> operator*(const Pose<A, B>& a, const Pose<B, C>& b) noexcept {
  return {a.rotation * b.rotation, a.rotation * b.translation + a.translation};
}

}  // namespace carpus
