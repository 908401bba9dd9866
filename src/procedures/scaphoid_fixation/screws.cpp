// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/screws.hpp"

#include <cstddef>

namespace carpus::procedures::scaphoid_fixation {

using instruments::InstrumentIndex;

std::vector<InstrumentIndex> screws_on(std::span<const InstrumentIndex> tray) {
  std::vector<InstrumentIndex> screws;
  for (const InstrumentIndex index : tray) {
    if (instruments::catalogue()[index].work == instruments::Work::Thread) screws.push_back(index);
  }
  return screws;
}

int ideal_screw(std::span<const InstrumentIndex> screws, double measured_mm) {
  const auto all = instruments::catalogue();
  int best = -1;
  double best_length = 0.0;
  for (std::size_t i = 0; i < screws.size(); ++i) {
    const double length = all[screws[i]].length_mm;
    if (length <= measured_mm - kMeasuredMinusScrewMm && length > best_length) {
      best = static_cast<int>(i);
      best_length = length;
    }
  }
  return best;
}

}  // namespace carpus::procedures::scaphoid_fixation
