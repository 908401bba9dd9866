// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What has been done to find out whether a screw stands out into a joint. Bits are sites, in the
// order of cases::ScrewSite; of answers what is asked, the decision last.
#pragma once

#include <cstdint>

namespace carpus::procedure {

struct ScrewFacts {
  std::uint8_t seen = 0;    ///< in view for a second
  std::uint8_t probed = 0;  ///< touched while the scope saw the probe's tip
  /// By answer, what had been seen and probed when it was given last.
  std::uint8_t answered_seen = 0;      ///< of a site: it; of the decision: all sites
  std::uint8_t answered_probed = 0;    ///< likewise
  std::uint8_t sites_at_decision = 0;  ///< seen when it was made last
  bool operator==(const ScrewFacts&) const = default;
};

}  // namespace carpus::procedure
