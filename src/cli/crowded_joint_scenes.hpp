// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Ticks of a joint in which as much happens at once as two hands can bring about: what is dearest.
#pragma once

#include <cstddef>
#include <vector>

#include "cases/case_data.hpp"
#include "cli/tick_scenes.hpp"
#include "procedure/procedure.hpp"

namespace carpus::cli {

/// Under a traction of 69 N and more that sways, with the fluid that the procedure declares: where
/// a torn disc is trimmed `all_shaving` (a shaver runs in the disc and takes it away, disc and a
/// ligament yield, the scope is in contact), `bite` (ticks in which a punch takes something off)
/// and `about_a_bite` (from 20 ticks before to 100 after); in an examination with much wrong
/// `all_probing` (disc and a ligament yield, scope and probe are in contact) and `interval_probed`
/// (the probe in contact in and about a torn ligament's interval, from the midcarpal joint); none
/// elsewhere.
/// @param ticks  measured a scene, at most.
/// @throws InvalidInput  where the case has no soft tissue, or hands do not come to it there.
[[nodiscard]] std::vector<SceneTimes> time_crowded_joints(const cases::CaseData& data,
                                                          const procedure::Procedure& procedure,
                                                          std::size_t ticks);

}  // namespace carpus::cli
