// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A bone's own bitmap: what lies under each spot of its surface in the CT, with a grain.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "mesh/texture_atlas.hpp"

namespace carpus::case_io {

/// A bitmap of 256 colours, as the thesis's figure 3.8 has one [yaacoub2008], and where it lies on
/// the bone.
struct BoneBitmap {
  mesh::TextureAtlas atlas;
  std::vector<std::uint8_t> texels;  ///< atlas.side squared, row by row from the top
  /// Of a texel: what the bone's diffuse colour is multiplied with, sRGB.
  [[nodiscard]] static std::span<const std::array<std::uint8_t, 3>> palette();
  [[nodiscard]] std::string png() const;
};

/// Dense bone under the surface is pale, porous bone darker and redder; over it the grain of bone,
/// three octaves of noise in the bone's own mm. Where the CT does not reach it counts as dense.
/// @param side  texels of the bitmap's side.
/// @throws InvalidInput for a bone without a surface.
[[nodiscard]] BoneBitmap make_bone_bitmap(const cases::Bone& bone,
                                          const GridView<const std::int16_t>& ct,
                                          int side = 256);

}  // namespace carpus::case_io
