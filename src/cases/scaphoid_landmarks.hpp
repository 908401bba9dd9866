// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The scaphoid's landmarks, which the score measures against (docs/scoring.md).
#pragma once

#include <optional>
#include <span>

#include "cases/case_data.hpp"

namespace carpus::cases {

/// Central axis, waist and longest line of the scaphoid as scanned, whole or in two fragments.
/// Uses `bones` and `wrist_from_patient`; deterministic, about 1 s.
/// @throws InvalidInput when the case has no scaphoid, or one through which no line can be drawn.
[[nodiscard]] ScaphoidLandmarks find_scaphoid_landmarks(const CaseData& data);

/// The same of pieces as they lie, in their frame. Nothing where no line can be drawn through them.
/// @param towards_proximal  in that frame.
[[nodiscard]] std::optional<ScaphoidLandmarks> find_scaphoid_landmarks(
    std::span<const MeshIn<frame::Bone>* const> pieces,
    const Vec3& towards_proximal);

/// Direction in Patient of the wrist's proximal side (unit vector).
[[nodiscard]] Vec3 proximal_direction(const CaseData& data) noexcept;

}  // namespace carpus::cases
