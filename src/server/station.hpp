// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The station: one case, one operating page at a time, its exercise and its records. Speaks the
// protocol; knows no sockets. All in the network's thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "cases/case_data.hpp"
#include "procedure/procedure.hpp"
#include "protocol/messages.hpp"
#include "records/attempt_keeper.hpp"
#include "server/attempt_owners.hpp"
#include "server/case_shelf.hpp"
#include "server/device_desk.hpp"
#include "server/exercise.hpp"
#include "server/journal_watch.hpp"
#include "server/network_server.hpp"
#include "server/picture_worker.hpp"
#include "server/quiz_desk.hpp"
#include "server/rate_limit.hpp"
#include "server/recovery.hpp"
#include "server/work_thread.hpp"

namespace carpus::server {

/// One line for the person who runs the station.
using Log = std::function<void(const std::string& line)>;

/// How long a station waits for a page that lost its connection or does nothing.
struct StationPatience {
  /// For so long only that page may operate; so long a page keeps a seat without an exercise of its
  /// own when another asks for it.
  std::chrono::milliseconds seat{30'000};
  /// So long an exercise stands still before it is stored as unfinished; so long a page keeps the
  /// seat without doing anything when another asks for it.
  std::chrono::milliseconds exercise{600'000};
};

class Station : public PageHandler {
 public:
  /// How often the page is told the state.
  static constexpr std::chrono::milliseconds kStateInterval{16};
  /// A page that is silent for longer than this stops time until it is heard again.
  static constexpr std::chrono::milliseconds kSilence{1000};

  /// @param data  as scanned; it, the procedures and the records must outlive the station.
  Station(const cases::CaseData& data,
          const procedure::ProcedureList& procedures,
          records::AttemptKeeper& records,
          Log log,
          StationPatience patience = {},
          OverCases over_cases = {});
  ~Station() override;

  /// Before attach(): the devices of this machine may be held. Without, there are none.
  void offer_devices(const devices::DeviceSearch& search);

  /// Begins to serve: pictures and states go out through this network. What a station that was
  /// killed left beside the records goes on or is stored.
  void attach(NetworkServer& network);
  /// Stores what runs; the network may go after this, and must not before.
  void detach();

  /// From which browser the attempts were made.
  [[nodiscard]] const AttemptOwners& owners() const noexcept { return *over_cases_.owners; }

  /// And the answers of the quiz.
  [[nodiscard]] const AttemptOwners& quiz_owners() const noexcept {
    return *over_cases_.quiz_owners;
  }

  void on_open(const std::shared_ptr<PageConnection>& page) override;
  void on_text(const std::shared_ptr<PageConnection>& page, std::string_view text) override;
  void on_binary(const std::shared_ptr<PageConnection>& page) override;
  void on_alive(const std::shared_ptr<PageConnection>& page) override;
  void on_close(const std::shared_ptr<PageConnection>& page) override;

 private:
  struct Visitor {
    RateLimit limit{kMessagesPerSecond, kMessageBurst};
    std::uint64_t dropped = 0;
  };
  /// One that ended, on its way into the records.
  struct ConcludedExercise {
    std::uint64_t number = 0;
    std::string in_words;
    std::string score_json;  ///< empty when unfinished
    std::string browser;     ///< in which it was made
    records::KeptAttempt kept;
  };
  /// One that was set up, or why it could not be.
  struct BegunExercise {
    std::unique_ptr<Exercise> exercise;
    std::string problem;
  };
  /// A tool pose a tick is the most that can have an effect.
  static constexpr double kMessagesPerSecond = 1000;
  static constexpr double kMessageBurst = 2000;
  /// As many as the page shows.
  static constexpr std::size_t kPicturesKept = 6;
  static constexpr std::size_t kEventsShown = 40;
  /// What a page says while its exercise is set up.
  static constexpr std::size_t kMaxAskedMeanwhile = 256;
  /// Exercises that end or begin.
  static constexpr std::size_t kMaxAside = 8;

  void on_message(const protocol::Hello& hello);
  void on_message(const protocol::End& end);
  void on_message(const protocol::Start& start);
  void on_message(const protocol::ChooseCase& chosen);
  void on_message(const protocol::Hand& hand);
  void on_message(const protocol::Wrist& wrist);
  void on_message(const protocol::Act& act);
  void on_message(const protocol::TakeShot& shot);
  void on_message(const protocol::Tube& tube);
  void on_message(const protocol::TurnScope& turn);
  void on_message(const protocol::TurnMouth& turn);
  void on_message(const protocol::SetFluid& set);
  void on_message(const protocol::Answer& answer);
  void on_message(const protocol::CArm& c_arm);
  void on_message(const protocol::Pedal& pedal);
  void on_message(const protocol::Pause& pause);

  // In station_devices.cpp.
  void on_message(const protocol::FindDevices& wish);
  void on_message(const protocol::UseDevice& wish);
  void on_message(const protocol::TestWall& wish);
  void on_message(const protocol::Calibrate& wish);
  void watch_devices();
  [[nodiscard]] bool time_passes() const;
  [[nodiscard]] static bool is_of_devices(const protocol::PageMessage& message);

  // In station_quiz.cpp.
  void on_message(const protocol::QuizBegin& wish);
  void on_message(const protocol::QuizNext& wish);
  void on_message(const protocol::QuizLook& wish);
  void on_message(const protocol::QuizAnswer& wish);
  void ask_quiz(QuizWish wish);
  /// In the desk's thread.
  void store(records::QuizAnswer answer, const std::string& browser, NetworkServer* network);
  [[nodiscard]] static bool is_quiz(const protocol::PageMessage& message);

  void obey(const protocol::PageMessage& message);

  // In station_begin.cpp: how an exercise begins.
  [[nodiscard]] static std::uint64_t number_of_now();
  void do_aside(WorkThread::Work work);
  void take_begun();

  // In station_seat.cpp: who has the seat, whose the exercise is.
  void greet(const std::shared_ptr<PageConnection>& page, const protocol::Hello& hello);
  [[nodiscard]] bool owns(const std::string& word) const;
  void own_what_begins();
  /// Whether the page that has the seat may see the exercise: its own, or an instructor.
  [[nodiscard]] bool may_watch() const;
  /// Ends what runs because an instructor wishes it.
  void end_for(const std::shared_ptr<PageConnection>& page);
  /// Why this page may not operate now; empty when it may.
  [[nodiscard]] std::string why_busy(const PageConnection& page, const std::string& word) const;
  void welcome();
  void show_again();
  void deliver(std::uint64_t exercise, PictureKind kind, std::string frame);
  [[nodiscard]] bool may_speak(const std::shared_ptr<PageConnection>& page);
  void command(const simulation::Command& command);
  void update();
  void watch_silence();
  void apply_pause();
  void send_news();
  void send_state();
  /// What the page does not know yet of the newest state.
  void send_update();
  void watch_disk();
  // In station_records.cpp: what lasts beyond this station.
  void recover();
  void resume(ResumedExercise&& resumed);
  /// Ends the exercise that runs, if any, and stores it as it is.
  void store_running();
  /// Ends and stores; sends the score when there is one and it is stored.
  void conclude();
  void store(Exercise& ended, ConcludedExercise concluded, NetworkServer* network);
  void take_stored();
  void tell_stored(const ConcludedExercise& concluded);
  void send_score(std::int64_t id, const std::string& score_json);
  static void send_error(PageConnection& page, std::string reason, std::string what_to_do);
  void send(const protocol::HostMessage& message);
  void refuse(std::string reason, std::string what_to_do);
  [[nodiscard]] bool has_exercise();

  const cases::CaseData& data_;
  const procedure::ProcedureList& procedures_;
  std::uint64_t case_fingerprint_;
  records::AttemptKeeper& records_;
  Log log_;
  StationPatience patience_;
  OverCases over_cases_;
  std::shared_ptr<PageConnection> operator_;
  std::string operator_word_;   ///< what it said in hello
  std::string owner_word_;      ///< of the page that began the exercise
  std::string owner_browser_;   ///< in which that page is
  bool operator_owns_ = false;  ///< it began the exercise that runs
  bool operator_acts_ = false;  ///< it did more than say hello
  std::chrono::steady_clock::time_point seat_used_at_;
  std::chrono::steady_clock::time_point left_at_;  ///< when it was lost
  std::unordered_map<PageConnection*, Visitor> visitors_;
  std::unique_ptr<DeviceDesk> devices_;  ///< before the exercise, which asks it in each tick
  std::unique_ptr<Exercise> exercise_;
  std::uint64_t exercise_number_;  ///< none comes twice, not even after a new start of the station
  bool is_beginning_ = false;      ///< an exercise is being set up
  std::vector<protocol::PageMessage> asked_meanwhile_;
  bool paused_by_page_ = false;
  bool paused_by_silence_ = false;
  bool paused_by_disk_ = false;
  bool paused_by_device_ = false;
  JournalWatch journal_watch_;
  std::chrono::steady_clock::time_point last_heard_;
  NetworkServer* network_ = nullptr;
  std::unique_ptr<PictureWorker> pictures_;
  std::unique_ptr<QuizDesk> quiz_;  ///< none before it is asked for
  std::mutex stored_mutex_;
  std::vector<ConcludedExercise> stored_;  ///< comes from the records' thread
  std::mutex begun_mutex_;
  BegunExercise begun_;            ///< comes from the thread aside
  std::deque<std::string> shown_;  ///< the exercise's last pictures, for a page that comes back
  std::unique_ptr<WorkThread> aside_ = std::make_unique<WorkThread>(kMaxAside);
};

}  // namespace carpus::server
