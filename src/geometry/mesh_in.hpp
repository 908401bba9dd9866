// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Surfaces that know their frame: a bone's is never taken for one in Patient.
#pragma once

#include <utility>

#include "geometry/pose.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus {

/// A surface whose vertices are in frame F. What is true of it in any frame (volume, distance
/// field) takes the plain mesh that it is; to come into another frame it needs a pose.
template <typename F>
struct MeshIn : TriangleMesh {
  MeshIn() = default;
  explicit MeshIn(TriangleMesh mesh) : TriangleMesh(std::move(mesh)) {}
};

template <typename To, typename From>
[[nodiscard]] MeshIn<To> operator*(const Pose<To, From>& pose, MeshIn<From> mesh) {
  for (Vec3& vertex : mesh.vertices) vertex = (pose * Point<From>{vertex}).v;
  return MeshIn<To>(std::move(mesh));
}

}  // namespace carpus
