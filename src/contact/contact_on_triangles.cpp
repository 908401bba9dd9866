// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "contact/contact_on_triangles.hpp"

#include <cmath>

namespace carpus::contact {

bool put_on_triangles(const fields::TriangleTree& tree,
                      const fields::ContactField& field,
                      const InstrumentShape& shape,
                      const Pose<frame::Bone, frame::Tool>& bone_from_tool,
                      SurfaceContact& contact) noexcept {
  const bool is_near =
      contact.outcome == ContactOutcome::Near || contact.outcome == ContactOutcome::Touching;
  if (!is_near) return false;
  const double radius = shape.radius_at(contact.z_mm);
  const double sample = contact.gap_mm + radius;
  if (!(std::abs(sample) > field.error_mm())) return false;
  const double side = sample > 0 ? 1 : -1;

  const Vec3 centre = (bone_from_tool * Point<frame::Tool>{{0, 0, contact.z_mm}}).v;
  // The distance is within the field's error of the sample; the rest is for rounding.
  const auto nearest = tree.nearest(centre, std::abs(sample) + 1.01 * field.error_mm());
  if (!nearest || !(nearest->squared_distance > 0)) return false;
  const double distance = std::sqrt(nearest->squared_distance);
  contact.point = {nearest->point};
  contact.normal = {(centre - nearest->point) * (side / distance)};
  contact.gap_mm = side * distance - radius;
  contact.highest_gap_mm = contact.gap_mm;
  contact.outcome = contact.gap_mm > 0 ? ContactOutcome::Near : ContactOutcome::Touching;
  if (contact.outcome == ContactOutcome::Near) contact.patch = {};
  return true;
}

}  // namespace carpus::contact
