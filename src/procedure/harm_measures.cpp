// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/harm_measures.hpp"

#include <string>

#include "anatomy/structure_table.hpp"
#include "instruments/instrument.hpp"

namespace carpus::procedure {
namespace {

using anatomy::StructureKind;

/// Beyond it nothing came near at all [mm].
constexpr double kNearMm = 50.0;

const cases::Structure* structure_of(const cases::CaseData& data, const NearStructure& near) {
  return near.structure < data.structures.size() ? &data.structures[near.structure] : nullptr;
}

std::string instrument_words(const NearStructure& near) {
  const auto all = instruments::catalogue();
  return near.by < all.size() ? all[near.by].name : std::string("An instrument");
}

/// "Guide wire 1.14 mm turned in the extensor pollicis longus: feel Lister's tubercle, …"
std::string words_of_harm(const cases::Structure& structure,
                          const NearStructure& near,
                          std::string_view did,
                          ThroughSkin way) {
  std::string text = instrument_words(near) + std::string(did) + structure.name;
  const anatomy::StructureTable& table = anatomy::StructureTable::generic();
  const auto* tabled = table.find(structure.id);
  if (way == ThroughSkin::Portal) {
    text += ": " + table.at_a_portal[static_cast<std::size_t>(structure.kind)];
  } else if (tabled != nullptr) {
    text += ": " + tabled->avoid;
  }
  return text + ".";
}

Measure nearest(const cases::CaseData& data,
                const OperationRecord& record,
                const char* id,
                StructureKind kind,
                std::string_view nothing) {
  Measure measure{id, std::nullopt, std::string(nothing)};
  measure.applies = !data.structures.empty();
  for (const NearStructure& near : record.structures) {
    const cases::Structure* structure = structure_of(data, near);
    if (structure == nullptr || structure->kind != kind || near.least_mm > kNearMm) continue;
    if (measure.value && near.least_mm >= *measure.value) continue;
    measure.value = near.least_mm;
    measure.finding = instrument_words(near) + ", beside the " + structure->name + ".";
  }
  return measure;
}

}  // namespace

Measure structures_struck(const cases::CaseData& data,
                          const OperationRecord& record,
                          std::string_view did,
                          ThroughSkin way) {
  Measure measure{"structures_struck", 0.0, ""};
  measure.applies = !data.structures.empty();
  for (const NearStructure& near : record.structures) {
    const cases::Structure* structure = structure_of(data, near);
    if (structure == nullptr || !near.was_struck) continue;
    *measure.value += 1.0;
    measure.finding +=
        (measure.finding.empty() ? "" : " ") + words_of_harm(*structure, near, did, way);
  }
  if (measure.finding.empty()) measure.finding = "None was.";
  return measure;
}

std::vector<Measure> nearest_structures(const cases::CaseData& data,
                                        const OperationRecord& record,
                                        std::string_view nothing) {
  return {nearest(data, record, "nearest_tendon_mm", StructureKind::Tendon, nothing),
          nearest(data, record, "nearest_artery_mm", StructureKind::Artery, nothing),
          nearest(data, record, "nearest_nerve_mm", StructureKind::Nerve, nothing)};
}

}  // namespace carpus::procedure
