// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/trust_file.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <filesystem>

#include "case_io/lesson_file.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace {

const Trust kTrust{{{"radius", 0.97, false, ""}, {"pisiform", 0.2, true, "it is hollow: fill it"}}};

TEST(TrustFile, ReadsWhatItWrote) {
  const auto lines = parse_trust(trust_text(kTrust, "carpus 1.0"), "trust.json").bones;
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[1].name, "pisiform");
  EXPECT_EQ(lines[1].confidence, 0.2);
  EXPECT_TRUE(lines[1].flagged);
  EXPECT_EQ(lines[1].why, "it is hollow: fill it");
  EXPECT_FALSE(lines[0].flagged);
  const Trust doubted{kTrust.bones, {"a child's?"}};
  EXPECT_EQ(parse_trust(trust_text(doubted, "carpus 1.0"), "trust.json"), doubted);
}

TEST(TrustFile, RefusesWhatItDoesNotKnow) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = trust_text(kTrust, "carpus 1.0");
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THROW((void)parse_trust(changed("pisiform", "femur"), "trust.json"), InvalidInput);
  EXPECT_THROW((void)parse_trust(changed("0.97", "1.97"), "trust.json"), InvalidInput);
  EXPECT_THROW((void)parse_trust(changed("carpus bone trust", "else"), "trust.json"), InvalidInput);
  EXPECT_THROW((void)parse_trust(changed("\"schema_version\": 2", "\"schema_version\": 3"), "t"),
               SchemaError);
  // As programs before 2 wrote it.
  EXPECT_EQ(parse_trust(changed("\"schema_version\": 2", "\"schema_version\": 1"), "t"), kTrust);
  EXPECT_THROW((void)parse_trust("{", "trust.json"), InvalidInput);
  const std::vector<std::string> many(17, "a");
  EXPECT_THROW((void)parse_trust(trust_text({kTrust.bones, many}, "c"), "trust.json"),
               InvalidInput);
  EXPECT_THROW((void)parse_trust(trust_text({kTrust.bones, {""}}, "c"), "trust.json"),
               InvalidInput);
}

TEST(TrustFile, OfACaseThatIsAPipeIsRefusedWithoutWaiting) {
  std::string folder = testing::TempDir() + "/trust_XXXXXX";
  ASSERT_NE(::mkdtemp(folder.data()), nullptr);
  ASSERT_EQ(::mkfifo((folder + "/trust.json").c_str(), 0600), 0);
  EXPECT_THROW((void)read_trust(folder), IoError);
  ASSERT_EQ(::mkfifo((folder + "/lesson.json").c_str(), 0600), 0);
  EXPECT_THROW((void)read_lesson(folder), IoError);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace carpus::case_io
