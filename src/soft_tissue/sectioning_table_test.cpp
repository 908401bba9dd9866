// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/sectioning_table.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace carpus::data {
std::string_view sectioning();
}  // namespace carpus::data

namespace carpus::soft_tissue {
namespace {

/// The built-in text with its first `from` replaced.
std::string with(const std::string& from, const std::string& to) {
  std::string text(data::sectioning());
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(SectioningTable, IsWhatThePublishedStatementsAskFor) {
  const SectioningTable& table = SectioningTable::generic();
  EXPECT_EQ(table.moment_nm, 2);
  EXPECT_TRUE(table.cuts.front().without.empty());
  EXPECT_GE(table.cuts.size(), 6u);
  EXPECT_EQ(table.capsule.size(), 8u);
  EXPECT_GE(table.published.size(), 20u);
  for (const PublishedStatement& s : table.published) {
    // A source, or said to be general knowledge.
    EXPECT_NE(s.mark.find('['), std::string::npos) << s.id;
  }
}

TEST(SectioningTable, RefusesWhatItCannotMean) {
  const std::vector<std::string> broken{
      "{",
      with(R"("schema_version": 1)", R"("schema_version": 2)"),
      with(R"("moment_nm")", R"("moment_lb")"),
      with(R"("without": [])", R"("without": ["SL_"])"),
      with(R"("flexes": 1,)", R"("flexes": 0.5,)"),
      with(R"("id": "extension", "flexes")", R"("id": "flexion", "flexes")"),
      with(R"("bone": "lunate")", R"("bone": "moonbone")"),
      with(R"("kind": "share", "direction": "flexion")",
           R"("kind": "share", "direction": "sideways")"),
      with(R"("kind": "share")", R"("kind": "shares")"),
      with(R"("low": 60, "high": 80)", R"("low": 80, "high": 60)"),
      with(R"("low": 60, "high": 80, )", ""),
      with(R"("cut": "sl")", R"("cut": "everything")"),
      with(R"("goes_with")", R"("goes_by")"),
      with(R"("length_at_nm": {"value": 1)", R"("length_at_nm": {"value": 3)"),
      with(R"("press_n": {"value": 20)", R"("press_n": {"value": -20)"),
  };
  for (std::size_t i = 0; i < broken.size(); ++i) {
    EXPECT_THROW(static_cast<void>(SectioningTable::parse(broken[i])), InvalidInput) << i;
  }
}

}  // namespace
}  // namespace carpus::soft_tissue
