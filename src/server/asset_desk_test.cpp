// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// ASSET forms through real sockets on loopback: who may write and see which, and what each wrong
// form is answered.
#include "server/asset_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "protocol/bodies.hpp"
#include "server/access.hpp"
#include "server/attempt_messages.hpp"
#include "server/echo_test_support.hpp"
#include "server/loopback_client_test_support.hpp"
#include "server/network_server.hpp"
#include "session/score_message.hpp"

namespace carpus::server {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using Json = nlohmann::json;
using testing::host_of;
using testing::RawClient;

constexpr const char* kInstructor = "instructor-instructor-instructor";
constexpr const char* kTrainee = "trainee-trainee-trainee-trainee-";

/// A finished attempt; the score's only item is `item`.
records::Attempt make_attempt(const std::string& item, bool is_void = false) {
  procedure::ScoreReport score;
  score.is_void = is_void;
  score.items.push_back({});
  score.items.back().id = item;
  records::Attempt attempt;
  attempt.summary.outcome = records::Outcome::Finished;
  attempt.summary.overall = 61.0;
  attempt.score_json = protocol::serialize_stored_score(session::score_message(score));
  return attempt;
}

/// All rows at most at `points`, as the form has them.
Json answers_at(int points) {
  const auto& table = arthroscopy::AssetTable::built_in();
  Json answers = Json::array();
  for (const auto& domain : table.domains) {
    answers.push_back({{"domain", domain.id}, {"points", std::min(points, domain.highest)}});
  }
  answers.push_back({{"domain", table.complexity.id}, {"points", 1}});
  return answers;
}

Json rating(const std::string& rater, const Json& answers, int revision = 0) {
  return {{"rater", rater}, {"revision", revision}, {"answers", answers}, {"comment", "Well."}};
}

class AssetDeskTest : public ::testing::Test {
 protected:
  AssetDeskTest() {
    std::string name = (fs::temp_directory_path() / "carpus-asset-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    records_ = std::make_unique<records::AttemptKeeper>(folder_ / "attempts.sqlite");
    desk_ = std::make_unique<AssetDesk>(*records_, owners_);
    (void)records_->save(make_attempt("cartilage_seen_share"));        // 1
    (void)records_->save(make_attempt("bone_beside_screw_mm"));        // 2
    (void)records_->save(make_attempt("cartilage_seen_share", true));  // 3
    records::Attempt unfinished;
    (void)records_->save(unfinished);  // 4
    options_.port = 0;
    options_.links = AccessLinks{kTrainee, kInstructor};
    options_.lane_of = [](const HttpRequest&) { return std::size_t{1}; };
    options_.take_body = [this](const HttpRequest& request, std::uint64_t bytes) {
      return desk_->take_body(request, bytes);
    };
    server_ = std::make_unique<NetworkServer>(
        options_,
        [this](const HttpRequest& request) {
          return AssetDesk::is_for(request) ? desk_->answer(request) : make_json("{}");
        },
        echo_);
    thread_ = std::thread([this] { server_->run(); });
    instructor_ = cookie_for(kInstructor);
    trainee_ = cookie_for(kTrainee);
  }
  ~AssetDeskTest() override {
    server_->stop();
    thread_.join();
    server_.reset();
    desk_.reset();
    records_.reset();
    fs::remove_all(folder_);
  }

  [[nodiscard]] std::string cookie_for(const char* token) const {
    const std::string set(
        testing::request(server_->port(), std::string("/?token=") + token)["Set-Cookie"]);
    return set.substr(0, set.find(';'));
  }
  /// The browser's word in a cookie.
  static std::string browser_of(const std::string& cookie) {
    return cookie.substr(cookie.find('.') + 1);
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
  [[nodiscard]] std::string put(const Json& form, int attempt = 1) const {
    return ask("PUT", "/api/asset?attempt=" + std::to_string(attempt), instructor_, form.dump());
  }
  [[nodiscard]] std::string get(const std::string& cookie, int attempt = 1) const {
    return ask("GET", "/api/asset?attempt=" + std::to_string(attempt), cookie);
  }
  static protocol::AssetForms forms_in(const std::string& answer) {
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 200"));
    const auto read = protocol::parse_asset_forms(answer.substr(answer.find("\r\n\r\n") + 4));
    EXPECT_TRUE(read.has_value()) << answer;
    return read ? *read : protocol::AssetForms{};
  }

  fs::path folder_;
  AttemptOwners owners_;
  std::unique_ptr<records::AttemptKeeper> records_;
  std::unique_ptr<AssetDesk> desk_;
  NetworkOptions options_;
  testing::Echo echo_;
  std::unique_ptr<NetworkServer> server_;
  std::thread thread_;
  std::string instructor_;
  std::string trainee_;
};

TEST_F(AssetDeskTest, AFinishedFormIsToldWithItsSumAndVerdictAndChangesNoScore) {
  const auto forms = forms_in(put(rating("Dr A", answers_at(4))));
  EXPECT_EQ(forms.attempt, 1);
  EXPECT_TRUE(forms.may_rate);
  ASSERT_EQ(forms.forms.size(), 1U);
  const protocol::AssetForm& form = forms.forms.front();
  EXPECT_EQ(form.rater, "Dr A");
  EXPECT_EQ(form.total, 31);
  EXPECT_EQ(form.passes, true);
  EXPECT_EQ(form.revision, 1);
  EXPECT_EQ(form.answers.size(), 9U);
  EXPECT_EQ(form.comment, "Well.");
  const auto attempt = records_->find(1);
  EXPECT_EQ(attempt->summary.overall, 61.0);
  const auto list = attempt_list(records_->page(0, 10));
  ASSERT_TRUE(list.attempts.back().asset);
  EXPECT_EQ(*list.attempts.back().asset, (protocol::AssetSummary{1, 1, 31.0}));
}

TEST_F(AssetDeskTest, OneDomainBelowThreeDoesNotPassWhateverTheSum) {
  Json answers = answers_at(5);
  answers[0]["points"] = 2;
  const auto form = forms_in(put(rating("Dr A", answers))).forms.front();
  EXPECT_EQ(form.total, 35);
  EXPECT_EQ(form.passes, false);
}

TEST_F(AssetDeskTest, RemovingLooseBodiesIsRatedToo) {
  (void)records_->save(make_attempt("brought_out_share"));  // 5
  EXPECT_EQ(forms_in(put(rating("Dr A", answers_at(3)), 5)).attempt, 5);
}

TEST_F(AssetDeskTest, SeveralRateAndEachAmendsWhatTheySaw) {
  (void)forms_in(put(rating("Dr A", answers_at(3))));
  (void)forms_in(put(rating("Dr B", answers_at(5))));
  EXPECT_THAT(put(rating("Dr A", answers_at(1))), StartsWith("HTTP/1.1 409"));
  EXPECT_THAT(put(rating("Dr A", answers_at(1), 7)), HasSubstr("that you have not seen"));
  const auto forms = forms_in(put(rating("Dr A", answers_at(4), 1)));
  ASSERT_EQ(forms.forms.size(), 2U);
  EXPECT_EQ(forms.forms[0].rater, "Dr A");
  EXPECT_EQ(forms.forms[0].total, 31);
  EXPECT_EQ(forms.forms[0].revision, 2);
  EXPECT_EQ(forms.forms[1].total, 38);
}

TEST_F(AssetDeskTest, ATraineeSeesTheFinishedFormsOfTheirOwnAttemptsAlone) {
  (void)forms_in(put(rating("Dr A", answers_at(3))));
  (void)forms_in(put(rating("Dr B", Json::array({answers_at(3)[0]}))));
  EXPECT_THAT(get(trainee_), StartsWith("HTTP/1.1 404"));
  owners_.add(1, browser_of(trainee_));
  const auto seen = forms_in(get(trainee_));
  EXPECT_FALSE(seen.may_rate);
  ASSERT_EQ(seen.forms.size(), 1U);
  EXPECT_EQ(seen.forms.front().rater, "Dr A");
  const auto all = forms_in(get(instructor_));
  ASSERT_EQ(all.forms.size(), 2U);
  EXPECT_EQ(all.forms[1].total, std::nullopt);
  EXPECT_EQ(all.forms[1].passes, std::nullopt);
}

TEST_F(AssetDeskTest, OnlyAnInstructorWritesAndFromOurOwnPage) {
  owners_.add(1, browser_of(trainee_));
  const std::string form = rating("Dr A", answers_at(5)).dump();
  const std::string target = "/api/asset?attempt=1";
  EXPECT_THAT(ask("PUT", target, trainee_, form), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(ask("PUT", target, "", form), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(ask("PUT", target, instructor_, form, "http://evil.example"),
              StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(ask("PUT", target, instructor_, form, ""), StartsWith("HTTP/1.1 403"));
  EXPECT_TRUE(records_->asset_forms(1).empty());
  const auto refused = desk_->take_body({"PUT", target, {Role::Trainee, "ada"}}, 10);
  EXPECT_EQ(std::get<HttpResponse>(refused).status, 403U);
}

TEST_F(AssetDeskTest, OnlyAFinishedArthroscopyThatCountsIsRated) {
  const Json form = rating("Dr A", answers_at(5));
  EXPECT_THAT(put(form, 2), HasSubstr("Only an arthroscopy"));
  EXPECT_THAT(put(form, 3), HasSubstr("is void"));
  EXPECT_THAT(put(form, 4), HasSubstr("was not finished"));
  EXPECT_THAT(put(form, 99), StartsWith("HTTP/1.1 404"));
  for (int attempt = 2; attempt <= 4; ++attempt) {
    EXPECT_TRUE(records_->asset_forms(attempt).empty());
  }
  EXPECT_TRUE(forms_in(get(instructor_, 2)).forms.empty());
}

TEST_F(AssetDeskTest, WrongFormsAreRefusedWithASentenceAndNothingIsStored) {
  const auto refused = [&](const Json& form, const std::string& why) {
    const std::string answer = put(form);
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 400")) << form.dump().substr(0, 200);
    EXPECT_THAT(answer, HasSubstr(why));
  };
  const Json good = answers_at(5);
  refused(rating("", good), "Say who rates");
  refused(rating(" \t", good), "Say who rates");
  refused(rating("Dr A ", good), "ends with a blank");
  refused(rating("Dr\nA", good), "control character");
  refused(rating("Dr \u202E A", good), "direction of writing");
  refused(rating(std::string(65, 'x'), good), "rater");
  Json form = rating("Dr A", good);
  form["comment"] = std::string(2001, 'x');
  refused(form, "comment");
  form["comment"] = "a\x01";
  refused(form, "comment");
  form.erase("comment");
  refused(form, "comment");
  refused(rating("Dr A", Json::array({{{"domain", "style"}, {"points", 3}}})), "no row 'style'");
  refused(rating("Dr A", Json::array({{{"domain", "autonomy"}, {"points", 5}}})),
          "Autonomy has 1 to 3");
  refused(rating("Dr A", Json::array({{{"domain", "safety"}, {"points", 6}}})), "points");
  refused(rating("Dr A", Json::array({{{"domain", "safety"}, {"points", 2.5}}})), "points");
  refused(rating("Dr A", Json::array({good[0], good[0]})), "Safety is answered twice");
  Json many = good;
  while (many.size() < 17) many.push_back(good[0]);
  refused(rating("Dr A", many), "answers");
  refused(rating("Dr A", good, -1), "revision");
  refused(Json::array(), "The form cannot be read");
  for (const char* text : {"{", "null", "\xFF\xFE", "{\"rater\":\"a\"}"}) {
    EXPECT_THAT(ask("PUT", "/api/asset?attempt=1", instructor_, text), StartsWith("HTTP/1.1 400"))
        << text;
  }
  EXPECT_TRUE(records_->asset_forms(1).empty());
}

TEST_F(AssetDeskTest, WhatNamesNoAttemptOrIsTooLongIsRefusedBeforeItIsRead) {
  const std::string form = rating("Dr A", answers_at(5)).dump();
  for (const char* query : {"", "?attempt=", "?attempt=0", "?attempt=-1", "?attempt=x",
                            "?attempt=1x", "?attempt=99999999999999999999"}) {
    const std::string target = std::string("/api/asset") + query;
    EXPECT_THAT(ask("PUT", target, instructor_, form), StartsWith("HTTP/1.1 400")) << query;
    EXPECT_THAT(ask("GET", target, instructor_), StartsWith("HTTP/1.1 400")) << query;
  }
  EXPECT_THAT(ask("PUT", "/api/asset?attempt=1", instructor_, std::string(32769, ' ')),
              StartsWith("HTTP/1.1 413"));
  EXPECT_THAT(ask("PUT", "/api/asset/1", instructor_, form), StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(ask("DELETE", "/api/asset?attempt=1", instructor_), StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(ask("POST", "/api/asset?attempt=1", instructor_), StartsWith("HTTP/1.1 405"));
  EXPECT_TRUE(records_->asset_forms(1).empty());
}

TEST_F(AssetDeskTest, TheLongestCommentOfTheWidestLettersIsKept) {
  Json form = rating("Dr A", answers_at(5));
  std::string comment;
  for (int i = 0; i < 2000; ++i) comment += "\xF0\x9F\xA6\xB4";
  form["comment"] = comment;
  EXPECT_EQ(forms_in(put(form)).forms.front().comment, comment);
}

TEST_F(AssetDeskTest, WhoIsAloneOnThisMachineIsTheInstructor) {
  // Without links every guest is one (detail/http_session.cpp).
  const auto taken = desk_->take_body({"PUT", "/api/asset?attempt=1", {Role::Instructor, {}}}, 10);
  EXPECT_TRUE(std::holds_alternative<std::unique_ptr<BodyTaker>>(taken));
}

}  // namespace
}  // namespace carpus::server
