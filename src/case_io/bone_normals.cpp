// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/bone_normals.hpp"

#include <algorithm>

#include "mesh/normals.hpp"

namespace carpus::case_io {
namespace {

/// About the CT's point spread: nearer, its noise would be seen.
constexpr double kReachMm = 0.6;
/// Cosine between the CT's normal and the facets', below which the first is another bone's edge.
constexpr double kUnlike = 0.6;
constexpr double kAlike = 0.85;

}  // namespace

std::vector<Vec3> bone_normals(const TriangleMesh& surface,
                               const Pose<frame::Patient, frame::Bone>& patient_from_bone,
                               const GridView<const std::int16_t>& ct) {
  std::vector<Vec3> in_patient;
  in_patient.reserve(surface.vertices.size());
  for (const Vec3& v : surface.vertices) {
    in_patient.push_back((patient_from_bone * Point<frame::Bone>{v}).v);
  }
  const Mat3 bone_from_patient = patient_from_bone.rotation.transposed();
  const std::vector<Vec3> of_ct = mesh::gradient_normals(ct, in_patient, kReachMm);
  std::vector<Vec3> normals = mesh::vertex_normals(surface);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vec3 ct_normal = bone_from_patient * of_ct[i];
    const double alike = dot(ct_normal, normals[i]);
    const double share = std::clamp((alike - kUnlike) / (kAlike - kUnlike), 0.0, 1.0);
    const Vec3 facets = normalized_or(normals[i], {0, 0, 1});
    normals[i] = normalized_or(facets + (ct_normal - facets) * share, facets);
  }
  return normals;
}

}  // namespace carpus::case_io
