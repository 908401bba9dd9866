// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The bones of the wrist, the parts of a broken scaphoid, and the side of the body.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace carpus {

/// The fifteen bones that a wrist CT shows. The numbers are the labels of a case's label volume.
enum class BoneId : std::uint8_t {
  Radius = 1,
  Ulna = 2,
  Scaphoid = 3,
  Lunate = 4,
  Triquetrum = 5,
  Pisiform = 6,
  Trapezoid = 7,
  Trapezium = 8,
  Capitate = 9,
  Hamate = 10,
  Metacarpal1 = 11,
  Metacarpal2 = 12,
  Metacarpal3 = 13,
  Metacarpal4 = 14,
  Metacarpal5 = 15,
};
inline constexpr std::size_t kBoneCount = 15;

/// All bones in the order of their numbers.
inline constexpr std::array<BoneId, kBoneCount> kAllBones{
    BoneId::Radius,      BoneId::Ulna,        BoneId::Scaphoid,    BoneId::Lunate,
    BoneId::Triquetrum,  BoneId::Pisiform,    BoneId::Trapezoid,   BoneId::Trapezium,
    BoneId::Capitate,    BoneId::Hamate,      BoneId::Metacarpal1, BoneId::Metacarpal2,
    BoneId::Metacarpal3, BoneId::Metacarpal4, BoneId::Metacarpal5};

/// A whole bone, or one of the two parts of a broken scaphoid.
enum class BonePart : std::uint8_t { Whole = 0, Proximal = 1, Distal = 2 };

/// Labels of a case's label volume: 1 to 15 are BoneId; in a broken scaphoid 3 is the proximal
/// part.
inline constexpr std::uint8_t kBackgroundLabel = 0;
inline constexpr std::uint8_t kScaphoidDistalLabel = 16;
inline constexpr std::uint8_t kFractureGapLabel =
    17;  ///< gap tissue; not a bone, ground truth only

enum class Side : std::uint8_t { Left = 0, Right = 1 };

/// "scaphoid"; with a part, "scaphoid_proximal". As in case folders, JSON and the protocol.
[[nodiscard]] std::string_view name_of(BoneId bone, BonePart part = BonePart::Whole) noexcept;
[[nodiscard]] std::string_view name_of(Side side) noexcept;

/// Inverse of name_of; empty where the name is unknown.
struct NamedBone {
  BoneId bone;
  BonePart part;
  constexpr bool operator==(const NamedBone&) const = default;
};
[[nodiscard]] std::optional<NamedBone> bone_of(std::string_view name) noexcept;
[[nodiscard]] std::optional<Side> side_of(std::string_view name) noexcept;

/// Radius and ulna, which stay with the forearm when the hand moves.
[[nodiscard]] constexpr bool belongs_to_forearm(BoneId bone) noexcept {
  return bone == BoneId::Radius || bone == BoneId::Ulna;
}

}  // namespace carpus
