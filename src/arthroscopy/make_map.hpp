// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the portals of a case are, and what its diagnostic tour looks at (data/portals.json), on
// its own bones and generated soft tissue.
#pragma once

#include "cases/arthroscopic_map.hpp"
#include "cases/case_data.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::arthroscopy {

/// The radius of a 1.9 mm scope, the slimmest [S82]: a portal with less room is none.
inline constexpr double kLeastRoomMm = 0.95;

/// Portals near their landmarks in their interval between tendons, clear of nerves and arteries as
/// far as there is such a way, where bones, under traction, leave room, tendons are spared and the
/// way leads to what the portal is for; the tour's points on the joint's wall; its cartilage. What
/// cannot be placed is named in `problems` and left out; without any portal the map is empty.
/// @param data  needs side, wrist frame, bones with surfaces and distance fields; without hand
///     motion traction opens nothing.
/// Runs in two to three seconds; the same bits each time.
[[nodiscard]] cases::ArthroscopicMap make_map(const cases::CaseData& data,
                                              const soft_tissue::SoftTissue& tissue);

}  // namespace carpus::arthroscopy
