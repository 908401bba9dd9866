// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The one way on which bodies come in, through real sockets on loopback: what is taken, who may
// bring it, what each wrong form is answered, and that nothing stays of what is given up.
#include "server/new_case_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "server/echo_test_support.hpp"
#include "server/loopback_client_test_support.hpp"
#include "server/network_server.hpp"

namespace carpus::server {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using namespace std::chrono_literals;
using Json = nlohmann::json;
using testing::host_of;
using testing::kPatience;
using testing::RawClient;

constexpr const char* kInstructor = "instructor-instructor-instructor";
constexpr const char* kTrainee = "trainee-trainee-trainee-trainee-";

class NewCaseDeskTest : public ::testing::Test {
 protected:
  NewCaseDeskTest() {
    std::string name = (fs::temp_directory_path() / "carpus-desk-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    fs::create_directories(incoming() / "left-by-a-kill");
    desk_options_.incoming = incoming();
    desk_options_.truth = truth_;
    desk_options_.least_free_bytes = 0;
    desk_options_.make = [this](const NewCaseTask& task, const Progress& progress,
                                const std::atomic<bool>& stop) {
      progress("surfaces", 0.5);
      made_of_ = task;
      for (const std::string& file : task.files) {
        std::ifstream stream(task.folder / file, std::ios::binary);
        brought_[file] = std::string((std::istreambuf_iterator<char>(stream)), {});
      }
      while (waits_ && !stop) std::this_thread::sleep_for(1ms);
      if (!offers_.empty() && task.series_uid.empty()) return NewCaseOutcome{{}, "two", offers_};
      if (task.purpose != NewCasePurpose::Case) {
        fs::create_directories(task.folder / "mended");
        std::ofstream(task.folder / "mended" / "bones.glb") << "surfaces";
        std::ofstream(task.folder / "mended" / "secret") << "no";
        NewCaseOutcome look;
        look.made = task.folder / "mended";
        return look;
      }
      return NewCaseOutcome{"demo-2", {}};
    };
    network_options_.port = 0;
    network_options_.request_timeout = 400ms;
    network_options_.linger_timeout = 200ms;
  }
  ~NewCaseDeskTest() override {
    waits_ = false;
    if (server_) server_->stop();
    if (thread_.joinable()) thread_.join();
    server_.reset();
    desk_.reset();
    fs::remove_all(folder_);
  }
  void start() {
    desk_ = std::make_unique<NewCaseDesk>(desk_options_);
    network_options_.lane_of = [](const HttpRequest& request) {
      return NewCaseDesk::is_for(request) ? NetworkOptions::kLanes : 0;
    };
    network_options_.take_body = [this](const HttpRequest& request, std::uint64_t bytes) {
      return desk_->take_body(request, bytes);
    };
    server_ = std::make_unique<NetworkServer>(
        network_options_,
        [this](const HttpRequest& request) {
          return NewCaseDesk::is_for(request) ? desk_->answer(request) : make_json("{}");
        },
        echo_);
    server_->repeat(20ms, [this] { desk_->tend(); });
    thread_ = std::thread([this] { server_->run(); });
  }
  [[nodiscard]] fs::path incoming() const { return folder_ / "incoming"; }
  [[nodiscard]] bool is_clean() const { return fs::is_empty(incoming()); }
  void expect_clean_soon() const {
    const auto until = std::chrono::steady_clock::now() + kPatience;
    while (!is_clean() && std::chrono::steady_clock::now() < until)
      std::this_thread::sleep_for(2ms);
    EXPECT_TRUE(is_clean());
  }
  /// @param fields  in place of our own page's Origin
  [[nodiscard]] std::string head(const std::string& method,
                                 const std::string& target,
                                 std::string fields = "own") const {
    if (fields == "own") fields = "Origin: http://" + host_of(server_->port()) + "\r\n";
    return method + " " + target + " HTTP/1.1\r\nHost: " + host_of(server_->port()) +
           "\r\nConnection: close\r\n" + fields;
  }
  [[nodiscard]] std::string ask(const std::string& whole) const {
    RawClient client(server_->port());
    client.send(whole);
    return client.read_to_end();
  }
  [[nodiscard]] std::string change(const std::string& method, const std::string& target) const {
    return ask(head(method, target) + "\r\n");
  }
  [[nodiscard]] std::string put(const std::string& target, const std::string& body) const {
    return ask(head("PUT", target) + "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" +
               body);
  }
  static std::string body_of(const std::string& answer) {
    const std::size_t end = answer.find("\r\n\r\n");
    return end == std::string::npos ? "" : answer.substr(end + 4);
  }
  std::string begin() {
    const std::string answer = change("POST", "/api/new_case");
    const Json json = Json::parse(body_of(answer), nullptr, false);
    EXPECT_TRUE(json.is_object()) << answer;
    return json.value("word", "");
  }
  [[nodiscard]] static std::string file(const std::string& word, const std::string& as = "dcm") {
    return "/api/new_case/file?word=" + word + "&as=" + as;
  }
  [[nodiscard]] Json state(const std::string& word) const {
    return Json::parse(body_of(change("GET", "/api/new_case?word=" + word)), nullptr, false);
  }
  Json wait_for(const std::string& word, const std::string& wanted) const {
    const auto until = std::chrono::steady_clock::now() + kPatience;
    Json now = state(word);
    while (now.value("state", "") != wanted && std::chrono::steady_clock::now() < until) {
      now = state(word);
    }
    EXPECT_EQ(now.value("state", ""), wanted);
    return now;
  }

  fs::path folder_;
  NewCaseOptions desk_options_;
  NetworkOptions network_options_;
  std::shared_ptr<TruthGate> truth_ = std::make_shared<TruthGate>();
  std::atomic<bool> waits_{false};
  NewCaseTask made_of_;
  std::vector<SeriesOffer> offers_;
  std::map<std::string, std::string> brought_;
  testing::Echo echo_;
  std::unique_ptr<NewCaseDesk> desk_;
  std::unique_ptr<NetworkServer> server_;
  std::thread thread_;
};

TEST_F(NewCaseDeskTest, FilesComeWholeUnderNamesOfOursAndNothingStays) {
  start();
  EXPECT_TRUE(is_clean()) << "what a killed station left";
  const std::string word = begin();
  std::string large(3'000'000, 'x');
  for (std::size_t i = 0; i < large.size(); ++i) large[i] = static_cast<char>(i * 31 >> 3U);
  EXPECT_THAT(put(file(word), large), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(put(file(word), "second"), StartsWith("HTTP/1.1 200"));
  EXPECT_EQ(state(word)["files"], 2);
  const auto mode = fs::status(incoming() / word / "00001.dcm").permissions();
  EXPECT_EQ(mode & (fs::perms::group_all | fs::perms::others_all), fs::perms::none);
  waits_ = true;
  EXPECT_THAT(change("POST", "/api/new_case/run?word=" + word + "&title=A%20wrist"),
              StartsWith("HTTP/1.1 200"));
  const Json working = wait_for(word, "working");
  EXPECT_THAT(change("POST", "/api/new_case"), HasSubstr("Another page"));
  waits_ = false;
  EXPECT_EQ(wait_for(word, "done")["id"], "demo-2");
  EXPECT_EQ(made_of_.title, "A wrist");
  EXPECT_EQ(brought_.at("00001.dcm"), large);
  EXPECT_EQ(brought_.at("00002.dcm"), "second");
  expect_clean_soon();
}

TEST_F(NewCaseDeskTest, SeveralFilesComeOnOneConnection) {
  start();
  const std::string word = begin();
  std::string all;
  for (const char* body : {"one", "two"}) {
    std::string one = head("PUT", file(word)) + "Content-Length: 3\r\n\r\n" + body;
    one.erase(one.find("Connection: close\r\n"), 19);
    all += one;
  }
  EXPECT_THAT(ask(all + head("GET", "/api/new_case?word=" + word) + "\r\n"),
              HasSubstr("\"files\":2"));
}

TEST_F(NewCaseDeskTest, WhatIsGivenUpLeavesNothing) {
  start();
  std::string word = begin();
  EXPECT_THAT(put(file(word), "slice"), StartsWith("HTTP/1.1 200"));
  EXPECT_FALSE(is_clean());
  EXPECT_THAT(change("DELETE", "/api/new_case?word=" + word), StartsWith("HTTP/1.1 200"));
  expect_clean_soon();
  word = begin();
  EXPECT_THAT(put(file(word), "slice"), StartsWith("HTTP/1.1 200"));
  waits_ = true;
  EXPECT_THAT(change("POST", "/api/new_case/run?word=" + word), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(change("DELETE", "/api/new_case?word=" + word), StartsWith("HTTP/1.1 200"));
  expect_clean_soon();
}

TEST_F(NewCaseDeskTest, OfSeveralSeriesOneIsChosenByAPerson) {
  offers_ = {{"1.2.3", "Wrist bone", 200, {0.3, 0.3, 0.5}}, {"1.2.4", "Wrist soft", 90, {}}};
  start();
  const std::string word = begin();
  EXPECT_THAT(put(file(word), "slice"), StartsWith("HTTP/1.1 200"));
  const std::string run = "/api/new_case/run?word=" + word;
  EXPECT_THAT(change("POST", run + "&title=A%20wrist"), StartsWith("HTTP/1.1 200"));
  const Json choosing = wait_for(word, "choosing");
  EXPECT_EQ(choosing["series"][0],
            Json::parse(R"({"description":"Wrist bone","slices":200,"spacing_mm":[0.3,0.3,0.5]})"))
      << "and nothing else: a UID names a study";
  EXPECT_EQ(choosing["series"].size(), 2U);
  EXPECT_THAT(put(file(word), "slice"), StartsWith("HTTP/1.1 409"));
  EXPECT_THAT(change("POST", "/api/new_case"), HasSubstr("Another page"));
  for (const char* wrong : {"", "&series=", "&series=2", "&series=-1", "&series=1.2.4"}) {
    EXPECT_THAT(change("POST", run + wrong), StartsWith("HTTP/1.1 400")) << wrong;
  }
  EXPECT_THAT(change("POST", run + "&series=1"), StartsWith("HTTP/1.1 200"));
  EXPECT_EQ(wait_for(word, "done")["id"], "demo-2");
  EXPECT_EQ(made_of_.series_uid, "1.2.4");
  EXPECT_EQ(made_of_.title, "A wrist");
  expect_clean_soon();
}

TEST_F(NewCaseDeskTest, ALookGivesOutWhatItMadeAndNothingElseUntilItIsGivenUp) {
  start();
  const std::string word = begin();
  const std::string made = "/api/new_case/made?word=" + word + "&file=";
  EXPECT_THAT(change("GET", made + "bones.glb"), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(put(file(word, "nii.gz"), "now"), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(put(file(word, "nii.gz"), "before"), StartsWith("HTTP/1.1 200"));
  const std::string run = "/api/new_case/run?word=" + word;
  EXPECT_THAT(change("POST", run + "&look=1"), StartsWith("HTTP/1.1 400")) << "of no case";
  EXPECT_THAT(change("POST", run + "&of=demo"), StartsWith("HTTP/1.1 400")) << "two for a case";
  EXPECT_THAT(change("POST", run + "&of=demo&look=1&grow=1"), StartsWith("HTTP/1.1 200"));
  EXPECT_EQ(wait_for(word, "done")["problem"], "");
  EXPECT_EQ(made_of_.purpose, NewCasePurpose::GrownLook);
  EXPECT_EQ(made_of_.files.size(), 2U);
  EXPECT_EQ(body_of(change("GET", made + "bones.glb")), "surfaces");
  for (const char* other : {"labels.nii.gz", "secret", "..%2F00001.nii.gz", ""}) {
    EXPECT_THAT(change("GET", made + other), StartsWith("HTTP/1.1 404")) << other;
  }
  EXPECT_THAT(change("GET", "/api/new_case/made?word=other&file=bones.glb"),
              StartsWith("HTTP/1.1 409"));
  EXPECT_THAT(change("DELETE", "/api/new_case?word=" + word), StartsWith("HTTP/1.1 200"));
  expect_clean_soon();
}

TEST_F(NewCaseDeskTest, ALookThatNobodyFetchesIsThrownAway) {
  desk_options_.lapse = 300ms;
  start();
  const std::string word = begin();
  EXPECT_THAT(put(file(word, "nii.gz"), "now"), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(change("POST", "/api/new_case/run?word=" + word + "&of=demo&look=1"),
              StartsWith("HTTP/1.1 200"));
  wait_for(word, "done");
  expect_clean_soon();
}

TEST_F(NewCaseDeskTest, AChoiceThatNobodyMakesIsGivenUp) {
  offers_ = {{"1", "a", 9, {}}, {"2", "b", 9, {}}};
  desk_options_.lapse = 300ms;
  start();
  const std::string word = begin();
  EXPECT_THAT(put(file(word), "slice"), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(change("POST", "/api/new_case/run?word=" + word), StartsWith("HTTP/1.1 200"));
  wait_for(word, "choosing");
  expect_clean_soon();
}

TEST_F(NewCaseDeskTest, ALineThatBreaksInAFileTakesAllOfItBack) {
  start();
  const std::string word = begin();
  EXPECT_THAT(put(file(word), "slice"), StartsWith("HTTP/1.1 200"));
  {
    RawClient client(server_->port());
    client.send(head("PUT", file(word)) + "Content-Length: 100000\r\n\r\n" +
                std::string(5000, 'x'));
  }
  expect_clean_soon();
  EXPECT_THAT(change("GET", "/api/new_case?word=" + word), StartsWith("HTTP/1.1 409"));
}

TEST_F(NewCaseDeskTest, APageThatFallsSilentIsForgotten) {
  desk_options_.lapse = 200ms;
  start();
  const std::string word = begin();
  EXPECT_THAT(put(file(word), "slice"), StartsWith("HTTP/1.1 200"));
  expect_clean_soon();
  EXPECT_NE(begin(), word);
}

TEST_F(NewCaseDeskTest, ABodyThatComesTooSlowlyIsGivenUp) {
  network_options_.least_body_bytes_per_s = 1e6;
  start();
  const std::string word = begin();
  RawClient client(server_->port());
  client.send(head("PUT", file(word)) + "Content-Length: 100000\r\n\r\n");
  const auto from = std::chrono::steady_clock::now();
  while (client.send("x") && std::chrono::steady_clock::now() < from + kPatience) {
    std::this_thread::sleep_for(50ms);  // each within the time for a piece
  }
  EXPECT_LT(std::chrono::steady_clock::now() - from, kPatience);
  expect_clean_soon();
}

TEST_F(NewCaseDeskTest, OnlyInstructorsFromOurOwnPage) {
  network_options_.links = AccessLinks{kTrainee, kInstructor};
  start();
  const auto cookie = [&](const char* token) {
    const std::string set(
        testing::request(server_->port(), std::string("/?token=") + token)["Set-Cookie"]);
    return "Cookie: " + set.substr(0, set.find(';')) + "\r\n";
  };
  const std::string own = "Origin: http://" + host_of(server_->port()) + "\r\n";
  const std::string length = "Content-Length: 3\r\n\r\nabc";
  for (const char* method : {"POST", "DELETE"}) {
    EXPECT_THAT(ask(head(method, "/api/new_case", own + cookie(kTrainee)) + "\r\n"),
                StartsWith("HTTP/1.1 403"));
    EXPECT_THAT(ask(head(method, "/api/new_case", own) + "\r\n"), StartsWith("HTTP/1.1 403"));
    EXPECT_THAT(ask(head(method, "/api/new_case", cookie(kInstructor)) + "\r\n"),
                StartsWith("HTTP/1.1 403"));
    EXPECT_THAT(
        ask(head(method, "/api/new_case", "Origin: http://evil.example\r\n" + cookie(kInstructor)) +
            "\r\n"),
        StartsWith("HTTP/1.1 403"));
  }
  EXPECT_THAT(ask(head("PUT", file("x"), own + cookie(kTrainee)) + length),
              StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(ask(head("PUT", file("x"), cookie(kInstructor)) + length),
              StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(ask(head("GET", "/api/new_case", cookie(kTrainee)) + "\r\n"),
              HasSubstr(R"({"may_add":false})"));
  EXPECT_THAT(ask(head("GET", "/api/new_case", cookie(kInstructor)) + "\r\n"),
              HasSubstr(R"({"may_add":true})"));
  EXPECT_THAT(ask(head("GET", "/api/new_case?word=x", cookie(kTrainee)) + "\r\n"),
              StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(ask(head("POST", "/api/new_case", own + cookie(kInstructor)) + "\r\n"),
              StartsWith("HTTP/1.1 200"));
}

TEST_F(NewCaseDeskTest, WrongFormsAreRefusedAndNothingIsStored) {
  desk_options_.most_bytes = 1000;
  desk_options_.most_files = 2;
  start();
  const std::string word = begin();
  const std::string folder = file(word);
  const auto raw = [&](const std::string& fields) {
    return ask(head("PUT", folder) + fields + "\r\nabc");
  };
  EXPECT_THAT(raw(""), StartsWith("HTTP/1.1 411"));
  EXPECT_THAT(raw("Content-Length: 0\r\n"), StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(raw("Content-Length: 3\r\nContent-Length: 3\r\n"), StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(raw("Content-Length: 3, 3\r\n"), StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(raw("Content-Length: +3\r\n"), StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(raw("Content-Length: 18446744073709551619\r\n"), StartsWith("HTTP/1.1 413"));
  EXPECT_THAT(raw("Content-Length: 1073741825\r\n"), StartsWith("HTTP/1.1 413"));
  EXPECT_THAT(raw("Content-Length: 1001\r\n"), HasSubstr("are not taken at once"));
  EXPECT_THAT(raw("Transfer-Encoding: chunked\r\n"), StartsWith("HTTP/1.1 413"));
  EXPECT_THAT(raw("Transfer-Encoding: chunked\r\nContent-Length: 3\r\n"),
              StartsWith("HTTP/1.1 400"));
  for (const char* as : {"", "exe", "dcm/../../x", "..", "zip", "nii.gz%00"}) {
    EXPECT_THAT(put(file(word, as), "abc"), StartsWith("HTTP/1.1 415")) << as;
  }
  EXPECT_THAT(put(folder + "&as=nii", "abc"), StartsWith("HTTP/1.1 415")) << "said twice";
  EXPECT_THAT(put(file("0123"), "abc"), StartsWith("HTTP/1.1 409"));
  EXPECT_THAT(put("/api/new_case/other?word=" + word, "abc"), StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(put("/api/cases", "abc"), StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(ask(head("POST", "/api/new_case") + "Content-Length: 3\r\n\r\nabc"),
              StartsWith("HTTP/1.1 413"));
  EXPECT_THAT(ask(head("GET", "/api/new_case") + "Content-Length: 3\r\n\r\nabc"),
              StartsWith("HTTP/1.1 413"));
  EXPECT_TRUE(fs::is_empty(incoming() / word));
  const std::string run = "/api/new_case/run?word=" + word;
  EXPECT_THAT(change("POST", run), HasSubstr("no file"));
  EXPECT_THAT(put(folder, "abc"), StartsWith("HTTP/1.1 200"));
  for (const char* rest : {"&of=demo", "&title=%0a", "&title=%zz", "&title=a&title=b"}) {
    EXPECT_THAT(change("POST", run + rest), StartsWith("HTTP/1.1 400")) << rest;
  }
  EXPECT_THAT(change("POST", run + "&title=" + std::string(101, 'x')), StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(put(folder, "abc"), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(put(folder, "abc"), HasSubstr("More than 2 files"));
}

TEST_F(NewCaseDeskTest, AFullDiskIsSaidAndTakesAllOfItBack) {
  desk_options_.least_free_bytes = ~std::uint64_t{0} >> 1U;
  start();
  EXPECT_THAT(put(file(begin()), "abc"), StartsWith("HTTP/1.1 507"));
  expect_clean_soon();
}

TEST_F(NewCaseDeskTest, NothingIsBegunOrMadeWhileSomebodyIsAssessed) {
  start();
  const std::string word = begin();
  EXPECT_THAT(put(file(word), "abc"), StartsWith("HTTP/1.1 200"));
  truth_->close(true);
  EXPECT_THAT(change("POST", "/api/new_case/run?word=" + word), StartsWith("HTTP/1.1 409"));
  EXPECT_THAT(change("DELETE", "/api/new_case?word=" + word), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(change("POST", "/api/new_case"), StartsWith("HTTP/1.1 409"));
}

}  // namespace
}  // namespace carpus::server
