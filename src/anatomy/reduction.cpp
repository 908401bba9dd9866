// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/reduction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "anatomy/detail/outline.hpp"
#include "anatomy/symmetric_eigen.hpp"

namespace carpus::anatomy {
namespace {

constexpr double kTowards = 0.3;    // cosine between a facet's normal and the way to the other
constexpr double kOpposed = -0.5;   // cosine between facets that were one surface
constexpr double kNearMm = 5.0;     // from the other fragment's nearest: gap and step together
constexpr double kAlong = 0.8;      // cosine between a facet and its face: relief of a fracture
constexpr double kBesideMm = 2.0;   // of a facet from its face's plane: the same; at first
constexpr double kNarrower = 0.85;  // with each round
constexpr double kLeastBandMm = 1.0;
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

/// The plane along which facets lie, by least squares with Tukey's weights: what is far from it,
/// such as a rim that is rounded off, weighs nothing. Its area is that of the facets that weigh.
Face plane_along(const std::vector<Facet>& facets, const Face& before, double band_mm) {
  std::vector<double> weights(facets.size(), 0.0);
  Face face;
  double sum = 0.0;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const double height = dot(facets[i].middle - before.middle, before.normal) / band_mm;
    if (!(std::abs(height) < 1.0) || dot(facets[i].normal, before.normal) < kAlong) continue;
    const double share = 1.0 - height * height;
    weights[i] = facets[i].area_mm2 * share * share;
    sum += weights[i];
    face.middle += facets[i].middle * weights[i];
    face.area_mm2 += facets[i].area_mm2;
  }
  if (!(sum > 0.0)) return {};
  face.middle *= 1.0 / sum;
  SquareMatrix<3> spread{};
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const Vec3 beside = facets[i].middle - face.middle;
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) spread[r][c] += weights[i] * beside[r] * beside[c];
    }
  }
  const std::array<double, 3> flattest = eigen_of_symmetric(spread).vectors[2];
  const Vec3 normal{flattest[0], flattest[1], flattest[2]};
  face.normal = dot(normal, before.normal) < 0 ? -normal : normal;
  return face;
}

/// Of these facets those that have one near that looks back at them; then, again and again, the
/// plane along which they lie: a flank beside an oblique fracture looks back too.
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
    face = plane_along(kept, face, std::max(kLeastBandMm, kBesideMm * std::pow(kNarrower, round)));
  }
  return face.area_mm2 >= kLeastFaceMm2 ? std::optional(face) : std::nullopt;
}

/// Where the bone's middle meets the face's plane, from its sections below the face by a parabola
/// (least squares): the face's own rim is lost where bone runs out sharply under an oblique
/// fracture, on one side of the first fragment and on the other of the second.
Vec3 middle_by_sections(const TriangleMesh& mesh, const Face& face) {
  constexpr double kLeastDepthMm = 0.8;  // below the face's relief
  constexpr double kStepMm = 0.4;
  constexpr int kSections = 5;
  // Depths -2 .. 2 steps about the middle one: sums of odd powers vanish.
  constexpr double kPower2 = 10.0;
  constexpr double kPower4 = 34.0;
  const double middle_depth = kLeastDepthMm + kStepMm * (kSections / 2);
  Vec3 sum;
  Vec3 first_moment;
  Vec3 second_moment;
  for (int i = 0; i < kSections; ++i) {
    const double depth = kLeastDepthMm + kStepMm * i;
    const Vec3 below = face.middle - face.normal * depth;
    const BoneSection section = detail::outline_around(mesh, below, face.normal);
    if (!(section.area_mm2 > 0.0)) return face.middle;
    const Vec3 beside = section.centroid - below;
    const double t = i - kSections / 2;
    sum += beside;
    first_moment += beside * t;
    second_moment += beside * (t * t);
  }
  const Vec3 slope = first_moment / kPower2;
  const Vec3 bend =
      (second_moment - sum * (kPower2 / kSections)) / (kPower4 - kPower2 * kPower2 / kSections);
  const Vec3 mean = (sum - bend * kPower2) / kSections;
  const double t = -middle_depth / kStepMm;
  const Vec3 beside = mean + slope * t + bend * (t * t);
  return face.middle + beside - face.normal * dot(face.normal, beside);
}

}  // namespace

FractureOffset Reduction::offset(
    const Pose<frame::Bone, frame::Bone>& first_from_second) const noexcept {
  const Vec3 way = (first_from_second * Point<frame::Bone>{second_middle}).v - first_middle;
  const double along = dot(way, first_normal);
  const Vec3 normal = first_from_second.rotation * second_normal;
  return {along, length(way - first_normal * along), -dot(normal, first_normal)};
}

Pose<frame::Bone, frame::Bone> Reduction::first_from_second_reduced() const noexcept {
  constexpr double kOpposite = -0.5;  // faces that look the same way belong to no one bone
  const Vec3 wanted = -first_normal;
  const double cosine = dot(second_normal, wanted);
  Mat3 rotation = Mat3::identity();
  if (cosine > kOpposite) {
    // Rodrigues: the least turn that takes one unit vector to another.
    const Vec3 axis = cross(second_normal, wanted);
    const auto turned = [&](const Vec3& v) {
      return v * cosine + cross(axis, v) + axis * (dot(axis, v) / (1.0 + cosine));
    };
    const std::array<Vec3, 3> columns{turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})};
    for (std::size_t r = 0; r < 3; ++r) {
      rotation.rows[r] = {columns[0][r], columns[1][r], columns[2][r]};
    }
  }
  return {rotation, first_middle - rotation * second_middle};
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
  return Reduction{middle_by_sections(first, *a), a->normal, middle_by_sections(second, *b),
                   b->normal};
}

}  // namespace carpus::anatomy
