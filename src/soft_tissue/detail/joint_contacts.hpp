// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Joint surfaces that push: samples of a bone's surface against another body's distance field.
#pragma once

#include <span>
#include <vector>

#include "cases/case_data.hpp"
#include "fields/distance_field.hpp"
#include "soft_tissue/detail/wrist_bodies.hpp"

namespace carpus::soft_tissue::detail {

struct Contact {
  std::size_t body = 0;
  Vec3 point;  ///< as scanned
  std::size_t other_body = 0;
  const Grid<float>* other = nullptr;
  double least_mm = 0;  ///< pushes where nearer
  double stiffness_n_per_mm = 0;
  double room_mm = 0;  ///< beyond least_mm, as the bodies lay when it was found
};

struct ContactOptions {
  /// Surfaces push where they come nearer than in the scan, or than this [mm].
  double least_mm = 0.6;
  double stiffness_n_per_mm = 40;  ///< of one sample [E]; a joint has tens
  std::size_t samples = 260;       ///< a bone
  double near_mm = 3;              ///< as the bodies lie: what is farther cannot touch
};

/// @param data  needs distance fields, which the contacts point to.
/// @param bodies  as they lie: only what is near there is taken.
[[nodiscard]] std::vector<Contact> make_contacts(const cases::CaseData& data,
                                                 const Bodies& bodies,
                                                 const ContactOptions& options);

/// How deep, and the way out [mm/mm] as scanned by the other body; depth 0 where nothing pushes.
struct Pressing {
  double depth_mm = 0;
  Vec3 at;
  Vec3 out;  ///< turned with the other body, not normalised
};
[[nodiscard]] inline Pressing pressing_of(const Contact& c, const Bodies& bodies) noexcept {
  const Vec3 at = bodies[c.body].at(c.point);
  const fields::DistanceSample near =
      fields::sample_distance(*c.other, bodies[c.other_body].scanned(at));
  const double depth = c.least_mm - near.distance_mm;
  if (!near.is_inside_grid || depth <= 0) return {};
  return {depth, at, bodies[c.other_body].rotation * near.gradient};
}

/// The contacts' energy and push, added.
void push_contacts(std::span<const Contact> contacts, const Bodies& bodies, Load& load) noexcept;

}  // namespace carpus::soft_tissue::detail
