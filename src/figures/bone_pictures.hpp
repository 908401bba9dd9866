// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A case's bones drawn: the whole wrist and single bones, as figures 3.6, 3.7, 3.10, 3.11, 4.4, 4.5
// and 5.2 of the thesis [yaacoub2008] show them. SVG; bones are thinned to what a picture needs.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "drawing/svg.hpp"
#include "geometry/predicates.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::figures {

/// A surface with few enough facets to be drawn, in frame Wrist turned so that +x is to the right
/// of one who looks at the back of the hand, +y towards the palm and +z towards the fingers [mm].
struct DrawnBone {
  BoneId bone = BoneId::Radius;
  TriangleMesh surface;  ///< of a broken bone all parts
  /// By facet: the colour of its middle in the bone's bitmap (case_io/bone_bitmap.hpp).
  std::vector<drawing::Colour> texture;
};

/// The bones of a case, broken ones in one piece of drawing, in the order of BoneId.
/// @param most_error_mm  how far thinning may move a surface.
[[nodiscard]] std::vector<DrawnBone> drawn_bones(const cases::CaseData& data,
                                                 double most_error_mm = 0.1);

/// About `count` of its corners as one sees them from the back of the hand, x to the right and y
/// towards the fingers [mm]; evenly taken from the surface's list.
[[nodiscard]] std::vector<Vec2> outline_points(const DrawnBone& bone, std::size_t count);

enum class WristSide { Dorsal, Volar };
enum class Facets { Shaded, Outlined, Textured };

/// The whole wrist from behind (dorsal) or from the palm, fingers up.
/// @param marked  null, or a bone that a red arrow points at and that stands out in colour.
[[nodiscard]] std::string draw_wrist(const std::vector<DrawnBone>& bones,
                                     WristSide side,
                                     Facets facets = Facets::Shaded,
                                     const BoneId* marked = nullptr);

/// Figure 3.8: the bone's bitmap with the outline of one of its facets, and the same facet on the
/// bone.
[[nodiscard]] std::string draw_texture_mapping(const cases::Bone& bone,
                                               const GridView<const std::int16_t>& ct);

/// A row for each: the bone to the left, its convex hull to the right, at one scale.
[[nodiscard]] std::string draw_bones_and_hulls(const std::vector<const DrawnBone*>& bones,
                                               Facets facets = Facets::Shaded);

/// Each within its hull, lettered (a), (b), ... in the order given, in rows of four.
[[nodiscard]] std::string draw_bones_in_hulls(const std::vector<const DrawnBone*>& bones);

}  // namespace carpus::figures
