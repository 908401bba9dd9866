// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/reduction.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace carpus::anatomy {
namespace {

constexpr double kTowards = 0.3;   // cosine between a facet's normal and the way to the other
constexpr double kOpposed = -0.5;  // cosine between facets that were one surface
constexpr double kNearMm = 5.0;    // from the other fragment's nearest: gap and step together
constexpr double kAlong = 0.8;     // cosine between a facet and its face: relief of a fracture
constexpr double kBesideMm = 2.0;  // of a facet from its face's plane: the same
constexpr int kRounds = 8;
constexpr double kLeastFaceMm2 = 20;  // a waist is 70 to 100 mm2 [clinical: S47]

struct Facet {
  Vec3 middle;
  Vec3 normal;  ///< unit
  double area_mm2 = 0.0;
};

struct Face {
  Vec3 middle;
  Vec3 normal;
  double area_mm2 = 0.0;
};

Vec3 middle_of(const TriangleMesh& mesh) {
  Vec3 sum;
  double area = 0.0;
  for (const Triangle& t : mesh.facets) {
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3& b = mesh.vertices[t[1]];
    const Vec3& c = mesh.vertices[t[2]];
    const double twice = length(cross(b - a, c - a));
    sum += (a + b + c) * (twice / 3.0);
    area += twice;
  }
  return area > 0.0 ? sum * (1.0 / area) : Vec3{};
}

/// Facets that look about that way.
std::vector<Facet> facing(const TriangleMesh& mesh, const Vec3& towards) {
  std::vector<Facet> facets;
  for (const Triangle& t : mesh.facets) {
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3& b = mesh.vertices[t[1]];
    const Vec3& c = mesh.vertices[t[2]];
    const Vec3 across = cross(b - a, c - a);
    const double twice = length(across);
    if (!(twice > 0.0) || dot(across, towards) < kTowards * twice) continue;
    facets.push_back({(a + b + c) * (1.0 / 3.0), across * (1.0 / twice), 0.5 * twice});
  }
  return facets;
}

Face mean_of(const std::vector<Facet>& facets) {
  Face face;
  for (const Facet& facet : facets) {
    face.middle += facet.middle * facet.area_mm2;
    face.normal += facet.normal * facet.area_mm2;
    face.area_mm2 += facet.area_mm2;
  }
  if (!(face.area_mm2 > 0.0)) return face;
  face.middle *= 1.0 / face.area_mm2;
  face.normal = normalized_or(face.normal, {0, 0, 1});
  return face;
}

/// Of these facets those that have one near that looks back at them; then, again and again, those
/// that lie along their plane: a flank beside an oblique fracture looks back too.
std::optional<Face> face_of(const std::vector<Facet>& facets, const std::vector<Facet>& others) {
  std::vector<Facet> kept;
  for (const Facet& facet : facets) {
    const bool has_opposite = std::any_of(others.begin(), others.end(), [&](const Facet& other) {
      return squared_length(other.middle - facet.middle) < kNearMm * kNearMm &&
             dot(other.normal, facet.normal) < kOpposed;
    });
    if (has_opposite) kept.push_back(facet);
  }
  Face face = mean_of(kept);
  for (int round = 0; round < kRounds && face.area_mm2 >= kLeastFaceMm2; ++round) {
    std::vector<Facet> along;
    for (const Facet& facet : kept) {
      const double height = dot(facet.middle - face.middle, face.normal);
      if (dot(facet.normal, face.normal) > kAlong && std::abs(height) < kBesideMm) {
        along.push_back(facet);
      }
    }
    face = mean_of(along);
  }
  return face.area_mm2 >= kLeastFaceMm2 ? std::optional(face) : std::nullopt;
}

}  // namespace

FractureOffset Reduction::offset(
    const Pose<frame::Bone, frame::Bone>& first_from_second) const noexcept {
  const Vec3 way = (first_from_second * Point<frame::Bone>{second_middle}).v - first_middle;
  const double along = dot(way, first_normal);
  const Vec3 normal = first_from_second.rotation * second_normal;
  return {along, length(way - first_normal * along), -dot(normal, first_normal)};
}

std::optional<Reduction> reduction_of(const MeshIn<frame::Bone>& first,
                                      const MeshIn<frame::Bone>& second) {
  const Vec3 between = middle_of(second) - middle_of(first);
  const Vec3 towards = normalized_or(between, {0, 0, 1});
  const std::vector<Facet> of_first = facing(first, towards);
  const std::vector<Facet> of_second = facing(second, -towards);
  const auto a = face_of(of_first, of_second);
  const auto b = face_of(of_second, of_first);
  if (!a || !b) return std::nullopt;
  // Most fractures are oblique to their bone: faces that only stand apart, along the bone, do not
  // lie opposite each other. That much of the way across is no step.
  const Vec3 way = b->middle - a->middle;
  const double gap = dot(way, a->normal);
  Vec3 by_gap;
  for (int round = 0; round < kRounds; ++round) {  // each ten times nearer
    const Vec3 step = way - a->normal * gap - by_gap;
    const Vec3 along = normalized_or(between - step, towards);
    const double steep = dot(along, a->normal);
    if (!(steep > kTowards)) break;
    by_gap = (along - a->normal * steep) * (gap / steep);
  }
  return Reduction{a->middle, a->normal, b->middle - by_gap, b->normal};
}

}  // namespace carpus::anatomy
