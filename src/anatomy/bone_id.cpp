// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/bone_id.hpp"

namespace carpus {
namespace {

constexpr std::array<std::string_view, kBoneCount> kNames{
    "radius",      "ulna",        "scaphoid",    "lunate",      "triquetrum",
    "pisiform",    "trapezoid",   "trapezium",   "capitate",    "hamate",
    "metacarpal1", "metacarpal2", "metacarpal3", "metacarpal4", "metacarpal5"};
constexpr std::string_view kScaphoidProximal = "scaphoid_proximal";
constexpr std::string_view kScaphoidDistal = "scaphoid_distal";

}  // namespace

std::string_view name_of(BoneId bone, BonePart part) noexcept {
  if (bone == BoneId::Scaphoid && part == BonePart::Proximal) return kScaphoidProximal;
  if (bone == BoneId::Scaphoid && part == BonePart::Distal) return kScaphoidDistal;
  const std::size_t i = static_cast<std::size_t>(bone) - 1;
  return i < kNames.size() ? kNames[i] : std::string_view{"unknown"};
}

std::string_view name_of(Side side) noexcept { return side == Side::Left ? "left" : "right"; }

std::optional<NamedBone> bone_of(std::string_view name) noexcept {
  if (name == kScaphoidProximal) return NamedBone{BoneId::Scaphoid, BonePart::Proximal};
  if (name == kScaphoidDistal) return NamedBone{BoneId::Scaphoid, BonePart::Distal};
  for (const BoneId bone : kAllBones) {
    if (name == name_of(bone)) return NamedBone{bone, BonePart::Whole};
  }
  return std::nullopt;
}

std::optional<Side> side_of(std::string_view name) noexcept {
  if (name == "left") return Side::Left;
  if (name == "right") return Side::Right;
  return std::nullopt;
}

}  // namespace carpus
