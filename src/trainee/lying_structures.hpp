// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where tendons, arteries and nerves lie as the wrist is held now: who knows their anatomy goes in
// beside them.
#pragma once

#include <vector>

#include "cases/case_data.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::trainee {

/// A ball of a tube.
struct LyingPoint {
  Vec3 at;  ///< Patient [mm]
  double radius_mm = 0.0;
};

/// All of the case's, along their courses.
[[nodiscard]] std::vector<LyingPoint> structures_now(const cases::CaseData& data,
                                                     const simulation::Snapshot& now);

}  // namespace carpus::trainee
