// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The wrist as five rigid bodies, of which the forearm stays: what the benches of soft tissue move
// (traction.hpp, sectioning.hpp). Frame Patient [mm, N].
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "anatomy/bone_id.hpp"
#include "cases/case_data.hpp"
#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"

namespace carpus::soft_tissue::detail {

inline constexpr std::size_t kBodies = 5;
inline constexpr std::size_t kForearm = 0;
inline constexpr std::size_t kScaphoid = 1;
inline constexpr std::size_t kLunate = 2;
inline constexpr std::size_t kTriquetrum = 3;  ///< with pisiform
inline constexpr std::size_t kHand = 4;        ///< distal row and metacarpals

[[nodiscard]] std::size_t body_of(BoneId bone) noexcept;
/// On the disc's ligaments, which have no bone's label, the forearm.
[[nodiscard]] std::size_t body_of_label(const cases::CaseData& data, std::uint8_t label) noexcept;

/// Turned about its middle as scanned, then shifted.
struct PlacedBody {
  Mat3 rotation;
  Vec3 middle;
  Vec3 shift;
  [[nodiscard]] Vec3 at(const Vec3& scanned) const noexcept {
    return rotation * (scanned - middle) + middle + shift;
  }
  [[nodiscard]] Vec3 scanned(const Vec3& at) const noexcept {
    return rotation.transposed() * (at - middle - shift) + middle;
  }
};
using Bodies = std::array<PlacedBody, kBodies>;

/// As scanned. A body's middle is that of its carpal bones' vertices.
[[nodiscard]] Bodies bodies_as_scanned(const cases::CaseData& data);

/// Energy [N mm] and its downhill gradient: forces [N] and moments about the middles [N mm].
struct Load {
  double energy = 0;
  std::array<Vec3, kBodies> force;
  std::array<Vec3, kBodies> moment;

  void push(const Bodies& bodies, std::size_t body, const Vec3& at, const Vec3& newtons) noexcept {
    force[body] += newtons;
    moment[body] += cross(at - bodies[body].middle - bodies[body].shift, newtons);
  }
};

}  // namespace carpus::soft_tissue::detail
