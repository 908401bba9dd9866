// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/detail/joint_contacts.hpp"

#include <algorithm>

#include "geometry/aabb.hpp"

namespace carpus::soft_tissue::detail {
namespace {

/// Of a field between voxels against the true distance [mm].
constexpr double kFieldErrorMm = 1;

}  // namespace

std::vector<Contact> make_contacts(const cases::CaseData& data,
                                   const Bodies& bodies,
                                   const ContactOptions& options) {
  std::vector<Contact> contacts;
  std::vector<Aabb> boxes;
  for (const cases::Bone& b : data.bones) {
    boxes.push_back(bounds_of(b.surface.vertices).grown(options.near_mm + kFieldErrorMm));
  }
  for (const cases::Bone& a : data.bones) {
    if (a.bone > BoneId::Hamate) continue;
    const std::size_t every = std::max<std::size_t>(1, a.surface.vertices.size() / options.samples);
    for (const cases::Bone& b : data.bones) {
      if (b.bone > BoneId::Hamate || body_of(a.bone) == body_of(b.bone)) continue;
      const PlacedBody& body = bodies[body_of(a.bone)];
      const PlacedBody& other = bodies[body_of(b.bone)];
      const Aabb& near = boxes[static_cast<std::size_t>(&b - data.bones.data())];
      for (std::size_t v = 0; v < a.surface.vertices.size(); v += every) {
        const Vec3& p = a.surface.vertices[v];
        const Vec3 at = other.scanned(body.at(p));
        if (!near.contains(at)) continue;
        const fields::DistanceSample now = fields::sample_distance(b.distance_field, at);
        if (!now.is_inside_grid || now.distance_mm > options.near_mm) continue;
        const fields::DistanceSample scan = fields::sample_distance(b.distance_field, p);
        const double least =
            scan.is_inside_grid ? std::min(options.least_mm, scan.distance_mm) : options.least_mm;
        contacts.push_back({body_of(a.bone), p, body_of(b.bone), &b.distance_field, least,
                            options.stiffness_n_per_mm, now.distance_mm - least});
      }
    }
  }
  return contacts;
}

void push_contacts(std::span<const Contact> contacts, const Bodies& bodies, Load& load) noexcept {
  for (const Contact& c : contacts) {
    const Pressing pressing = pressing_of(c, bodies);
    if (!(pressing.depth_mm > 0)) continue;
    load.energy += 0.5 * c.stiffness_n_per_mm * pressing.depth_mm * pressing.depth_mm;
    const Vec3 force = pressing.out * (c.stiffness_n_per_mm * pressing.depth_mm);
    load.push(bodies, c.body, pressing.at, force);
    load.push(bodies, c.other_body, pressing.at, -force);
  }
}

}  // namespace carpus::soft_tissue::detail
