// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The station with a simulated arm: chosen, felt, unplugged while one operates, plugged in again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "devices/simulated_port.hpp"
#include "server/loopback_client_test_support.hpp"
#include "server/station.hpp"
#include "simulation/operation_test_support.hpp"

namespace carpus::server {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::PageClient;
using Json = nlohmann::json;

class StationDevicesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "carpus-station-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    devices::DeviceSearch search;
    search.serial_folders = {folder_ / "arms"};
    search.device_folder = search.input_folder = search.plugin_folder = folder_ / "none";
    search.calibrations = folder_ / "calibrations";
    plug_in();
    devices::store(port_->calibration(), search.calibrations);
    records_ = std::make_unique<records::AttemptKeeper>(folder_ / "attempts.sqlite");
    static const procedure::ProcedureList procedures({&simulation::test::exercise()});
    station_ = std::make_unique<Station>(simulation::test::wrist(), procedures, *records_,
                                         [](const std::string&) {});
    station_->offer_devices(search);
    NetworkOptions options;
    options.port = 0;
    options.ping_interval = std::chrono::milliseconds(100);
    network_ = std::make_unique<NetworkServer>(
        options, [](const HttpRequest&) { return HttpResponse{}; }, *station_);
    station_->attach(*network_);
    thread_ = std::thread([this] { network_->run(); });
    page_ = std::make_unique<PageClient>(network_->port());
    page_->send(R"({"type":"hello","protocol":)" + std::to_string(protocol::kProtocolVersion) +
                R"(,"page":"first"})");
    EXPECT_THAT(page_->wait_for_type("welcome"), HasSubstr("\"exercise\":0,"));
  }
  void TearDown() override {
    page_.reset();
    network_->stop();
    thread_.join();
    station_.reset();
    network_.reset();
    port_.reset();
    fs::remove_all(folder_);
  }
  void plug_in() {
    port_ = std::make_unique<devices::SimulatedPort>(firmware::Drive::Motor, 7, folder_ / "arms");
  }
  void use(const std::string& id, int hand = 0) {
    page_->send(R"({"type":"use_device","hand":)" + std::to_string(hand) + R"(,"device":")" + id +
                R"(","right":[1,0,0],"up":[0,0,1]})");
  }
  Json wait_for(const std::string& type, const std::function<bool(const Json&)>& fits) {
    Json found;
    (void)page_->wait_for([&](const PageClient::Frame& frame) {
      if (frame.is_binary) return false;
      const Json json = Json::parse(frame.content);
      if (json["type"] != type || !fits(json)) return false;
      found = json;
      return true;
    });
    EXPECT_FALSE(found.is_null()) << "no such " << type;
    return found;
  }
  Json wait_for_health(const std::string& health) {
    return wait_for("devices", [&](const Json& m) { return m["hands"][0]["health"] == health; });
  }
  std::string arm() {
    page_->send(R"({"type":"find_devices"})");
    const Json found = wait_for("devices", [](const Json& m) { return !m["found"].empty(); });
    return found["found"][0]["id"];
  }

  fs::path folder_;
  std::unique_ptr<devices::SimulatedPort> port_;
  std::unique_ptr<records::AttemptKeeper> records_;
  std::unique_ptr<Station> station_;
  std::unique_ptr<NetworkServer> network_;
  std::thread thread_;
  std::unique_ptr<PageClient> page_;
};

