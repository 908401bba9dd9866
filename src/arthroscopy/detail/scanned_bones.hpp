// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How far a case's bones are as they were scanned.
#pragma once

#include <cstdint>

#include "anatomy/bone_id.hpp"
#include "cases/case_data.hpp"
#include "geometry/vec3.hpp"

namespace carpus::arthroscopy::detail {

/// What is farther away is told as being so far.
inline constexpr double kFarMm = 4.0;

/// The body nearest to a point; the first where none is near.
[[nodiscard]] std::uint8_t nearest_body(const cases::CaseData& data, const Vec3& point);

/// To the nearest part of a bone; kFarMm where it is farther or missing.
[[nodiscard]] double distance_mm_to(const cases::CaseData& data, BoneId id, const Vec3& point);

}  // namespace carpus::arthroscopy::detail
