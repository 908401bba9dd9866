// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is wrong with a screw as it was placed, part by part, and what a view shows of each.
#pragma once

#include <string>
#include <vector>

#include "view_trainer/outline_map.hpp"
#include "view_trainer/scaphoid_surface.hpp"
#include "view_trainer/standard_views.hpp"

namespace carpus::view_trainer {

/// A part of a screw that is out of the bone by more than kOutMm.
struct PlacementFault {
  Region region = Region::Side;
  double depth_mm = 0.0;  ///< greatest distance to the outer surface
  double from_mm = 0.0;   ///< stretch of the screw that it is looked for in, from the tip
  double to_mm = 0.0;
  std::string towards;  ///< the bone beside it, in words; empty where none is near
};

/// By end and side, worst first: a screw that is too long may be out at both ends.
[[nodiscard]] std::vector<PlacementFault> faults_of(const ScaphoidSurface& scaphoid,
                                                    const PlacedScrew& placed);

/// How far that part of the screw stands out of the bone's true outline on a picture [mm].
[[nodiscard]] double overhang_of(const PlacementFault& fault,
                                 const PlacedScrew& placed,
                                 const OutlineMap& bone,
                                 const PosedView& view);

}  // namespace carpus::view_trainer
