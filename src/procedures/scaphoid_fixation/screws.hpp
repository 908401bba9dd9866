// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which screw a measured length allows.
#pragma once

#include <span>
#include <vector>

#include "instruments/instrument.hpp"

namespace carpus::procedures::scaphoid_fixation {

/// Bone that is to cover the screw, 2 mm at each end [clinical: K, B1 step 7]: a screw is this much
/// shorter than the length measured along the wire between the cortices.
inline constexpr double kMeasuredMinusScrewMm = 4.0;

/// The screws of a tray, in its order.
[[nodiscard]] std::vector<instruments::InstrumentIndex> screws_on(
    std::span<const instruments::InstrumentIndex> tray);

/// Place in `screws` of the longest that is not longer than measured - 4 mm, the first of equals;
/// -1 when even the shortest is too long.
[[nodiscard]] int ideal_screw(std::span<const instruments::InstrumentIndex> screws,
                              double measured_mm);

}  // namespace carpus::procedures::scaphoid_fixation
