// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/tissue_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "anatomy/wrist_model.hpp"
#include "core/error.hpp"

namespace carpus::data {
std::string_view soft_tissue();
}  // namespace carpus::data

namespace carpus::soft_tissue {
namespace {

using ::testing::HasSubstr;

std::string refusal_of(const std::string& from, const std::string& to) {
  std::string text(data::soft_tissue());
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  try {
    (void)TissueTable::parse(text);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

TEST(TissueTable, AttachmentsLieOnTheModelsBones) {
  constexpr double kOffMm = 1.0;  // middle lines of areas are chords of the surface
  for (const TabledLigament& l : TissueTable::generic().ligaments) {
    for (const TabledAttachment& a : l.attachments) {
      if (!a.bone) continue;
      for (const Vec3& p : {a.across.front(), a.across[a.across.size() / 2]}) {
        const double mm = anatomy::WristModel::generic().signed_value(*a.bone, p);
        EXPECT_LT(std::abs(mm), a.across.size() > 1 ? 3 * kOffMm : kOffMm) << l.id;
      }
    }
  }
}

TEST(TissueTable, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(refusal_of("\"strands\"", "\"threads\""), HasSubstr("threads"));
  EXPECT_THAT(refusal_of("\"bone\": \"scaphoid\"", "\"bone\": \"navicular\""),
              HasSubstr("navicular"));
  EXPECT_THAT(refusal_of("\"ligament\": \"VRUL\"", "\"ligament\": \"SL\""), HasSubstr("UL"));
  EXPECT_THAT(refusal_of("\"over\": [\"SL_volar\"", "\"over\": [\"TT\""),
              HasSubstr("no ligament 'TT' comes before it"));
  EXPECT_THAT(refusal_of("\"schema_version\": 1", "\"schema_version\": 2"),
              HasSubstr("schema_version"));
  EXPECT_THAT(refusal_of("\"mark\": \"[E]", "\"mark\": \"\", \"x\": \"[E]"), HasSubstr("x"));
}

}  // namespace
}  // namespace carpus::soft_tissue