TEST_F(StationDevicesTest, AnArmIsChosenOperatesIsUnpluggedAndComesBack) {
  use(arm());
  const Json well = wait_for_health("good")["hands"][0];
  EXPECT_THAT(well["can"].get<std::string>(), HasSubstr("force"));
  EXPECT_EQ(well["most_force_n"], 8);
  EXPECT_EQ(well["aim"], "portal");  // it has no rotation of its own
  EXPECT_EQ(well["has_portal"], true);
  EXPECT_EQ(well["has_rotation"], false);
  page_->send(R"({"type":"use_device","hand":0,"device":")" + well["id"].get<std::string>() +
              R"(","aim":"page","right":[1,0,0],"up":[0,0,1]})");
  wait_for("devices", [](const Json& m) { return m["hands"][0]["aim"] == "page"; });
  page_->send(R"({"type":"start","trainee":"Ada","procedure":"test_exercise",)"
              R"("input_device":"arm","seed":7})");
  const auto snapshot = [this](const std::function<bool(const Json&)>& fits) {
    return wait_for("snapshot", fits);
  };
  // The hand of the simulated arm moves by itself: so does the tip.
  const Json first = snapshot([](const Json& s) { return s["tick"] > 100; });
  snapshot([&](const Json& s) {
    return s["items"][0]["tip_mm"] != first["items"][0]["tip_mm"] && s["tick"] > 300;
  });
  port_.reset();
  const Json told = wait_for("error", [](const Json&) { return true; });
  EXPECT_THAT(told["reason"].get<std::string>(), HasSubstr("unplugged"));
  EXPECT_THAT(told["reason"].get<std::string>(), HasSubstr("nothing of it is lost"));
  const Json paused = snapshot([](const Json& s) { return s["paused"] == true; });
  // It is not gone on with before the arm is back.
  page_->send(R"({"type":"pause","on":false})");
  EXPECT_THAT(page_->wait_for_type("error"), HasSubstr("unplugged"));
  EXPECT_EQ(snapshot([](const Json&) { return true; })["tick"], paused["tick"]);
  plug_in();
  wait_for_health("good");
  page_->send(R"({"type":"pause","on":false})");
  snapshot([&](const Json& s) { return s["tick"] > paused["tick"].get<int>() + 100; });
  // Or the hand is given to the page, and it goes on without.
  port_.reset();
  snapshot([](const Json& s) { return s["paused"] == true; });
  use("");
  page_->send(R"({"type":"pause","on":false})");
  snapshot([](const Json& s) { return s["paused"] == false; });
}

TEST_F(StationDevicesTest, ATestWallIsFeltWhileNoTimePasses) {
  const std::string id = arm();
  use(id);
  wait_for_health("good");
  page_->send(R"({"type":"test_wall","hand":0,"on":true})");
  // Its hand lies in the cradle still; within five seconds it goes 12 mm lower.
  const Json felt =
      wait_for("devices", [](const Json& m) { return m["hands"][0]["force_n"] > 0.3; });
  EXPECT_EQ(felt["hands"][0]["is_testing"], true);
  page_->send(R"({"type":"test_wall","hand":1,"on":true})");
  EXPECT_THAT(page_->wait_for_type("error"), HasSubstr("holds no device"));
  page_->send(R"({"type":"test_wall","hand":0,"on":false})");
  wait_for("devices", [](const Json& m) { return m["hands"][0]["is_testing"] == false; });
}

TEST_F(StationDevicesTest, OnlyWhatWasFoundCanBeChosenAndByOneHand) {
  use("arm:/dev/tty");
  EXPECT_THAT(page_->wait_for_type("error"), HasSubstr("no such device"));
  const std::string id = arm();
  use(id);
  wait_for_health("good");
  use(id, 1);
  EXPECT_THAT(page_->wait_for_type("error"), HasSubstr("other hand"));
}

TEST_F(StationDevicesTest, AnArmIsCalibratedFromThePage) {
  const fs::path file = folder_ / "calibrations" / "arm_b_7.json";
  use(arm());
  wait_for_health("good");
  fs::remove(file);
  const auto step = [this](const char* word) {
    page_->send(std::string(R"({"type":"calibrate","hand":0,"step":")") + word + "\"}");
  };
  step("take");
  EXPECT_THAT(page_->wait_for_type("error"), HasSubstr("begin one"));
  step("begin");
  const Json begun =
      wait_for("devices", [](const Json& m) { return m["hands"][0]["calibration"] != ""; });
  EXPECT_THAT(begun["hands"][0]["calibration"].get<std::string>(), HasSubstr("cradle"));
  step("cancel");
  wait_for("devices", [](const Json& m) {
    return m["hands"][0]["calibration"] == "" && m["hands"][0]["calibration_note"] != "";
  });
  EXPECT_FALSE(fs::exists(file));
}

}  // namespace
}  // namespace carpus::server
