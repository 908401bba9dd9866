// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/bone_words.hpp"

#include <array>
#include <cstddef>

namespace carpus {

std::string_view words_of(BoneId bone, BonePart part) noexcept {
  static constexpr std::array<std::string_view, 5> kMetacarpals{
      "first metacarpal", "second metacarpal", "third metacarpal", "fourth metacarpal",
      "fifth metacarpal"};
  if (bone == BoneId::Scaphoid && part == BonePart::Proximal) {
    return "proximal part of the scaphoid";
  }
  if (bone == BoneId::Scaphoid && part == BonePart::Distal) return "distal part of the scaphoid";
  const auto first = static_cast<std::size_t>(BoneId::Metacarpal1);
  const auto i = static_cast<std::size_t>(bone);
  if (i >= first && i - first < kMetacarpals.size()) return kMetacarpals[i - first];
  return name_of(bone, part);
}

}  // namespace carpus
