// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Lays a bone of the model on a patient's: the radius fixes the wrist's coordinate system, others
// carry what lies on them.
#pragma once

#include <span>

#include "anatomy/bone_id.hpp"
#include "anatomy/similarity_fit.hpp"
#include "geometry/vec3.hpp"

namespace carpus::anatomy {

struct BoneFit {
  Similarity patient_from_model;
  double rms_mm = 0;  ///< of the distances that took part
  std::size_t points_used = 0;
};

/// Improves `start` so that `border` (points on the patient's bone, Patient frame [mm]) lies on the
/// generic bone of that side: least squares of its implicit function by Gauss-Newton over
/// rotation, translation and scale (0.7 to 1.4), with Huber weights beyond 1 mm. Points past the
/// model's cut do not count, so a longer shaft does no harm. Source: [fitzgibbon2003robust].
[[nodiscard]] BoneFit fit_bone(BoneId bone,
                               std::span<const Vec3> border,
                               Side side,
                               const Similarity& start);

}  // namespace carpus::anatomy
