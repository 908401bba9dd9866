// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <string>

#include "anatomy/structure_table.hpp"
#include "procedures/scaphoid_fixation/measures.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

using anatomy::StructureKind;
using procedure::Measure;
using procedure::NearStructure;

/// Beyond it nothing came near at all [mm].
constexpr double kNearMm = 50.0;

const cases::Structure* structure_of(const Facts& facts, const NearStructure& near) {
  const auto& all = facts.data.structures;
  return near.structure < all.size() ? &all[near.structure] : nullptr;
}

std::string instrument_words(const NearStructure& near) {
  const auto all = instruments::catalogue();
  return near.by < all.size() ? all[near.by].name : std::string("An instrument");
}

/// "Guide wire 1.14 mm in the extensor pollicis longus: feel Lister's tubercle, …"
std::string words_of_harm(const cases::Structure& structure, const NearStructure& near) {
  std::string text = instrument_words(near) + " turned in the " + structure.name;
  const auto* tabled = anatomy::StructureTable::generic().find(structure.id);
  if (tabled != nullptr) text += ": " + tabled->avoid;
  return text + ".";
}

Measure struck(const Facts& facts) {
  Measure measure{"structures_struck", std::nullopt, ""};
  measure.applies = !facts.data.structures.empty();
  // What never went into bone proved no care.
  if (facts.record.passes.empty()) {
    measure.finding = "No wire went into bone.";
    return measure;
  }
  measure.value = 0.0;
  for (const NearStructure& near : facts.record.structures) {
    const cases::Structure* structure = structure_of(facts, near);
    if (structure == nullptr || !near.was_struck) continue;
    *measure.value += 1.0;
    measure.finding += (measure.finding.empty() ? "" : " ") + words_of_harm(*structure, near);
  }
  if (measure.finding.empty()) measure.finding = "None was.";
  return measure;
}

Measure nearest(const Facts& facts, const char* id, StructureKind kind) {
  Measure measure{id, std::nullopt, "Nothing turned near one."};
  measure.applies = !facts.data.structures.empty();
  for (const NearStructure& near : facts.record.structures) {
    const cases::Structure* structure = structure_of(facts, near);
    if (structure == nullptr || structure->kind != kind || near.least_mm > kNearMm) continue;
    if (measure.value && near.least_mm >= *measure.value) continue;
    measure.value = near.least_mm;
    measure.finding = instrument_words(near) + ", beside the " + structure->name + ".";
  }
  return measure;
}

}  // namespace

std::vector<Measure> structure_measures(const Facts& facts) {
  return {struck(facts), nearest(facts, "nearest_tendon_mm", StructureKind::Tendon),
          nearest(facts, "nearest_artery_mm", StructureKind::Artery),
          nearest(facts, "nearest_nerve_mm", StructureKind::Nerve)};
}

}  // namespace carpus::procedures::scaphoid_fixation
