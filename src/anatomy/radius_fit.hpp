// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Lays the model's radius on a patient's, which fixes the wrist's coordinate system.
#pragma once

#include <span>

#include "anatomy/bone_id.hpp"
#include "anatomy/similarity_fit.hpp"
#include "geometry/vec3.hpp"

namespace carpus::anatomy {

struct RadiusFit {
  Similarity patient_from_model;
  double rms_mm = 0;  ///< of the distances that took part
  std::size_t points_used = 0;
};

/// Improves `start` so that `border` (points on the patient's radius, Patient frame [mm]) lies on
/// the generic radius of that side: least squares of its implicit function by Gauss-Newton over
/// rotation, translation and scale (0.7 to 1.4), with Huber weights beyond 1 mm. Points past the
/// model's cut do not count, so a longer shaft does no harm. Source: [fitzgibbon2003robust].
[[nodiscard]] RadiusFit fit_radius(std::span<const Vec3> border,
                                   Side side,
                                   const Similarity& start);

}  // namespace carpus::anatomy
