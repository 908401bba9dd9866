// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A whole station on loopback with a synthetic wrist, for tests whose client is real.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "protocol/types.hpp"
#include "server/loopback_client_test_support.hpp"
#include "server/station.hpp"
#include "server/station_http.hpp"
#include "simulation/operation_test_support.hpp"

namespace carpus::server::testing {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using namespace std::chrono_literals;
using Json = nlohmann::json;

inline std::string hello_of(const std::string& page) {
  return R"({"type":"hello","protocol":)" + std::to_string(protocol::kProtocolVersion) +
         R"(,"page":")" + page + R"("})";
}
inline const std::string kHello = hello_of("first");
inline const std::string kSecondHello = hello_of("second");
inline constexpr std::uint64_t kStartSeed = 7;  ///< in kStart
inline constexpr const char* kStart =
    R"({"type":"start","trainee":"Ada","procedure":"test_exercise",)"
    R"("input_device":"mouse","seed":7})";
inline constexpr const char* kHand =
    R"({"type":"hand","sequence":1,"hand":0,"tip_mm":[40,40,40],"shaft":[0,0.6,0.8],)"
    R"("thrust_n":2,"driver":"off","guidance":"direct"})";

using simulation::test::exercise;
using simulation::test::wrist;

inline const procedure::ProcedureList& procedures() {
  static const procedure::ProcedureList list({&exercise()});
  return list;
}

class StationTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "carpus-station-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    std::ofstream(folder_ / "index.html") << "<title>Carpus</title>";
    records_ = std::make_unique<records::AttemptKeeper>(folder_ / "attempts.sqlite");
    station_ = std::make_unique<Station>(
        wrist(), procedures(), *records_, [](const std::string&) {}, patience(),
        OverCases{[this](const std::string& id) {
                    if (id != "other") return false;
                    chosen_ = id;
                    network_->stop();
                    return true;
                  },
                  owners_});
    http_ = std::make_unique<StationHttp>(wrist(), procedures(), "glTF", *records_,
                                          RecordOwners{station_->owners(), station_->quiz_owners()},
                                          folder_);
    NetworkOptions options = network();
    options.port = 0;
    options.ping_interval = 100ms;
    network_ = std::make_unique<NetworkServer>(
        options, [this](const HttpRequest& r) { return http_->answer(r); }, *station_);
    station_->attach(*network_);
    thread_ = std::thread([this] { network_->run(); });
  }
  void TearDown() override {
    stop();
    station_.reset();
    network_.reset();
    fs::remove_all(folder_);
  }
  void stop() {
    network_->stop();
    if (thread_.joinable()) thread_.join();
  }
  [[nodiscard]] virtual StationPatience patience() const { return {600s, 600s}; }
  [[nodiscard]] virtual NetworkOptions network() const { return {}; }
  [[nodiscard]] std::uint16_t port() const { return network_->port(); }

  [[nodiscard]] static std::unique_ptr<PageClient> operate(std::uint16_t port,
                                                           const std::string& cookie = "") {
    auto page = std::make_unique<PageClient>(port, cookie);
    page->send(kHello);
    EXPECT_THAT(page->wait_for_type("welcome"), HasSubstr("\"exercise\":0,"));
    page->send(kStart);
    page->send(kHand);
    return page;
  }
  /// Says hello until it is answered by a message of this type, and returns that.
  static std::string say_hello(PageClient& page,
                               const std::string& hello,
                               const std::string& type) {
    std::string answer;
    for (int i = 0; i < 200 && answer.find("\"type\":\"" + type) == std::string::npos; ++i) {
      if (i > 0) std::this_thread::sleep_for(20ms);
      page.send(hello);
      const auto frame = page.wait_for([](const auto& f) {
        return !f.is_binary && (f.content.find("\"type\":\"busy") != std::string::npos ||
                                f.content.find("\"type\":\"welcome") != std::string::npos);
      });
      answer = frame ? frame->content : "";
    }
    return answer;
  }
  static constexpr const char* kGoOn = R"({"type":"pause","on":false})";

  /// Waits until the records hold so many attempts.
  void wait_for_attempts(std::size_t count) {
    for (int i = 0; i < 1000 && records_->list().size() < count; ++i) {
      std::this_thread::sleep_for(10ms);
    }
    ASSERT_EQ(records_->list().size(), count);
  }
  static Json wait_for_snapshot(PageClient& page, const std::function<bool(const Json&)>& fits) {
    Json found;
    (void)page.wait_for([&](const PageClient::Frame& frame) {
      if (frame.is_binary) return false;
      const Json json = Json::parse(frame.content);
      if (json["type"] != "snapshot" || !fits(json)) return false;
      found = json;
      return true;
    });
    EXPECT_FALSE(found.is_null()) << "no such snapshot";
    return found;
  }
  /// That a station which has said "paused" says the same tick for as long as it says so: counted
  /// in what it sends, so that a slow machine has as long as it needs.
  static void expect_time_stands(PageClient& page) {
    constexpr int kSnapshots = 12;
    const auto next = [&] { return wait_for_snapshot(page, [](const Json&) { return true; }); };
    const Json first = next();
    for (int i = 0; i < kSnapshots; ++i) {
      const Json later = next();
      EXPECT_TRUE(later["paused"].get<bool>());
      EXPECT_EQ(later["tick"], first["tick"]);
    }
  }

  fs::path folder_;
  std::unique_ptr<records::AttemptKeeper> records_;
  std::unique_ptr<Station> station_;
  std::unique_ptr<StationHttp> http_;
  std::unique_ptr<NetworkServer> network_;
  std::thread thread_;
  std::string chosen_;  ///< the case that a page chose
  std::shared_ptr<AttemptOwners> owners_ = std::make_shared<AttemptOwners>();
};

}  // namespace carpus::server::testing
