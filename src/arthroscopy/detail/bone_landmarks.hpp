// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a finger feels of the forearm's bones: portals are measured from there.
#pragma once

#include <string>
#include <vector>

#include "arthroscopy/detail/wrist_axes.hpp"
#include "cases/case_data.hpp"
#include "geometry/vec3.hpp"

namespace carpus::arthroscopy::detail {

struct Landmark {
  std::string id;  ///< as in TabledPortal::from
  Vec3 at;         ///< in the frame of the generic wrist
};

/// Lister's tubercle, then the styloids; none where there is no tubercle to be felt.
[[nodiscard]] std::vector<Landmark> bone_landmarks(const cases::CaseData& data,
                                                   const WristAxes& axes);

}  // namespace carpus::arthroscopy::detail
