// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/station_http.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
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
        http_(wrist_,
              procedures_,
              "glTF",
              records_,
              {owners_, quiz_owners_},
              folder_,
              std::make_shared<SharedShelf>(shelf())) {}
  ~StationHttpTest() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] HttpResponse ask(const std::string& target, const Guest& guest) const {
    return http_.answer({"GET", target, guest});
  }
  [[nodiscard]] Json get(const std::string& target,
                         const Guest& guest = {Role::Instructor, {}}) const {
    return Json::parse(*ask(target, guest).body);
  }

  static CaseShelf shelf() {
    return {{{"easy", "first wrist", "An easy one", "Fell.", "Find it.", 20.0,
              std::make_shared<const std::string>("PNG")},
             {"plain", "plain wrist", "plain", "", "", {}, nullptr}},
            "easy"};
  }
  static std::filesystem::path new_folder() {
    std::string name =
        (std::filesystem::temp_directory_path() / "carpus-station-http-XXXXXX").string();
    const std::filesystem::path folder = ::mkdtemp(name.data());
    std::ofstream(folder / "index.html") << "<title>Carpus</title>";
    return folder;
  }

  static const cases::CaseData& wrist() {
    static const cases::CaseData made = cases::test::synthetic_case();
    return made;
  }
  const cases::CaseData& wrist_ = wrist();
  const procedure::ProcedureList procedures_;
  std::filesystem::path folder_;
  records::AttemptKeeper records_;
  AttemptOwners owners_;
  AttemptOwners quiz_owners_;
  StationHttp http_;
};

TEST_F(StationHttpTest, TellsWhichCasesCanBeChosenWithTheirPictures) {
  const Json list = get("/api/cases");
  EXPECT_EQ(list["open"], "easy");
  ASSERT_EQ(list["cases"].size(), 2U);
  EXPECT_EQ(list["cases"][0]["history"], "Fell.");
  EXPECT_EQ(list["cases"][0]["goal"], "Find it.");
  EXPECT_EQ(list["cases"][0]["difficulty"], 20.0);
  EXPECT_EQ(list["cases"][1]["difficulty"], nullptr);
  EXPECT_EQ(list["cases"][1]["has_preview"], false);
  const HttpResponse picture = ask("/api/cases/easy/preview.png", {Role::Trainee, {}});
  EXPECT_EQ(picture.content_type, "image/png");
  EXPECT_EQ(*picture.body, "PNG");
  for (const char* target : {"/api/cases/plain/preview.png", "/api/cases/none/preview.png",
                             "/api/cases/easy/case.json"}) {
    EXPECT_EQ(ask(target, {Role::Instructor, {}}).status, 404) << target;
  }
}

TEST_F(StationHttpTest, ShowsTheScansOfItsCasesAndNothingElseOfTheirFolders) {
  const std::filesystem::path folder = folder_ / "wrist";
  std::filesystem::create_directories(folder / "bones");
  for (const char* file :
       {"case.json", "trust.json", "ct.nii.gz", "bones/radius.ply", "lesson.json"}) {
    std::ofstream(folder / file) << file;
  }
  std::filesystem::create_symlink("/dev/zero", folder / "labels.nii.gz");
  std::ofstream(folder_ / "secret") << "of this machine";
  std::filesystem::create_symlink(folder_ / "secret", folder / "bones.glb");
  CaseShelf cases = shelf();
  cases.cases[1].folder = folder;
  const auto truth = std::make_shared<TruthGate>();
  const StationHttp http(wrist_, procedures_, "glTF", records_, {owners_, quiz_owners_}, folder_,
                         std::make_shared<SharedShelf>(cases), truth);
  const auto answer = [&](const std::string& path) {
    return http.answer({"GET", "/api/cases/" + path, {Role::Trainee, "ada"}});
  };
  EXPECT_EQ(*answer("plain/scan/case.json").body, "case.json");
  EXPECT_EQ(*answer("plain/scan/trust.json").body, "trust.json");
  EXPECT_EQ(*answer("plain/scan/ct.nii.gz").body, "ct.nii.gz");
  EXPECT_EQ(answer("plain/scan/ct.nii.gz").content_type, "application/gzip");
  for (const char* path :
       {"plain/scan/labels.nii.gz", "plain/scan/bones.glb", "plain/scan/lesson.json",
        "plain/scan/bones/radius.ply", "easy/scan/ct.nii.gz", "none/scan/ct.nii.gz",
        "plain/scan/scan/ct.nii.gz"}) {
    EXPECT_EQ(answer(path).status, 404U) << path;
  }
  truth->close(true);
  EXPECT_EQ(answer("plain/scan/ct.nii.gz").status, 409U);
  EXPECT_EQ(answer("plain/scan/case.json").status, 409U);
  truth->close(false);
  EXPECT_EQ(answer("plain/scan/ct.nii.gz").status, 200U);
}

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

TEST_F(StationHttpTest, TellsWhereTheCaseOfAnAttemptIs) {
  for (const char* name : {"plain wrist", "a wrist from elsewhere", "first wrist"}) {
    records::Attempt attempt;
    attempt.summary.case_name = name;
    (void)records_.save(attempt);
  }
  EXPECT_EQ(get("/api/attempts/1")["case_here"], "plain");
  EXPECT_EQ(get("/api/attempts/2")["case_here"], "");
  EXPECT_EQ(get("/api/attempts/3")["case_here"], "") << "it is open";
  CaseShelf twins = shelf();
  twins.cases[0].name = twins.cases[1].name;
  EXPECT_EQ(twins.id_of_named("plain wrist"), "");
}

