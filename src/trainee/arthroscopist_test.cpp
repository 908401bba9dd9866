// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "trainee/arthroscopist.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"
#include "procedures/built_in.hpp"

namespace carpus::trainee {
namespace {

const procedure::Procedure& arthroscopy() {
  return *procedures::built_in().find("diagnostic_arthroscopy");
}

TEST(Arthroscopist, KnowsAnArthroscopyByTheScopeOnItsTray) {
  EXPECT_TRUE(is_arthroscopy(arthroscopy()));
  EXPECT_FALSE(is_arthroscopy(*procedures::built_in().find("dorsal_scaphoid_fixation")));
}

TEST(Arthroscopist, ACaseWithoutSoftTissueIsRefusedByName) {
  const cases::CaseData none;
  try {
    const ScriptedArthroscopist trainee(none, arthroscopy(), Skill::Expert, 1);
    FAIL() << "it began";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("radius"), std::string::npos) << error.what();
  }
}

TEST(Arthroscopist, SkillsDifferInHandsAndHorizon) {
  const ScopeSkill expert = scope_skill_of(Skill::Expert);
  const ScopeSkill middle = scope_skill_of(Skill::Middle);
  const ScopeSkill novice = scope_skill_of(Skill::Novice);
  EXPECT_LT(expert.tilt_deg, middle.tilt_deg);
  EXPECT_LT(middle.tilt_deg, novice.tilt_deg);
  EXPECT_LT(expert.yields_n, novice.yields_n);
  EXPECT_EQ(expert.wanderings, 0);
}

}  // namespace
}  // namespace carpus::trainee
