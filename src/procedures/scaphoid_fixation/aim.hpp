// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cases/case_data.hpp"
#include "procedure/situation.hpp"
#include "procedures/scaphoid_fixation/placement.hpp"

namespace carpus::procedures::scaphoid_fixation {

/// What a fixation is after: the central axis, in at the approach's end; of a bone that is to be
/// reduced that of the bone reduced (CaseData::reduced). An entry is right within a third of a
/// proximal pole's width [E], which the end of the longest line is, too.
/// @param tray  of the procedure: the screw for the line is one of it.
[[nodiscard]] procedure::Aim aim_of(const cases::CaseData& data,
                                    Approach approach,
                                    std::span<const instruments::InstrumentIndex> tray);

}  // namespace carpus::procedures::scaphoid_fixation