TEST_F(StationHttpTest, TraineeSeesTheAttemptsOfTheirOwnBrowserAlone) {
  for (int i = 0; i < 3; ++i) (void)records_.save({});
  owners_.add(1, "ada");
  owners_.add(2, "bela");
  const Guest ada{Role::Trainee, "ada"};
  const Json own = get("/api/attempts", ada)["attempts"];
  ASSERT_EQ(own.size(), 1U);
  EXPECT_EQ(own[0]["id"], 1);
  EXPECT_EQ(ask("/api/attempts/1", ada).status, 200U);
  EXPECT_EQ(ask("/api/attempts/1/recording", ada).status, 200U);
  for (const char* target : {"/api/attempts/2", "/api/attempts/2/recording",
                             "/api/attempts/2/replay/exercise", "/api/attempts/3"}) {
    EXPECT_EQ(ask(target, ada).status, 404U) << target;
    EXPECT_EQ(ask(target, {Role::Trainee, ""}).status, 404U) << target;
    EXPECT_NE(ask(target, {Role::Instructor, "ada"}).status, 404U) << target;
  }
  EXPECT_EQ(get("/api/attempts", {Role::Trainee, ""})["attempts"].size(), 0U);
  EXPECT_EQ(get("/api/attempts", {Role::Instructor, "x"})["attempts"].size(), 3U);
}

TEST_F(StationHttpTest, TraineeSeesTheQuizAnswersOfTheirOwnBrowserAlone) {
  for (const char* answered : {"inside", "side", "distal"}) {
    records::QuizAnswer answer;
    answer.trainee = "Ada";
    answer.question = 1;
    answer.place = "distal";
    answer.answered = answered;
    records_.save(answer, [](const records::KeptAttempt&) {});
  }
  (void)records_.settle();
  quiz_owners_.add(1, "ada");
  quiz_owners_.add(3, "bela");
  const Json own = get("/api/quiz_answers", {Role::Trainee, "ada"})["answers"];
  ASSERT_EQ(own.size(), 1U);
  EXPECT_EQ(own[0]["trainee"], "Ada");
  EXPECT_EQ(own[0]["is_false_safety"], true);
  EXPECT_EQ(own[0]["is_place_right"], false);
  EXPECT_EQ(get("/api/quiz_answers", {Role::Trainee, ""})["answers"].size(), 0U);
  const Json all = get("/api/quiz_answers", {Role::Instructor, "x"});
  ASSERT_EQ(all["answers"].size(), 3U);
  EXPECT_EQ(all["older"], false);
  EXPECT_EQ(all["answers"][0]["is_place_right"], true);
  EXPECT_EQ(all["answers"][1]["is_false_safety"], false);
  EXPECT_EQ(get("/api/quiz_answers?before=2", {Role::Instructor, "x"})["answers"].size(), 1U);
  EXPECT_EQ(ask("/api/quiz_answers?before=x", {Role::Instructor, "x"}).status, 400U);
}

TEST_F(StationHttpTest, RecordingWhoseTruthIsLockedIsKept) {
  procedure::ScoreReport score;
  simulation::Recording assessed;
  assessed.mode = procedure::Mode::Assessed;
  for (const bool is_void : {false, true}) {
    score.is_void = is_void;
    (void)records_.save(make_attempt({wrist_, assessed, {}, score, "Ada", "", ""}));
  }
  EXPECT_EQ(ask("/api/attempts/1/recording", {Role::Instructor, {}}).status, 200U);
  for (const Role role : {Role::Instructor, Role::Trainee}) {
    owners_.add(2, "ada");
    const HttpResponse refused = ask("/api/attempts/2/recording", {role, "ada"});
    EXPECT_EQ(refused.status, 409U);
    EXPECT_NE(refused.body->find("stays closed"), std::string::npos);
  }
}

TEST_F(StationHttpTest, WhatTakesLongIsKnownHoweverItIsWritten) {
  const std::vector<std::pair<const char*, std::size_t>> lanes{
      {"/", 0},
      {"/api/scene.glb", 0},
      {"/api/cases/a/preview.png", 0},
      {"/api/cases/a/scan/ct.nii.gz", 3},
      {"/api/cases/a/sc%61n/ct.nii.gz", 3},
      {"/api/attempts", 1},
      {"/api/attempts/1", 1},
      {"/api/quiz_answers?before=3", 1},
      {"/api/asset?attempt=3", 1},
      {"/api/%61ttempts?x", 1},
      {"/api/attempts/1/replay/states?from=0&to=1&every=1", 2},
      {"/api/attempts/1/replay/picture?at=3", 3}};
  for (const auto& [target, lane] : lanes) {
    EXPECT_EQ(StationHttp::lane_of({"GET", target, {}}), lane) << target;
  }
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

TEST_F(StationHttpTest, ListsAttemptsInPagesOfFifty) {
  for (int i = 0; i < 120; ++i) (void)records_.save(records::Attempt{});
  std::vector<std::int64_t> sizes;
  std::string target = "/api/attempts";
  for (bool older = true; older;) {
    const Json page = get(target);
    EXPECT_EQ(page["total"], 120);
    sizes.push_back(static_cast<std::int64_t>(page["attempts"].size()));
    older = page["older"];
    target = "/api/attempts?before=" + std::to_string(page["attempts"].back()["id"].get<int>());
  }
  EXPECT_EQ(sizes, (std::vector<std::int64_t>{50, 50, 20}));
  EXPECT_EQ(get("/api/attempts?before=1")["attempts"].size(), 0U);
  for (const char* bad : {"x", "-1", "1x", "99999999999999999999", ""}) {
    HttpRequest request;
    request.target = std::string("/api/attempts?before=") + bad;
    request.guest.role = Role::Instructor;
    EXPECT_EQ(http_.answer(request).status, 400U) << bad;
  }
}

}  // namespace
}  // namespace carpus::server
