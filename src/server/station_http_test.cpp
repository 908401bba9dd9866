// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/station_http.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "cases/synthetic_case_test_support.hpp"
#include "core/hexadecimal.hpp"
#include "server/exercise.hpp"
#include "simulation/recording.hpp"

namespace carpus::server {
namespace {

using Json = nlohmann::json;

class StationHttpTest : public ::testing::Test {
 protected:
  StationHttpTest()
      : folder_(new_folder()),
        records_(folder_ / "attempts.sqlite"),
        http_(wrist_, procedures_, "glTF", records_, folder_) {}
  ~StationHttpTest() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] Json get(const std::string& target) const {
    HttpRequest request;
    request.target = target;
    return Json::parse(*http_.answer(request).body);
  }

  static std::filesystem::path new_folder() {
    std::string name =
        (std::filesystem::temp_directory_path() / "carpus-station-http-XXXXXX").string();
    const std::filesystem::path folder = ::mkdtemp(name.data());
    std::ofstream(folder / "index.html") << "<title>Carpus</title>";
    return folder;
  }

  const cases::CaseData wrist_ = cases::test::synthetic_case();
  const procedure::ProcedureList procedures_;
  std::filesystem::path folder_;
  records::AttemptKeeper records_;
  StationHttp http_;
};

TEST_F(StationHttpTest, TellsWhetherAnAttemptWasMadeOnTheOpenCase) {
  records::Attempt here;
  here.summary.case_fingerprint = hexadecimal(simulation::fingerprint_of(wrist_));
  records::Attempt elsewhere = here;
  elsewhere.summary.case_fingerprint.back() ^= 1;
  (void)records_.save(here);
  (void)records_.save(elsewhere);
  EXPECT_EQ(get("/api/attempts/1")["case_is_open"], true);
  EXPECT_EQ(get("/api/attempts/2")["case_is_open"], false);
}

TEST_F(StationHttpTest, TellsWhetherTheCaseOfAnAttemptIsSimulatedWhereThatWasNoted) {
  cases::CaseData scanned = wrist_;
  scanned.provenance.simulated = false;
  const simulation::Recording recording;
  for (const cases::CaseData* data : {&wrist_, static_cast<const cases::CaseData*>(&scanned)}) {
    (void)records_.save(make_attempt({*data, recording, {}, {}, "Ada", "script", ""}));
  }
  (void)records_.save({});
  const Json list = get("/api/attempts")["attempts"];
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[2]["case_simulated"], true);
  EXPECT_EQ(list[1]["case_simulated"], false);
  EXPECT_TRUE(list[0]["case_simulated"].is_null());
  EXPECT_EQ(get("/api/attempts/1")["case_simulated"], true);
}

}  // namespace
}  // namespace carpus::server
