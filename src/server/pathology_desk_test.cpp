// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is prepared to be wrong in a case, through real sockets on loopback: an instructor sets and
// sees it, a trainee neither, and while an assessed operation runs nobody.
#include "server/pathology_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "arthroscopy/named_grades.hpp"
#include "core/error.hpp"
#include "server/access.hpp"
#include "server/echo_test_support.hpp"
#include "server/loopback_client_test_support.hpp"
#include "server/network_server.hpp"

namespace carpus::server {
namespace {

using arthroscopy::PathologyTable;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Json = nlohmann::json;
using testing::host_of;
using testing::RawClient;

constexpr const char* kInstructor = "instructor-instructor-instructor";
constexpr const char* kTrainee = "trainee-trainee-trainee-trainee-";
constexpr const char* kOfDemo = "/api/pathology?case=demo";

Json chosen(const Json& grades) {
  return {{"origin", "chosen"}, {"seed", nullptr}, {"grades", grades}};
}

const Json kTorn = Json::array(
    {{{"finding", "scapholunate"}, {"grade", "III"}}, {{"finding", "disc"}, {"grade", "1B"}}});

/// A shelf with one case whose file is a value in memory.
class PathologyDeskTest : public ::testing::Test {
 protected:
  PathologyDeskTest() {
    ShelvedCase demo;
    demo.id = "demo";
    demo.folder = "/cases/demo";
    ShelvedCase hidden;
    hidden.id = "hidden";
    desk_ = std::make_unique<PathologyDesk>(
        std::make_shared<SharedShelf>(CaseShelf{{demo, hidden}, "demo"}), truth_,
        PathologyFiles{[this](const auto& folder) {
                         EXPECT_EQ(folder, "/cases/demo");
                         return held_;
                       },
                       [this](const auto& folder, const auto& pathology) {
                         EXPECT_EQ(folder, "/cases/demo");
                         if (is_disk_full_) throw IoError("pathology.json: the disk is full");
                         held_ = pathology;
                       }});
    options_.port = 0;
    options_.links = AccessLinks{kTrainee, kInstructor};
    options_.lane_of = [](const HttpRequest&) { return std::size_t{1}; };
    options_.take_body = [this](const HttpRequest& request, std::uint64_t bytes) {
      return desk_->take_body(request, bytes);
    };
    server_ = std::make_unique<NetworkServer>(
        options_,
        [this](const HttpRequest& request) {
          return PathologyDesk::is_for(request) ? desk_->answer(request) : make_json("{}");
        },
        echo_);
    thread_ = std::thread([this] { server_->run(); });
    instructor_ = cookie_for(kInstructor);
    trainee_ = cookie_for(kTrainee);
  }
  ~PathologyDeskTest() override {
    server_->stop();
    thread_.join();
  }

  [[nodiscard]] std::string cookie_for(const char* token) const {
    const std::string set(
        testing::request(server_->port(), std::string("/?token=") + token)["Set-Cookie"]);
    return set.substr(0, set.find(';'));
  }
  [[nodiscard]] std::string ask(const std::string& method,
                                const std::string& target,
                                const std::string& cookie,
                                const std::string& body = {},
                                std::string origin = "own") const {
    if (origin == "own") origin = "http://" + host_of(server_->port());
    std::string head = method + " " + target + " HTTP/1.1\r\nHost: " + host_of(server_->port()) +
                       "\r\nConnection: close\r\nCookie: " + cookie + "\r\n";
    if (!origin.empty()) head += "Origin: " + origin + "\r\n";
    if (!body.empty()) head += "Content-Length: " + std::to_string(body.size()) + "\r\n";
    RawClient client(server_->port());
    client.send(head + "\r\n" + body);
    return client.read_to_end();
  }
  [[nodiscard]] std::string put(const Json& wish) const {
    return ask("PUT", kOfDemo, instructor_, wish.dump());
  }
  static protocol::CasePathology told_in(const std::string& answer) {
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 200"));
    const auto read = protocol::parse_case_pathology(answer.substr(answer.find("\r\n\r\n") + 4));
    EXPECT_TRUE(read.has_value()) << answer;
    return read ? *read : protocol::CasePathology{};
  }

