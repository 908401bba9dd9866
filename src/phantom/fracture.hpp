// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A scaphoid that broke: where the fracture runs, how far its faces stand apart and how the distal
// fragment lies. Fresh fractures in place are one bone with a lucent line, as CT and film show
// them; displaced ones and nonunions are two bodies. The nonunion is that of the patient of
// [yaacoub2008]: at the waist, irregular, with a gap, sclerotic margins and a slight humpback.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "anatomy/wrist_model.hpp"
#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"

namespace carpus::phantom {

enum class FractureKind : std::uint8_t {
  None,
  Waist,         ///< fresh, in place, visible on film
  ProximalPole,  ///< the same through the proximal pole
  DistalThird,   ///< the same through the distal third
  Displaced,     ///< fresh, at the waist, with a step and a gap
  Humpback,      ///< an old nonunion of the waist: much flexed, volar bone lost, a cyst
  Nonunion,      ///< of the waist, worn apart, slightly flexed
  ProximalNonunion,
};
inline constexpr std::array<FractureKind, 8> kAllFractureKinds{
    FractureKind::None,        FractureKind::Waist,           FractureKind::ProximalPole,
    FractureKind::DistalThird, FractureKind::Displaced,       FractureKind::Humpback,
    FractureKind::Nonunion,    FractureKind::ProximalNonunion};

/// "none", "waist", "proximal_pole", ...
[[nodiscard]] std::string_view name_of(FractureKind kind) noexcept;
[[nodiscard]] std::optional<FractureKind> fracture_of(std::string_view name) noexcept;

/// Frame Wrist of the model, unscaled [mm].
struct Fracture {
  Vec3 point{};             ///< on the mean fracture plane, on the scaphoid's long axis
  Vec3 normal{};            ///< unit, towards the distal pole
  double gap_mm = 0;        ///< from face to face, along the normal
  double lost_mm = 0;       ///< of it, thickness of bone that is lost; a fresh fragment moved away
  double least_gap_mm = 0;  ///< where the fragments would come closer they wore each other away
  bool is_apart = false;    ///< two bodies; otherwise one, with a lucent line through it
  bool is_old = false;      ///< sclerotic margins
  Mat3 rotation{};          ///< of the distal fragment
  Vec3 pivot{};             ///< about which it turned
  Vec3 shift{};             ///< which it made after that
  Vec3 cyst{};              ///< centre of a cyst in the proximal fragment
  double cyst_radius_mm = 0;
  double gap_hounsfield = 0;    ///< mean, of what fills the gap
  double relief_coarse_mm = 0;  ///< of the faces
  double relief_fine_mm = 0;
  std::uint64_t seed = 0;  ///< of the faces' relief

  /// Where a point of the displaced distal fragment was before.
  [[nodiscard]] Vec3 undisplaced(const Vec3& p) const noexcept {
    return rotation.transposed() * (p - shift - pivot) + pivot;
  }
  /// Height above the irregular fracture surface, distal positive [mm].
  [[nodiscard]] double height(const Vec3& undisplaced_point) const noexcept;

  /// How much of the bone is gone at a point of a bone broken in place: 0 beside the line, nearly 1
  /// on it, less where the faces still touch.
  [[nodiscard]] double lost_share(const Vec3& p) const noexcept;
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

/// The fracture of that kind; `kind` is not None.
[[nodiscard]] Fracture make_fracture(const anatomy::WristModel& model,
                                     FractureKind kind,
                                     std::uint64_t seed);

}  // namespace carpus::phantom
