// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/pathology_file.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "arthroscopy/named_grades.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace {

cases::PreparedPathology pathology() {
  const auto& table = arthroscopy::PathologyTable::generic();
  cases::PreparedPathology p;
  p.seed = 7;
  EXPECT_TRUE(set_grade(p.grades, table, "scapholunate", "III"));
  EXPECT_TRUE(set_grade(p.grades, table, "disc", "1B"));
  return p;
}

std::string changed(const char* pointer, const nlohmann::json& value) {
  nlohmann::json json = nlohmann::json::parse(pathology_text(pathology()));
  json[nlohmann::json::json_pointer(pointer)] = value;
  return json.dump();
}

std::string refusal_of(const std::string& text) {
  try {
    (void)parse_pathology(text, "pathology.json");
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "none";
}

TEST(PathologyFile, GivesBackWhatWasWritten) {
  cases::PreparedPathology p = pathology();
  EXPECT_EQ(parse_pathology(pathology_text(p), "pathology.json"), p);
  p = {};
  EXPECT_EQ(parse_pathology(pathology_text(p), "pathology.json"), p) << "healthy";
  p = arthroscopy::drawn_pathology(9007199254740991, arthroscopy::PathologyTable::generic());
  EXPECT_EQ(parse_pathology(pathology_text(p), "pathology.json"), p);
}

TEST(PathologyFile, NamesWhatIsWrongAloneByIds) {
  const auto json = nlohmann::json::parse(pathology_text(pathology()));
  EXPECT_EQ(json.at("grades"), (nlohmann::json{{"scapholunate", "III"}, {"disc", "1B"}}));
  EXPECT_EQ(json.at("origin"), "chosen");
}

TEST(PathologyFile, ACaseNeedNotHaveOne) { EXPECT_FALSE(read_pathology("/nowhere")); }

TEST(PathologyFile, RefusesWhatIsWrong) {
  for (const std::string& text :
       {std::string("{"), std::string("[]"), changed("/format", "carpus lesson"),
        changed("/origin", "chance"), changed("/seed", -1), changed("/seed", "7"),
        changed("/schema_version", 0), changed("/grades", "healthy"), changed("/grades/disc", 1),
        changed("/grades/meniscus", "I"), changed("/grades/disc", "3A"), changed("/grade", "I"),
        std::string(20000, ' ')}) {
    EXPECT_NE(refusal_of(text), "none") << text;
  }
  nlohmann::json json = nlohmann::json::parse(pathology_text(pathology()));
  json.erase("grades");
  EXPECT_NE(refusal_of(json.dump()), "none");
}

TEST(PathologyFile, SaysWhichFindingsAndGradesThereAre) {
  EXPECT_NE(refusal_of(changed("/grades/meniscus", "I")).find("there are scapholunate, "),
            std::string::npos);
  EXPECT_NE(refusal_of(changed("/grades/disc", "3A")).find("it has 0, 1A, 1B"), std::string::npos);
}

TEST(PathologyFile, RefusesANewerOneByItsVersion) {
  try {
    (void)parse_pathology(changed("/schema_version", 2), "pathology.json");
    FAIL();
  } catch (const SchemaError& error) {
    EXPECT_NE(std::string(error.what()).find("version 2"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace carpus::case_io