  std::optional<cases::PreparedPathology> held_;
  bool is_disk_full_ = false;
  std::shared_ptr<TruthGate> truth_ = std::make_shared<TruthGate>();
  std::unique_ptr<PathologyDesk> desk_;
  NetworkOptions options_;
  testing::Echo echo_;
  std::unique_ptr<NetworkServer> server_;
  std::thread thread_;
  std::string instructor_;
  std::string trainee_;
};

TEST_F(PathologyDeskTest, AnInstructorChoosesAndIsToldWhatTheCaseHolds) {
  const auto before = told_in(ask("GET", kOfDemo, instructor_));
  ASSERT_TRUE(before.prepared);
  EXPECT_EQ(before.prepared->origin, protocol::PathologyOrigin::Random);
  EXPECT_EQ(before.findings.size(), PathologyTable::generic().findings.size());
  const auto after = told_in(put(chosen(kTorn)));
  ASSERT_TRUE(held_);
  EXPECT_FALSE(held_->is_drawn);
  const std::vector<arthroscopy::NamedGrade> named =
      named_grades(held_->grades, PathologyTable::generic());
  EXPECT_EQ(named, (std::vector<arthroscopy::NamedGrade>{{"scapholunate", "III"}, {"disc", "1B"}}));
  ASSERT_TRUE(after.prepared);
  EXPECT_EQ(after.prepared->origin, protocol::PathologyOrigin::Chosen);
  ASSERT_EQ(after.prepared->grades.size(), 2U);
  EXPECT_EQ(after.prepared->grades[0].grade, "III");
}

TEST_F(PathologyDeskTest, HealthyBySeedAndAtRandomAgain) {
  (void)told_in(put(chosen(Json::array())));
  EXPECT_EQ(held_, cases::PreparedPathology{});
  const auto drawn = told_in(put({{"origin", "seed"}, {"seed", 7}, {"grades", Json::array()}}));
  EXPECT_EQ(held_, arthroscopy::drawn_pathology(7, PathologyTable::generic()));
  EXPECT_EQ(drawn.prepared->seed, 7);
  (void)told_in(put({{"origin", "random"}, {"grades", Json::array()}}));
  EXPECT_EQ(held_, std::nullopt);
}

TEST_F(PathologyDeskTest, ATraineeIsToldNothingAndChangesNothing) {
  (void)told_in(put(chosen(kTorn)));
  const auto held = held_;
  const auto may = told_in(ask("GET", "/api/pathology", trainee_));
  EXPECT_FALSE(may.may_prepare);
  EXPECT_TRUE(may.findings.empty());
  EXPECT_EQ(may.prepared, std::nullopt);
  for (const std::string& cookie : {trainee_, std::string()}) {
    const std::string told = ask("GET", kOfDemo, cookie);
    EXPECT_THAT(told, StartsWith("HTTP/1.1 403"));
    EXPECT_THAT(told, Not(HasSubstr("scapholunate")));
    EXPECT_THAT(ask("PUT", kOfDemo, cookie, chosen(Json::array()).dump()),
                StartsWith("HTTP/1.1 403"));
  }
  EXPECT_EQ(held_, held);
  const auto refused = desk_->take_body({"PUT", kOfDemo, {Role::Trainee, "ada"}}, 10);
  EXPECT_EQ(std::get<HttpResponse>(refused).status, 403U);
}

TEST_F(PathologyDeskTest, OnlyFromOurOwnPage) {
  const std::string wish = chosen(kTorn).dump();
  EXPECT_THAT(ask("PUT", kOfDemo, instructor_, wish, "http://evil.example"),
              StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(ask("PUT", kOfDemo, instructor_, wish, ""), StartsWith("HTTP/1.1 403"));
  EXPECT_EQ(held_, std::nullopt);
}

TEST_F(PathologyDeskTest, NobodyWhileAnAssessedOperationRuns) {
  truth_->close(true);
  EXPECT_THAT(ask("GET", kOfDemo, instructor_), StartsWith("HTTP/1.1 409"));
  EXPECT_THAT(put(chosen(kTorn)), StartsWith("HTTP/1.1 409"));
  EXPECT_EQ(held_, std::nullopt);
  truth_->close(false);
  (void)told_in(put(chosen(kTorn)));
}

TEST_F(PathologyDeskTest, WrongWishesAreRefusedWithASentenceAndNothingIsWritten) {
  (void)told_in(put(chosen(kTorn)));
  const auto held = held_;
  const Json meniscus = Json::array({{{"finding", "meniscus"}, {"grade", "I"}}});
  const Json fifth = Json::array({{{"finding", "scapholunate"}, {"grade", "V"}}});
  EXPECT_THAT(put(chosen(meniscus)), HasSubstr("there are scapholunate, lunotriquetral"));
  EXPECT_THAT(put(chosen(fifth)), HasSubstr("it has 0, I, II, III, IV"));
  EXPECT_THAT(put({{"origin", "seed"}, {"grades", Json::array()}}), HasSubstr("needs the seed"));
  for (const std::string& text :
       {std::string("{"), std::string("[]"), std::string(R"({"origin":"luck","grades":[]})")}) {
    EXPECT_THAT(ask("PUT", kOfDemo, instructor_, text), StartsWith("HTTP/1.1 400")) << text;
  }
  EXPECT_THAT(ask("PUT", kOfDemo, instructor_, std::string(16385, ' ')),
              StartsWith("HTTP/1.1 413"));
  for (const char* target : {"/api/pathology?case=other", "/api/pathology?case=hidden",
                             "/api/pathology?case=", "/api/pathology?case=../demo"}) {
    EXPECT_THAT(ask("PUT", target, instructor_, chosen(kTorn).dump()), StartsWith("HTTP/1.1 404"))
        << target;
    EXPECT_THAT(ask("GET", target, instructor_), StartsWith("HTTP/1.1 404")) << target;
  }
  EXPECT_THAT(ask("PUT", "/api/pathology/demo", instructor_, "{}"), StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(ask("DELETE", kOfDemo, instructor_), StartsWith("HTTP/1.1 405"));
  is_disk_full_ = true;
  EXPECT_THAT(put(chosen(Json::array())), HasSubstr("the disk is full. Nothing was changed"));
  EXPECT_EQ(held_, held);
}

}  // namespace
}  // namespace carpus::server
