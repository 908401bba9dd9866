// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An examination begins with what its case has prepared to be wrong at that moment.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "arthroscopy/named_grades.hpp"
#include "core/error.hpp"
#include "server/station_test_support.hpp"
#include "simulation/box_joint_test_support.hpp"
#include "simulation/recording.hpp"

namespace carpus::server {
namespace {

using ::testing::HasSubstr;
using namespace testing;
namespace box_joint = simulation::box_joint;

const procedure::ProcedureList& examinations() {
  static const procedure::Procedure kExamination = box_joint::probing(true);
  static const procedure::ProcedureList kList({&kExamination});
  return kList;
}

cases::PreparedPathology torn(const char* grade) {
  cases::PreparedPathology prepared;
  prepared.seed = 3;
  EXPECT_TRUE(
      set_grade(prepared.grades, arthroscopy::PathologyTable::generic(), "scapholunate", grade));
  return prepared;
}

TEST(StationPathology, IsAskedForAsEachExaminationBeginsAndAFileThatIsNoneStopsThatAlone) {
  std::string name = (fs::temp_directory_path() / "carpus-prepared-XXXXXX").string();
  const fs::path folder = ::mkdtemp(name.data());
  {
    std::mutex mutex;
    std::optional<cases::PreparedPathology> file = torn("III");
    bool is_damaged = false;
    records::AttemptKeeper records(folder / "attempts.sqlite");
    OverCases over;
    over.prepared = [&] {
      const std::lock_guard lock(mutex);
      if (is_damaged) throw InvalidInput("pathology.json: grades: there is no finding 'x'");
      return file;
    };
    Station station(
        box_joint::box_wrist_with_ligament(), examinations(), records, [](const std::string&) {},
        {}, over);
    NetworkOptions options;
    options.port = 0;
    NetworkServer network(
        options, [](const HttpRequest&) { return make_json("{}"); }, station);
    station.attach(network);
    std::thread thread([&] { network.run(); });
    {
      PageClient page(network.port());
      page.send(kHello);
      (void)page.wait_for_type("welcome");
      const auto begin = [&] {
        page.send(kStart);
        page.send(kHand);
        (void)page.wait_for_type("exercise");
        (void)page.wait_for_type("snapshot");
      };
      const auto change = [&](std::optional<cases::PreparedPathology> to, bool damaged) {
        const std::lock_guard lock(mutex);
        file = to;
        is_damaged = damaged;
      };
      begin();
      change(torn("IV"), false);
      begin();
      change({}, false);
      begin();
      change({}, true);
      page.send(kStart);
      EXPECT_THAT(page.wait_for_type("error"), HasSubstr("there is no finding 'x'"));
    }
    network.stop();
    thread.join();
    station.detach();
    ASSERT_EQ(records.list().size(), 3U);
    // Where nothing is prepared the start's seed draws, and the recording says what.
    const std::optional<cases::PreparedPathology> expected[] = {
        torn("III"), torn("IV"),
        arthroscopy::drawn_pathology(kStartSeed, arthroscopy::PathologyTable::generic())};
    for (int id = 1; id <= 3; ++id) {
      const auto recording = simulation::decode(records.find(id)->recording);
      ASSERT_TRUE(recording) << recording.error();
      EXPECT_EQ(recording->prepared, expected[id - 1]) << id;
    }
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace carpus::server
