// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/named_grades.hpp"

#include <gtest/gtest.h>

#include "arthroscopy/make_lesions.hpp"

namespace carpus::arthroscopy {
namespace {

const PathologyTable& table() { return PathologyTable::generic(); }

TEST(NamedGrades, AreThoseThatWereSet) {
  cases::Grades grades{};
  EXPECT_TRUE(named_grades(grades, table()).empty());
  ASSERT_TRUE(set_grade(grades, table(), "disc", "1B"));
  ASSERT_TRUE(set_grade(grades, table(), "scapholunate", "III"));
  const std::vector<NamedGrade> both{{"scapholunate", "III"}, {"disc", "1B"}};
  EXPECT_EQ(named_grades(grades, table()), both);
  EXPECT_EQ(grades_in_words(grades, table()).front(),
            "Scapholunate ligament: III: step in both joints, a probe passes");
  ASSERT_TRUE(set_grade(grades, table(), "scapholunate", "0"));
  ASSERT_TRUE(set_grade(grades, table(), "disc", "0"));
  EXPECT_EQ(grades, cases::Grades{});
}

TEST(NamedGrades, RefuseWhatThereIsNotAndSayWhatThereIs) {
  cases::Grades grades{};
  const auto finding = set_grade(grades, table(), "meniscus\n", "III");
  ASSERT_FALSE(finding);
  EXPECT_NE(finding.error().find("'meniscus?'"), std::string::npos) << finding.error();
  EXPECT_NE(finding.error().find("scapholunate, lunotriquetral, disc"), std::string::npos);
  const auto grade = set_grade(grades, table(), "scapholunate", "V");
  ASSERT_FALSE(grade);
  EXPECT_EQ(grade.error(), "scapholunate has no grade 'V'; it has 0, I, II, III, IV");
  EXPECT_EQ(grades, cases::Grades{});
}

TEST(NamedGrades, WhatIsDrawnIsWhatAnExaminationOfThatSeedHas) {
  const cases::PreparedPathology drawn = drawn_pathology(7, table());
  EXPECT_EQ(drawn.grades, grades_by(7, table()));
  EXPECT_EQ(drawn.seed, 7U);
  EXPECT_TRUE(drawn.is_drawn);
}

}  // namespace
}  // namespace carpus::arthroscopy
