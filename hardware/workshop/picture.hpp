// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Pieces drawn as a drawing for a workshop: in perspective, lit with a shadow, edges inked, new
// pieces in colour and the rest pale, numbers at what is meant. No display, the same bytes always.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hardware/workshop/assembly.hpp"

namespace carpus::hardware {

struct Drawn {
  const Piece* piece = nullptr;
  bool is_pale = false;
  Vec3 shift;  ///< out of its place, for exploded views
};

/// A number, at the middle of what is seen of a piece.
struct Callout {
  int number = 0;
  std::size_t drawn = 0;  ///< which of the drawn
};

struct Camera {
  /// Towards the viewer: degrees round from +x, and above the horizon.
  double around_deg = 35;
  double above_deg = 22;
  /// Smaller sees more; 1 is all of the pieces.
  double zoom = 1;
  Vec3 shift;
  int width = 880;
  int height = 660;
};

/// The bytes of a PNG of up to 256 colours.
/// @throws InvalidInput where nothing is seen of a piece that has a number.
[[nodiscard]] std::string draw_picture(std::span<const Drawn> drawn,
                                       std::span<const Callout> callouts,
                                       const Camera& camera);

}  // namespace carpus::hardware
