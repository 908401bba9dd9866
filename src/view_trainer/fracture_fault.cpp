// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "view_trainer/fracture_fault.hpp"

#include <algorithm>
#include <cmath>

namespace carpus::view_trainer {

double clear_gap_mm(const FractureFault& fault, const Vec3& ray) noexcept {
  const double along = std::min(1.0, std::abs(dot(fault.normal, ray)));
  return fault.gap_mm() * std::sqrt(1.0 - along * along) - kFaceAcrossMm * along;
}

double seen_step_mm(const FractureFault& fault, const Vec3& ray) noexcept {
  return length(cross(fault.step(), ray));
}

}  // namespace carpus::view_trainer
