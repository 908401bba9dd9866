// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Makes the soft tissue of a case from the generic wrist and the case's own bones.
#pragma once

#include "cases/case_data.hpp"
#include "core/progress.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::soft_tissue {

/// Ligaments, disc, cartilage and joint spaces, each checked: closed, no vertex in bone by more
/// than 0.1 mm, no two tissues in each other by more (the case's tendons, arteries and nerves among
/// them), lengths and thicknesses in the table's ranges times the wrist's size. What cannot be
/// made, or is out of its range, is named in `problems`; the rest is made.
///
/// @param data  needs side, wrist frame and bones with surfaces; uses its distance fields, and its
///     hand motion for where faces meet in other postures.
/// Runs through parallel_for, the same bits on any number of threads; seconds.
[[nodiscard]] SoftTissue make_soft_tissue(const cases::CaseData& data,
                                          const TissueTable& table = TissueTable::generic(),
                                          const Progress& progress = no_progress);

/// The same of a new case, whose tendons, arteries and nerves were laid without it: before all is
/// checked they give way to it (cases/lay_beside.hpp). Those that are clear stay as they are.
[[nodiscard]] SoftTissue make_soft_tissue_moving_structures(
    cases::CaseData& data,
    const TissueTable& table = TissueTable::generic(),
    const Progress& progress = no_progress);

}  // namespace carpus::soft_tissue
