// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A scaphoid that broke and did not heal: where the fracture runs, how far its faces are worn apart
// and how the distal fragment has tilted. As in the patient of [yaacoub2008]: at the waist,
// irregular, with a gap, sclerotic margins and a slight humpback.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "anatomy/wrist_model.hpp"
#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"

namespace carpus::phantom {

enum class NonunionKind : std::uint8_t { None, Waist, Proximal };

[[nodiscard]] std::string_view name_of(NonunionKind kind) noexcept;
[[nodiscard]] std::optional<NonunionKind> nonunion_of(std::string_view name) noexcept;

/// Frame Wrist of the model, unscaled [mm].
struct Nonunion {
  Vec3 point{};            ///< on the mean fracture plane, on the scaphoid's long axis
  Vec3 normal{};           ///< unit, towards the distal pole
  double gap_mm = 0;       ///< thickness of bone that is lost
  Mat3 rotation{};         ///< of the distal fragment
  Vec3 pivot{};            ///< about which it turned
  Vec3 cyst{};             ///< centre of a small cyst in the proximal fragment
  std::uint64_t seed = 0;  ///< of the faces' relief

  /// Where a point of the displaced distal fragment was before.
  [[nodiscard]] Vec3 undisplaced(const Vec3& p) const noexcept {
    return rotation.transposed() * (p - pivot) + pivot;
  }
  /// Height above the irregular fracture surface, distal positive [mm].
  [[nodiscard]] double height(const Vec3& undisplaced_point) const noexcept;
};

/// The long axis of the model's scaphoid: its centroid and the direction of greatest spread,
/// pointing distally, with the extent along it.
struct LongAxis {
  Vec3 centroid;
  Vec3 direction;    ///< unit, towards the distal pole
  double least = 0;  ///< of direction . (p - centroid) in the bone [mm], the proximal pole
  double greatest = 0;
  double waist = 0;  ///< the same coordinate where the bone's section is smallest
};
[[nodiscard]] LongAxis scaphoid_axis(const anatomy::WristModel& model);

/// The nonunion of that kind; `kind` is not None.
[[nodiscard]] Nonunion make_nonunion(const anatomy::WristModel& model,
                                     NonunionKind kind,
                                     std::uint64_t seed);

}  // namespace carpus::phantom
