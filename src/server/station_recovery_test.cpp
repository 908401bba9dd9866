// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A station in a process of its own that is killed, and the one that is started after it: what a
// page sees of that.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "records/journals_left_behind.hpp"
#include "server/log_writer.hpp"
#include "server/loopback_client_test_support.hpp"
#include "server/station.hpp"
#include "simulation/operation_test_support.hpp"

namespace carpus::server {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using ::testing::HasSubstr;
using testing::PageClient;
using Json = nlohmann::json;
using simulation::test::exercise;
using simulation::test::wrist;

std::string hello() {
  return R"({"type":"hello","protocol":)" + std::to_string(protocol::kProtocolVersion) +
         R"(,"page":"first"})";
}
constexpr const char* kStart = R"({"type":"start","trainee":"Ada","procedure":"test_exercise",)"
                               R"("input_device":"mouse","seed":7})";
constexpr const char* kGoOn = R"({"type":"pause","on":false})";

/// `carpus serve` without its command line, in a child process.
class StationProcess {
 public:
  /// @param log  where its lines go; nowhere without it.
  explicit StationProcess(const fs::path& records, int log = -1) {
    (void)wrist();  // made once, shared by all children
    std::array<int, 2> pipe{};
    EXPECT_EQ(::pipe(pipe.data()), 0);
    child_ = ::fork();
    if (child_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      // A sanitizer would make a report of these instead of dying.
      for (const int fatal : {SIGSEGV, SIGABRT}) std::signal(fatal, SIG_DFL);
      ::close(pipe[0]);
      ::_exit(serve(records, log, pipe[1]));
    }
    ::close(pipe[1]);
    EXPECT_EQ(::read(pipe[0], &port_, sizeof port_), static_cast<ssize_t>(sizeof port_));
    ::close(pipe[0]);
  }
  ~StationProcess() {
    if (child_ > 0) (void)end(SIGKILL);
  }
  StationProcess(const StationProcess&) = delete;
  StationProcess& operator=(const StationProcess&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }
  void send(int signal) const { ::kill(child_, signal); }
  /// Its exit status, or the negative signal that ended it.
  int end(int signal) {
    send(signal);
    int status = 0;
    ::waitpid(std::exchange(child_, 0), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  static int serve(const fs::path& records_file, int log_file, int port_pipe) {
    static const procedure::ProcedureList procedures({&exercise()});
    LogWriter log(log_file >= 0 ? log_file : ::open("/dev/null", O_WRONLY | O_CLOEXEC));
    const auto say = [&](const std::string& line) { log.write("  station: " + line); };
    records::AttemptKeeper records(records_file, say);
    Station station(wrist(), procedures, records, say);
    NetworkOptions options;
    options.port = 0;
    options.ping_interval = 100ms;
    NetworkServer network(
        options, [](const HttpRequest&) { return HttpResponse{}; }, station);
    station.attach(network);
    network.stop_on_signals();
    const std::uint16_t port = network.port();
    if (::write(port_pipe, &port, sizeof port) != sizeof port) return 3;
    network.run();
    station.detach();
    return records.settle() == 0 ? 0 : 1;
  }

  pid_t child_ = 0;
  std::uint16_t port_ = 0;
};

class StationRecoveryTest : public ::testing::Test {
 protected:
  StationRecoveryTest() {
    std::string name = (fs::temp_directory_path() / "carpus-recovery-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    records_ = folder_ / "attempts.sqlite";
  }
  ~StationRecoveryTest() override { fs::remove_all(folder_); }

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
  static std::unique_ptr<PageClient> greeted(std::uint16_t port) {
    auto page = std::make_unique<PageClient>(port);
    page->send(hello());
    return page;
  }
  [[nodiscard]] std::vector<fs::path> journals() const {
    return records::files_beside(records_, ".running-", ".journal");
  }

  fs::path folder_;
  fs::path records_;
};

TEST_F(StationRecoveryTest, ThePageGoesOnWhereItWasAfterKill) {
  std::string welcome;
  std::string picture;
  std::int64_t tick = 0;
  {
    StationProcess station(records_);
    const auto page = greeted(station.port());
    (void)page->wait_for_type("welcome");
    page->send(kStart);
    welcome = page->wait_for_type("welcome");
    page->send(
        R"({"type":"take_shot","rotation_deg":30,"tilt_deg":-5,"reference":"held_forearm"})");
    picture = page->wait_for([](const auto& frame) { return frame.is_binary; })->content;
    tick = wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 1500; })["tick"];
    EXPECT_EQ(station.end(SIGKILL), -SIGKILL);
  }
  EXPECT_EQ(journals().size(), 1U);
  StationProcess station(records_);
  const auto page = greeted(station.port());
  EXPECT_EQ(page->wait_for_type("welcome"), welcome) << "the same exercise and trainee";
  EXPECT_THAT(page->wait_for_type("exercise"), HasSubstr("test_exercise"));
  EXPECT_THAT(page->wait_for_type("event"), HasSubstr("shot_taken"));
  const std::string restarted = page->wait_for_type("event");
  EXPECT_THAT(restarted, HasSubstr("station_restarted"));
  EXPECT_THAT(restarted, HasSubstr("at most the second before this is lost"));
  const auto again = page->wait_for([](const auto& frame) { return frame.is_binary; });
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->content, picture);
  const Json stands = wait_for_snapshot(*page, [](const Json& s) { return bool(s["paused"]); });
  EXPECT_GE(stands["tick"], tick - 1000);
  page->send(kGoOn);
  (void)wait_for_snapshot(*page, [&](const Json& s) { return s["tick"] > tick + 100; });
  page->send(R"({"type":"act","id":"finish"})");
  EXPECT_EQ(Json::parse(page->wait_for_type("score"))["attempt_id"], 1);
  EXPECT_EQ(station.end(SIGTERM), 0);
  EXPECT_TRUE(journals().empty());
  const auto attempt = records::AttemptStore(records_).find(1);
  ASSERT_TRUE(attempt.has_value());
  EXPECT_THAT(attempt->events_json, HasSubstr("station_restarted"));
  const auto decoded = simulation::decode(attempt->recording);
  ASSERT_TRUE(decoded.has_value()) << decoded.error();
  const simulation::Replay replay = simulation::replay(wrist(), exercise(), *decoded);
  EXPECT_TRUE(replay.hash_matches);
  EXPECT_TRUE(replay.last.finished);
}

TEST_F(StationRecoveryTest, EverySignalThatAsksForTheEndStoresWhatRuns) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    StationProcess station(records_);
    const auto page = greeted(station.port());
    (void)page->wait_for_type("welcome");
    page->send(kStart);
    (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 100; });
    EXPECT_EQ(station.end(signal), 0) << signal;
    EXPECT_TRUE(journals().empty());
  }
  EXPECT_EQ(records::AttemptStore(records_).list().size(), 3U);
}

