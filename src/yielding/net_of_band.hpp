// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A net of a band of fibres between two bodies, both of whose ends they hold: a ligament between
// two bones. Whole, attenuated, or torn across its fibres.
#pragma once

#include <optional>
#include <span>

#include "geometry/vec3.hpp"
#include "yielding/net.hpp"

namespace carpus::yielding {

/// A grid of places as scanned: rows of fibres side by side, each from the first body to the
/// second.
struct Band {
  std::size_t rows = 0;           ///< at least 3
  std::size_t columns = 0;        ///< at least 3
  std::span<const Vec3> at;       ///< row by row
  std::span<const Vec3> normals;  ///< unit, towards the side that is touched
};

/// How stiff it is; figures with their marks stand in data.
struct BandMaterial {
  double along_n_per_mm = 0;        ///< of all of it, pulled between its bodies
  double aside_share = 0;           ///< of a spring beside or across the fibres, of one along them
  double tension_n_per_mm = 0;      ///< with which it is drawn, of its width
  double foundation_n_per_mm2 = 0;  ///< of what lies under a mm2
  double mass_g_per_mm2 = 0;        ///< more than it weighs: see SheetMaterial
  double damping_per_s = 0;
  double bulges_mm = 0;  ///< towards the side that is touched, in its middle
};

/// Fibres are torn through along this line as far as it goes; each edge stays with its body.
struct BandTear {
  Vec3 from;
  Vec3 to;
  double left_share = 0;  ///< of what lies under its edges
};

/// Its ends and its first and last fibre are held.
[[nodiscard]] Net net_of_band(const Band& band,
                              const BandMaterial& material,
                              const std::optional<BandTear>& tear = std::nullopt);

/// What its springs bear along the fibres when its bodies part a little and every part of a fibre
/// is drawn alike [N/mm]; between what is held at both ends as between its neighbours.
[[nodiscard]] double along_n_per_mm(const Net& net, const Band& band);

}  // namespace carpus::yielding
