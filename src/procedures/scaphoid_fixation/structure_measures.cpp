// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/harm_measures.hpp"
#include "procedures/scaphoid_fixation/measures.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

using procedure::Measure;

Measure struck(const Facts& facts) {
  // What never went into bone proved no care.
  if (facts.record.passes.empty()) {
    Measure none{"structures_struck", std::nullopt, "No wire went into bone."};
    none.applies = !facts.data.structures.empty();
    return none;
  }
  return procedure::structures_struck(facts.data, facts.record, " turned in the ",
                                      procedure::ThroughSkin::Wire);
}

}  // namespace

std::vector<Measure> structure_measures(const Facts& facts) {
  std::vector<Measure> measures =
      procedure::nearest_structures(facts.data, facts.record, "Nothing turned near one.");
  measures.insert(measures.begin(), struck(facts));
  return measures;
}

}  // namespace carpus::procedures::scaphoid_fixation
