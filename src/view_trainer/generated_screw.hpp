// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Screws that a surgeon might have placed, well or badly, for a study and a quiz.
#pragma once

#include <cstdint>

#include "view_trainer/scaphoid_surface.hpp"

namespace carpus::view_trainer {

struct GeneratedScrew {
  PlacedScrew placed;
  Protrusion truth;

  [[nodiscard]] bool is_out() const noexcept { return truth.depth_mm > kOutMm; }
};

/// Farthest out, and most bone before an end [mm].
inline constexpr double kFarthestOutMm = 2.5;
inline constexpr double kBestCoveredMm = 2.5;

/// The screw of a seed: one of the catalogue, from dorsal or volar, along a line whose ends lie
/// within 2 mm of those of an axis between the central one and the longest line. Every other seed's
/// is out, at its distal end, its proximal end or its side, each as often, by kOutMm to
/// kFarthestOutMm, evenly, and nowhere farther; the others are in, with 0 to kBestCoveredMm of bone
/// before one end. Where no line of many allows that, as in an angulated bone, the screw is on the
/// other side. The same seed gives the same screw.
/// @throws InvalidInput where no screw fits this scaphoid.
[[nodiscard]] GeneratedScrew generate_screw(const ScaphoidSurface& scaphoid, std::uint64_t seed);

}  // namespace carpus::view_trainer
