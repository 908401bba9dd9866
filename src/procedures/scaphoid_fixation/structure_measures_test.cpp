// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "cases/synthetic_case_test_support.hpp"
#include "instruments/instrument.hpp"
#include "procedures/dorsal_scaphoid_fixation/declared.hpp"
#include "procedures/scaphoid_fixation/measures.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

using procedure::Measure;

cases::CaseData wrist_with_structures() {
  cases::CaseData data = cases::test::synthetic_case();
  data.structures = {
      {"epl", "extensor pollicis longus", anatomy::StructureKind::Tendon, 1, BoneId::Radius, {}},
      {"sbrn_index", "nerve", anatomy::StructureKind::Nerve, 1, BoneId::Radius, {}}};
  return data;
}

std::vector<Measure> measures_of(const cases::CaseData& data,
                                 const procedure::OperationRecord& record) {
  static const Fixation fixation{&dorsal_scaphoid_fixation::declared(), Approach::FromProximal};
  const Facts facts{data, record, fixation, {}, {}, {}, {}, {}, {}, 0, {}};
  return structure_measures(facts);
}

const Measure& find(const std::vector<Measure>& all, std::string_view id) {
  return *std::find_if(all.begin(), all.end(), [&](const Measure& m) { return m.id == id; });
}

TEST(StructureMeasures, NameWhatWasStruckAndHowToAvoidIt) {
  const cases::CaseData data = wrist_with_structures();
  procedure::OperationRecord record;
  record.passes.push_back({});
  const auto wire = *instruments::instrument_of("guide_wire");
  record.structures = {{0, -0.4, true, wire}, {1, 3.2, false, wire}};
  const auto all = measures_of(data, record);
  EXPECT_EQ(find(all, "structures_struck").value, 1.0);
  EXPECT_THAT(
      find(all, "structures_struck").finding,
      testing::AllOf(testing::HasSubstr("Guide wire"),
                     testing::HasSubstr("extensor pollicis longus"), testing::HasSubstr("Lister")));
  EXPECT_EQ(find(all, "nearest_tendon_mm").value, -0.4);
  EXPECT_EQ(find(all, "nearest_nerve_mm").value, 3.2);
  EXPECT_FALSE(find(all, "nearest_artery_mm").value);
}

TEST(StructureMeasures, AreZeroWhereNothingWasStruckAndNothingWhereNothingWasDone) {
  const cases::CaseData data = wrist_with_structures();
  procedure::OperationRecord record;
  EXPECT_FALSE(find(measures_of(data, record), "structures_struck").value);
  record.passes.push_back({});
  record.structures = {{0, 2, false, 0}};
  EXPECT_EQ(find(measures_of(data, record), "structures_struck").value, 0.0);
}

TEST(StructureMeasures, DoNotApplyToACaseThatHasNone) {
  const cases::CaseData data = cases::test::synthetic_case();
  for (const Measure& measure : measures_of(data, {})) EXPECT_FALSE(measure.applies) << measure.id;
}

}  // namespace
}  // namespace carpus::procedures::scaphoid_fixation
