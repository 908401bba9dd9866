// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the beam's geometry makes of a scaphoid and of a screw on a picture.
#pragma once

#include "view_trainer/outline_map.hpp"
#include "view_trainer/scaphoid_surface.hpp"
#include "view_trainer/standard_views.hpp"

namespace carpus::view_trainer {

/// The scaphoid's shadow: all of its triangles as the point source projects them, and the bridged
/// gap of a broken one. Reaches kAroundMm beyond the bone.
inline constexpr double kAroundMm = 7.0;
[[nodiscard]] OutlineMap silhouette_of(const ScaphoidSurface& scaphoid, const PosedView& view);

/// The convex outline of a screw's envelope on the picture.
[[nodiscard]] Polygon screw_outline(const PlacedScrew& placed, const PosedView& view);

}  // namespace carpus::view_trainer
