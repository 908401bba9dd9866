// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A small wrist for tests, made of ellipsoids by formula: no file, no random number, and only
// + - * / and sqrt, so that it is the same to the last bit in every build. Its scaphoid's axis,
// widths and lengths are known by construction. Not anatomy.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "cases/case_data.hpp"
#include "fields/distance_field.hpp"

namespace carpus::cases::test {

/// An ellipsoid with semi-axes along the columns of `rotation`.
struct Ellipsoid {
  Vec3 centre;
  Mat3 rotation;
  Vec3 semi_axes;

  /// First-order signed distance [mm]: exact sign and zero, near the distance close to the surface.
  [[nodiscard]] double signed_distance(const Vec3& p) const {
    const Vec3 q = rotation.transposed() * (p - centre);
    const Vec3 k{q.x / semi_axes.x, q.y / semi_axes.y, q.z / semi_axes.z};
    const Vec3 g{k.x / semi_axes.x, k.y / semi_axes.y, k.z / semi_axes.z};
    const double k0 = length(k);
    const double k1 = length(g);
    if (!(k1 > 0)) return -std::min({semi_axes.x, semi_axes.y, semi_axes.z});
    return k0 * (k0 - 1.0) / k1;
  }
  [[nodiscard]] Vec3 surface_point(const Vec3& unit) const {
    return centre +
           rotation * Vec3{unit.x * semi_axes.x, unit.y * semi_axes.y, unit.z * semi_axes.z};
  }
};

/// Octahedron, each facet divided in four `levels` times, drawn to the unit sphere.
[[nodiscard]] inline TriangleMesh unit_sphere(int levels) {
  TriangleMesh mesh{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    std::vector<Triangle> facets;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [it, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new) {
        mesh.vertices.push_back(normalized_or(mesh.vertices[a] + mesh.vertices[b], {0, 0, 1}));
      }
      return it->second;
    };
    for (const auto& [a, b, c] : mesh.facets) {
      const auto ab = middle(a, b);
      const auto bc = middle(b, c);
      const auto ca = middle(c, a);
      facets.insert(facets.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.facets = std::move(facets);
  }
  return mesh;
}

[[nodiscard]] inline TriangleMesh surface_of(const Ellipsoid& body, int levels) {
  TriangleMesh mesh = unit_sphere(levels);
  for (Vec3& v : mesh.vertices) v = body.surface_point(v);
  return mesh;
}

/// The polytope that a convex surface already is.
[[nodiscard]] inline ConvexPolytope polytope_of_convex(const TriangleMesh& mesh) {
  ConvexPolytope polytope;
  polytope.vertices = mesh.vertices;
  polytope.facets = mesh.facets;
  for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) polytope.input_indices.push_back(i);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> facet_left_of;
  for (std::uint32_t f = 0; f < mesh.facets.size(); ++f) {
    const auto& [a, b, c] = mesh.facets[f];
    facet_left_of[{a, b}] = facet_left_of[{b, c}] = facet_left_of[{c, a}] = f;
    const Vec3& p = mesh.vertices[a];
    const Vec3 normal = normalized_or(cross(mesh.vertices[b] - p, mesh.vertices[c] - p), {0, 0, 1});
    polytope.planes.push_back({normal, dot(normal, p)});
  }
  for (const auto& [a, b, c] : mesh.facets) {
    polytope.neighbours.push_back(
        {facet_left_of.at({b, a}), facet_left_of.at({c, b}), facet_left_of.at({a, c})});
  }
  return polytope;
}

/// The scaphoid of the synthetic wrist: long axis 27 mm, waist 11.2 x 9.6 mm [clinical: B13].
[[nodiscard]] inline Ellipsoid synthetic_scaphoid() {
  // Its long axis points from proximal to distal, volar and radial, as in a wrist.
  return {{2, -1, 3}, rotation_from_quaternion(8, -3, -2, 0), {5.6, 4.8, 13.5}};
}

/// A half of that bone, its fracture face across the middle and so far from it [mm].
[[nodiscard]] inline MeshIn<frame::Bone> half_scaphoid(BonePart part, double face_mm) {
  const Ellipsoid body = synthetic_scaphoid();
  const Vec3 along = body.rotation.column(2);  // proximal is where it points to +z
  const bool is_plus = (along.z > 0) == (part == BonePart::Proximal);
  const Vec3 out = along * (is_plus ? 1.0 : -1.0);
  TriangleMesh mesh = surface_of(body, 4);
  for (Vec3& v : mesh.vertices) {
    const double height = dot(v - body.centre, out);
    if (height < face_mm) v += out * (face_mm - height);
  }
  return MeshIn<frame::Bone>(std::move(mesh));
}

/// A left wrist of six bones. Patient frame: proximal is +z, volar is -y, ulnar is -x.
[[nodiscard]] inline CaseData synthetic_case() {
  CaseData data;
  data.pseudonym = "synthetic wrist";
  data.provenance.simulated = true;
  data.provenance.source = "ellipsoids by formula, for tests";
  data.side = Side::Left;
  // Rows: the wrist's axes in Patient, proximal, ulnar, volar.
  data.wrist_from_patient = {{{Vec3{0, 0, 1}, Vec3{-1, 0, 0}, Vec3{0, -1, 0}}}, {}};
  const Ellipsoid scaphoid = synthetic_scaphoid();
  const Mat3 upright = Mat3::identity();
  const std::vector<std::pair<BoneId, Ellipsoid>> bodies{
      {BoneId::Radius, {{-2, 12, 43}, upright, {14, 9, 24}}},
      {BoneId::Ulna, {{-24, 4, 48}, upright, {7, 7, 24}}},
      {BoneId::Scaphoid, scaphoid},
      {BoneId::Lunate, {{-14, 2, 10}, upright, {6, 7, 7}}},
      {BoneId::Trapezium, {{14, -18, -14}, upright, {7, 7, 6}}},
      {BoneId::Capitate, {{-12, 0, -12}, upright, {6, 7, 12}}}};
  for (const auto& [id, body] : bodies) {
    Bone bone;
    bone.bone = id;
    bone.label = static_cast<std::uint8_t>(id);
    bone.surface = MeshIn<frame::Bone>(surface_of(body, 4));
    bone.hull = polytope_of_convex(bone.surface);
    bone.distance_field = fields::build_distance_field(bone.surface);
    data.bones.push_back(std::move(bone));
  }
  const Vec3 along = scaphoid.rotation.column(2);
  const bool proximal_is_plus = along.z > 0;
  const Vec3 proximal = scaphoid.centre + along * (proximal_is_plus ? 13.5 : -13.5);
  const Vec3 distal = scaphoid.centre - along * (proximal_is_plus ? 13.5 : -13.5);
  data.scaphoid.central_axis = {proximal, distal};
  data.scaphoid.central_radius_mm = 4.8 * std::sqrt(1 - 0.7 * 0.7);  // a cylinder of 0.7 its length
  data.scaphoid.longest_line = {proximal, distal};
  data.scaphoid.waist = scaphoid.centre;

  const Ellipsoid skin{{0, 0, 12}, upright, {38, 26, 75}};
  data.skin = MeshIn<frame::Patient>(surface_of(skin, 3));
  GridGeometry geometry;
  geometry.size = {80, 56, 118};
  geometry.spacing = {1, 1, 1};
  geometry.origin = {-39.5, -27.5, -44.5};
  data.ct = Grid<std::int16_t>(geometry, -1000);
  data.labels = Grid<std::uint8_t>(geometry, 0);
  for (std::size_t i = 0; i < data.ct.values().size(); ++i) {
    const VoxelIndex v = geometry.index_of(i);
    const Vec3 p = geometry.patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    if (skin.signed_distance(p) > 0) continue;
    data.ct[i] = 40;
    for (const auto& [id, body] : bodies) {
      const double depth = -body.signed_distance(p);
      if (depth < 0) continue;
      // Cortex of 900 HU falling to 300 HU of cancellous bone within 2 mm.
      data.ct[i] = static_cast<std::int16_t>(300.0 + 300.0 * std::max(0.0, 2.0 - depth));
      data.labels[i] = static_cast<std::uint8_t>(id);
    }
  }
  return data;
}

}  // namespace carpus::cases::test
