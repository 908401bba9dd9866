// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the beam's geometry makes of a scaphoid and of a screw on a picture.
#pragma once

#include "fluoroscopy/metal.hpp"
#include "view_trainer/outline_map.hpp"
#include "view_trainer/scaphoid_surface.hpp"
#include "view_trainer/standard_views.hpp"

namespace carpus::view_trainer {

/// The scaphoid's shadow: all of its triangles as the point source projects them, each fragment
/// where it lies, and the bridged gap of a broken one. Reaches kAroundMm beyond the bone.
inline constexpr double kAroundMm = 7.0;
[[nodiscard]] OutlineMap silhouette_of(const ScaphoidSurface& scaphoid, const PosedView& view);

/// The convex outline of a screw's envelope on the picture.
[[nodiscard]] Polygon screw_outline(const PlacedScrew& placed, const PosedView& view);

/// Of the part of it between two heights from its tip [mm].
[[nodiscard]] Polygon screw_part_outline(const PlacedScrew& placed,
                                         double from_mm,
                                         double to_mm,
                                         const PosedView& view);

/// The convex outline of a rod of metal.
[[nodiscard]] Polygon rod_outline(const fluoroscopy::MetalCylinder& rod,
                                  const fluoroscopy::CArmPose& c_arm);

}  // namespace carpus::view_trainer