TEST_F(StationRecoveryTest, NoReaderThatGoesAwayEndsAnExercise) {
  std::array<int, 2> log{};
  ASSERT_EQ(::pipe(log.data()), 0);
  StationProcess station(records_, log[1]);
  ::close(log[0]);  // as `tee` does on Ctrl+C
  ::close(log[1]);
  auto page = greeted(station.port());
  (void)page->wait_for_type("welcome");
  page->send(kStart);
  const Json first = wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 100; });
  page->vanish();  // writes a line
  station.send(SIGPIPE);
  std::this_thread::sleep_for(200ms);
  page = greeted(station.port());
  EXPECT_THAT(page->wait_for_type("welcome"), HasSubstr("Ada"));
  page->send(kGoOn);
  (void)wait_for_snapshot(*page, [&](const Json& s) { return s["tick"] > first["tick"]; });
  EXPECT_EQ(station.end(SIGINT), 0);
  EXPECT_EQ(records::AttemptStore(records_).list().size(), 1U);
}

TEST_F(StationRecoveryTest, SignalsThatKillLeaveWhatGoesOn) {
  for (const int signal : {SIGKILL, SIGSEGV, SIGABRT, SIGQUIT}) {
    std::int64_t tick = 0;
    {
      StationProcess station(records_);
      const auto page = greeted(station.port());
      const bool is_first = Json::parse(page->wait_for_type("welcome"))["exercise"] == 0;
      page->send(is_first ? kStart : kGoOn);
      const Json now = wait_for_snapshot(*page, [](const Json& s) { return !s["paused"]; });
      const std::int64_t begin = now["tick"];
      tick =
          wait_for_snapshot(*page, [&](const Json& s) { return s["tick"] > begin + 700; })["tick"];
      EXPECT_LT(station.end(signal), 0);
    }
    StationProcess station(records_);
    const auto page = greeted(station.port());
    const Json stands = wait_for_snapshot(*page, [](const Json& s) { return bool(s["paused"]); });
    EXPECT_GE(stands["tick"], tick - 1000) << signal;
    EXPECT_EQ(station.end(SIGKILL), -SIGKILL);
  }
  EXPECT_EQ(journals().size(), 1U);
}

}  // namespace
}  // namespace carpus::server
