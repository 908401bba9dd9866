// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Cartilage where bones, and the disc, face each other.
#pragma once

#include <vector>

#include "soft_tissue/detail/sheet.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::soft_tissue::detail {

/// One entry a bone of the case that has any, carpal bones and forearm only. Faces count that meet
/// in the scan or in one of the table's postures; none grows under a ligament, and two layers never
/// fill more than the joint. Where a broken bone's pieces lie apart faces and thickness are those
/// of the bone with its fracture faces met, and the body is pressed into what room there is now.
/// @param disc  closed; may be empty.
[[nodiscard]] std::vector<Cartilage> lay_cartilage(const TabledCartilage& tabled,
                                                   double size,
                                                   const Surroundings& bones,
                                                   const TriangleMesh& disc,
                                                   const std::vector<Sheet>& ligaments);

/// The closed sheet between the surface and the surface raised by `thickness` along its normals,
/// where `level` is above 0, with a smooth edge: facets are cut where it passes 0. Empty where it
/// never is.
[[nodiscard]] TriangleMesh raised_sheet(const TriangleMesh& surface,
                                        const std::vector<double>& level,
                                        const std::vector<float>& thickness);

}  // namespace carpus::soft_tissue::detail
