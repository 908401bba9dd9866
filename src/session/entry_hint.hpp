// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// In practice: how a wire that has gone in lies against what the procedure is after, and what to
// change, in directions of the hand.
#pragma once

#include <string>

#include "cases/case_data.hpp"
#include "procedure/situation.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::session {

/// "Enter 4 mm more radial. Aim 18° more distal.", or that it is where it should be. Within 2 mm
/// and 5 degrees nothing is to be changed [E].
/// @param item  fixed in bone.
[[nodiscard]] std::string entry_hint(const cases::CaseData& data,
                                     const procedure::Aim& aim,
                                     const simulation::Snapshot& now,
                                     const simulation::ItemView& item);

}  // namespace carpus::session
