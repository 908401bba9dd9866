// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/material_table.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "core/check.hpp"

namespace carpus::data {
std::string_view materials();
}

namespace carpus::anatomy {
namespace {

constexpr std::array<std::pair<Tissue, std::string_view>, 5> kTissues{{
    {Tissue::Bone, "bone"},
    {Tissue::Skin, "skin"},
    {Tissue::Tendon, "tendon"},
    {Tissue::Artery, "artery"},
    {Tissue::Nerve, "nerve"},
}};

std::array<Material, kTissues.size()> read() {
  const auto json = nlohmann::json::parse(data::materials());
  std::array<Material, kTissues.size()> all;
  CARPUS_CHECK(json.at("materials").size() == all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& from = json.at("materials").at(i);
    Material& m = all[i];
    m.tissue = kTissues[i].first;
    from.at("tissue").get_to(m.name);
    CARPUS_CHECK(m.name == kTissues[i].second);
    from.at("diffuse").get_to(m.diffuse);
    from.at("emissive").get_to(m.emissive);
    from.at("specular").get_to(m.specular);
    from.at("ambient").get_to(m.ambient);
    from.at("shininess").get_to(m.shininess);
    from.at("transparency").get_to(m.transparency);
  }
  return all;
}

}  // namespace

std::span<const Material> materials() {
  static const auto kMaterials = read();
  return kMaterials;
}

const Material& material_of(Tissue tissue) { return materials()[static_cast<std::size_t>(tissue)]; }

double roughness_of(const Material& material) noexcept {
  const double exponent = 128 * material.shininess;
  return std::sqrt(std::sqrt(2 / (exponent + 2)));
}

}  // namespace carpus::anatomy
