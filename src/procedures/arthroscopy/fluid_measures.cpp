// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How fluid was led through the joint: what it hid, and what it did to the tissue.
#include <utility>

#include "procedure/thrift_measures.hpp"
#include "procedures/arthroscopy/conduct.hpp"

namespace carpus::procedures::arthroscopy {

void add_fluid_measures(std::vector<procedure::Measure>& measures,
                        const procedure::OperationRecord& record) {
  static const procedure::ScopeRecord kNone;
  const procedure::FluidFacts& fluid = (record.scope ? *record.scope : kNone).fluid;
  procedure::Measure clouded{"clouded_share", {}, ""};
  procedure::Measure over{"pressure_over_limit_s", {}, ""};
  procedure::Measure tissue{"fluid_in_tissue_ml", {}, ""};
  if (fluid.watched_ticks > 0) {  // whose scope was never in a joint led no fluid
    clouded.value =
        100.0 * static_cast<double>(fluid.clouded_ticks) / static_cast<double>(fluid.watched_ticks);
    over.value = static_cast<double>(fluid.over_limit_ticks) * kTickSeconds;
    tissue.value = fluid.tissue_ml;
    tissue.finding = "Of " + procedure::text_of(fluid.used_ml) + " ml that ran in.";
  }
  measures.push_back(std::move(clouded));
  measures.push_back(std::move(over));
  measures.push_back(std::move(tissue));
}

}  // namespace carpus::procedures::arthroscopy
