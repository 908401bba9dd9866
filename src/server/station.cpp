// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/station.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "core/error.hpp"
#include "protocol/bodies.hpp"

namespace carpus::server {

using simulation::Command;
using simulation::CommandKind;
using std::chrono::steady_clock;

namespace {

/// States are worth sending only while older ones are not waiting.
constexpr std::size_t kMaxWaitingFrames = 3;
/// A page that goes on after so many messages were dropped is not ours.
constexpr std::uint64_t kMaxDropped = 20000;
/// Ticks that may still come before time stands still.
constexpr Tick kLastTicks = 20'000;

}  // namespace

void Station::send_error(PageConnection& page, std::string reason, std::string what_to_do) {
  page.send_text(
      serialize(protocol::HostMessage(protocol::Error{std::move(reason), std::move(what_to_do)})));
}

Station::Station(const cases::CaseData& data,
                 const procedure::ProcedureList& procedures,
                 records::AttemptKeeper& records,
                 Log log,
                 StationPatience patience,
                 OverCases over_cases)
    : data_(data),
      procedures_(procedures),
      case_fingerprint_(simulation::fingerprint_of(data)),
      records_(records),
      log_(std::move(log)),
      patience_(patience),
      over_cases_(std::move(over_cases)),
      devices_(std::make_unique<DeviceDesk>(std::nullopt)),
      exercise_number_(number_of_now()) {}

void Station::offer_devices(const devices::DeviceSearch& search) {
  devices_ = std::make_unique<DeviceDesk>(search);
}

void Station::attach(NetworkServer& network) {
  network_ = &network;
  pictures_ =
      std::make_unique<PictureWorker>(data_, [this](const TakenShot& shot, std::string frame) {
        network_->post(
            [this, exercise = shot.exercise, kind = shot.kind, frame = std::move(frame)]() mutable {
              deliver(exercise, kind, std::move(frame));
            });
      });
  recover();
  network.repeat(kStateInterval, [this] { update(); });
}

void Station::deliver(std::uint64_t exercise, PictureKind kind, std::string frame) {
  // A picture of the exercise before is of no use to this one.
  if (exercise != exercise_number_) return;
  if (kind == PictureKind::Live) {
    const bool is_heard = may_watch() && operator_->waiting_frames() <= kMaxWaitingFrames;
    if (is_heard && !frame.empty()) operator_->send_binary(frame);
    return;
  }
  if (frame.empty()) return refuse("The picture could not be made", "Take it again.");
  shown_.push_back(std::move(frame));
  if (shown_.size() > kPicturesKept) shown_.pop_front();
  if (may_watch()) operator_->send_binary(shown_.back());
}

void Station::on_open(const std::shared_ptr<PageConnection>& page) { visitors_[page.get()]; }

void Station::on_close(const std::shared_ptr<PageConnection>& page) {
  visitors_.erase(page.get());
  if (page != operator_) return;
  operator_.reset();
  asked_meanwhile_.clear();
  devices_->end_trials();
  if (operator_owns_) left_at_ = steady_clock::now();
  if (!exercise_) return;
  // Whoever comes back finds the driver off and time where it stood.
  exercise_->loop().hold(exercise_->session().let_go());
  last_heard_ = {};
  watch_silence();
  log_("the page has lost its connection; its exercise waits for it");
}

void Station::on_alive(const std::shared_ptr<PageConnection>& page) {
  if (page == operator_) last_heard_ = steady_clock::now();
}

void Station::on_binary(const std::shared_ptr<PageConnection>& page) {
  if (may_speak(page)) {
    send_error(*page, "A binary frame was received", "Only text frames are understood.");
  }
}

bool Station::may_speak(const std::shared_ptr<PageConnection>& page) {
  Visitor& visitor = visitors_[page.get()];
  if (visitor.limit.allows(steady_clock::now())) return true;
  if (++visitor.dropped == 1) {
    send_error(*page, "Too many messages; some are ignored", "Send at most 1000 a second.");
  }
  if (visitor.dropped > kMaxDropped) page->close();
  return false;
}

void Station::on_text(const std::shared_ptr<PageConnection>& page, std::string_view text) {
  if (!may_speak(page)) return;
  const Result<protocol::PageMessage> message = protocol::parse_page_message(text);
  if (!message) {
    return send_error(*page, "Message refused: " + message.error(),
                      "Reload the page; the exercise goes on.");
  }
  if (const auto* hello = std::get_if<protocol::Hello>(&*message)) return greet(page, *hello);
  if (std::holds_alternative<protocol::End>(*message)) return end_for(page);
  if (page != operator_) {
    return send_error(*page, "This page does not operate", "Say hello first.");
  }
  seat_used_at_ = steady_clock::now();
  if (!is_beginning_) return obey(*message);
  if (asked_meanwhile_.size() < kMaxAskedMeanwhile) asked_meanwhile_.push_back(*message);
}

void Station::obey(const protocol::PageMessage& message) {
  const bool is_free = std::holds_alternative<protocol::Start>(message) || is_quiz(message) ||
                       is_of_devices(message);
  if (exercise_ && !operator_owns_ && !is_free) {
    return refuse("This operation is another page's", "Start anew, which stores it as unfinished.");
  }
  operator_acts_ = true;
  try {
    std::visit([this](const auto& m) { on_message(m); }, message);
  } catch (const Error& error) {
    log_(error.what());
    refuse(error.what(), "Change what the message says and try again.");
  }
}

void Station::on_message(const protocol::Hello&) {}

void Station::on_message(const protocol::End&) {}

void Station::on_message(const protocol::ChooseCase& chosen) {
  if (over_cases_.choose && over_cases_.choose(chosen.case_)) return;
  refuse("There is no case '" + chosen.case_ + "' here", "Choose one of those that are shown.");
}

void Station::on_message(const protocol::Hand& hand) {
  if (has_exercise()) exercise_->loop().hold(exercise_->session().take(hand));
}

void Station::on_message(const protocol::Wrist& wrist) {
  if (has_exercise()) exercise_->loop().hold(exercise_->session().take(wrist));
}

void Station::on_message(const protocol::Act& act) {
  if (!has_exercise()) return;
  const Result<Command> asked = exercise_->session().take(act);
  if (!asked) return refuse(asked.error(), "Choose one of the actions that the page shows.");
  if (asked->kind == CommandKind::Finish || asked->kind == CommandKind::Decline) {
    // Time must pass for the operation to end.
    paused_by_page_ = false;
    apply_pause();
  }
  command(*asked);
}

void Station::on_message(const protocol::TakeShot& shot) {
  if (!has_exercise()) return;
  command(exercise_->session().take(shot));
  exercise_->loop().hold(exercise_->session().held());
}

void Station::on_message(const protocol::Tube& tube) {
  if (has_exercise()) command(session::Session::take(tube));
}

void Station::on_message(const protocol::TurnScope& turn) {
  if (has_exercise()) command(session::Session::take(turn));
}

void Station::on_message(const protocol::TurnMouth& turn) {
  if (has_exercise()) command(session::Session::take(turn));
}

void Station::on_message(const protocol::SetFluid& set) {
  if (has_exercise()) command(session::Session::take(set));
}

void Station::on_message(const protocol::Answer& answer) {
  if (!has_exercise()) return;
  const Result<Command> asked = exercise_->session().take(answer);
  if (!asked) return refuse(asked.error(), "Choose one of the findings that the page shows.");
  command(*asked);
}

void Station::on_message(const protocol::CArm& c_arm) {
  if (has_exercise()) exercise_->loop().hold(exercise_->session().take(c_arm));
}

void Station::on_message(const protocol::Pedal& pedal) {
  if (has_exercise()) exercise_->loop().hold(exercise_->session().take(pedal));
}

void Station::on_message(const protocol::Pause& pause) {
  if (!has_exercise()) return;
  if (!pause.on) {
    // What was unplugged must be back, or the hand the page's.
    if (const std::string why = devices_->why_not_go_on(); !why.empty()) {
      return refuse(why + ".", "Plug it in again, or give this hand to mouse and keys (Devices).");
    }
    paused_by_device_ = false;
    devices_->end_trials();
  }
  paused_by_page_ = pause.on;
  apply_pause();
}

bool Station::has_exercise() {
  if (exercise_) return true;
  refuse("No exercise runs", "Begin one first.");
  return false;
}

void Station::command(const Command& command) {
  if (!exercise_->loop().command(command)) {
    refuse("Too many commands are waiting", "Wait a moment, or resume when paused.");
  }
}

void Station::apply_pause() {
  if (exercise_) exercise_->loop().pause(!time_passes());
}

void Station::update() {
  watch_devices();
  if (!exercise_) return;
  const bool is_here = operator_ && operator_owns_;
  if (!is_here && steady_clock::now() - left_at_ > patience_.exercise) {
    store_running();
    return welcome();
  }
  watch_silence();
  send_news();
  watch_disk();
  send_state();
  if (exercise_ && exercise_->collected() + kLastTicks > simulation::kMaxRecordedTicks) {
    refuse("The operation has lasted for 4 hours; it is stored as it is", "Begin another.");
    return store_running();
  }
  if (exercise_ && exercise_->state().snapshot.finished) conclude();
}

void Station::watch_silence() {
  const bool silent = steady_clock::now() - last_heard_ > kSilence;
  if (silent == paused_by_silence_) return;
  paused_by_silence_ = silent;
  apply_pause();
}

void Station::watch_disk() {
  const JournalWatch::Verdict verdict =
      journal_watch_.look(exercise_->on_disk(), exercise_->collected(), steady_clock::now());
  if (!verdict.word.empty()) {
    log_(verdict.word);
    refuse(verdict.word, "The operation goes on; tell the person who runs this station.");
  }
  if (verdict.holds_time == paused_by_disk_) return;
  paused_by_disk_ = verdict.holds_time;
  apply_pause();
}

void Station::send_news() {
  ExerciseNews news = exercise_->collect();
  for (const protocol::LoggedEvent& event : news.told) {
    if (may_watch()) send(protocol::Event{event});
  }
  for (TakenShot& shot : news.shots) {
    shot.exercise = exercise_number_;
    if (pictures_) pictures_->request(shot);
  }
}

void Station::send_state() {
  if (!exercise_->update() || !may_watch()) return;
  if (auto live = exercise_->live_picture(); live && pictures_) {
    live->exercise = exercise_number_;
    pictures_->request(*live);
  }
  // The last state of an exercise must arrive, others are replaced by the next.
  const bool is_last = exercise_->state().snapshot.finished;
  if (!is_last && operator_->waiting_frames() > kMaxWaitingFrames) return;
  send_update();
}

void Station::send_update() {
  const LoopState& state = exercise_->state();
  const session::HostState host{!time_passes(), state.timing.rate_hz, state.timing.p99_us,
                                state.timing.late_ticks};
  for (const protocol::HostMessage& message : exercise_->session().update(state.snapshot, host)) {
    send(message);
  }
}

void Station::send(const protocol::HostMessage& message) {
  if (operator_) operator_->send_text(serialize(message));
}

void Station::refuse(std::string reason, std::string what_to_do) {
  if (operator_) send_error(*operator_, std::move(reason), std::move(what_to_do));
}

}  // namespace carpus::server
