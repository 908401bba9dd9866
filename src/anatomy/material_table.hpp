// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How tissues look: materials of six fields, as the thesis has them (§3.4) [yaacoub2008], from
// data/materials.json.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace carpus::anatomy {

enum class Tissue : std::uint8_t { Bone, Skin, Tendon, Artery, Nerve };

/// Of light that falls on a surface. Colours are red, green, blue, sRGB, 0 to 1.
struct Material {
  Tissue tissue = Tissue::Bone;
  std::string name;                ///< as in files: "bone"
  std::array<double, 3> diffuse;   ///< of the tissue itself
  std::array<double, 3> emissive;  ///< that it sends out unlit
  std::array<double, 3> specular;  ///< of its shiny spots
  double ambient = 0;              ///< share of the light from everywhere that is given back
  double shininess = 0;            ///< 0 soft and wide to 1 small and sharp
  double transparency = 0;         ///< 0 opaque to 1 clear
};

/// All, in the order of Tissue.
[[nodiscard]] std::span<const Material> materials();
[[nodiscard]] const Material& material_of(Tissue tissue);

/// The same for a renderer with microfacets: the Blinn-Phong exponent 128 * shininess as GGX's
/// width, alpha^2 = 2 / (exponent + 2) [walter2007microfacet], and roughness = sqrt(alpha), as glTF
/// has it.
[[nodiscard]] double roughness_of(const Material& material) noexcept;

}  // namespace carpus::anatomy
