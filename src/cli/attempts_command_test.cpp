// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/attempts_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace carpus::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(AttemptsTable, CallsACaseSimulatedWhereThatWasNoted) {
  records::AttemptSummary attempt;
  attempt.case_name = "a wrist whose name is longer than its column";
  attempt.case_simulated = true;
  EXPECT_THAT(attempts_table({attempt}), HasSubstr("  a wrist whose na (simulated)  "));
  for (const std::optional<bool> other : {std::optional(false), std::optional<bool>()}) {
    attempt.case_simulated = other;
    EXPECT_THAT(attempts_table({attempt}), Not(HasSubstr("simulated")));
  }
}

TEST(AttemptsTable, TellsWhatWasOperated) {
  records::AttemptSummary attempt;
  attempt.procedure = "arthroscopic_portal_making_harder";
  EXPECT_THAT(attempts_table({attempt}), HasSubstr("  arthroscopic_portal_making_harder  "));
}

}  // namespace
}  // namespace carpus::cli
