// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From the field's contact to the triangles': the exact gap, point and normal of the ball that the
// field found.
#pragma once

#include "contact/instrument_contact.hpp"
#include "fields/contact_field.hpp"
#include "fields/triangle_tree.hpp"
#include "geometry/instrument_shape.hpp"
#include "geometry/pose.hpp"

namespace carpus::contact {

/// Moves a Near or Touching contact onto the triangles: `point` is the point of the surface nearest
/// to the ball's centre, `normal` the direction between the two, out of the bone, and gap_mm and
/// highest_gap_mm the ball's exact gap, which no true gap exceeds; lowest_gap_mm stays. The outcome
/// follows gap_mm, the patch is dropped if the ball turns out not to touch. `steepness` stays the
/// field's.
///
/// @param tree  over the surface of which `field` is the field, same frame.
/// @return false, and the contact is as it was, for any other outcome, and where the centre is
///     within field.error_mm() of the surface by the field, so that its side is not proved.
/// Real-time: no allocation, only + - * / and sqrt. Cost: one search of the tree.
bool put_on_triangles(const fields::TriangleTree& tree,
                      const fields::ContactField& field,
                      const InstrumentShape& shape,
                      const Pose<frame::Bone, frame::Tool>& bone_from_tool,
                      SurfaceContact& contact) noexcept;

}  // namespace carpus::contact
