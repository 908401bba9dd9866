// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/arthroscopy/punching.hpp"

#include <cstdint>
#include <string>

namespace carpus::procedures::arthroscopy {

std::vector<procedure::Measure> punch_measures(const procedure::PunchFacts& done, bool has_worked) {
  const auto bites = [&](const char* id, std::uint32_t count) {
    procedure::Measure measure{id, {}, ""};
    if (!has_worked) return measure;
    measure.value = static_cast<double>(count);
    if (done.bites > 0) {
      measure.finding = std::to_string(count) + " of " + std::to_string(done.bites) + " bites.";
    }
    return measure;
  };
  return {bites("bitten_unseen", done.unseen), bites("bitten_empty", done.empty),
          bites("bitten_cartilage", done.cartilage), bites("bitten_lining", done.lining)};
}

}  // namespace carpus::procedures::arthroscopy
