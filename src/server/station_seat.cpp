// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Who has the station's one seat, and whose the exercise is: an exercise belongs to the page that
// began it, and nobody goes on under another's name.
#include <algorithm>
#include <utility>

#include "core/version.hpp"
#include "protocol/bodies.hpp"
#include "server/station.hpp"

namespace carpus::server {

using std::chrono::steady_clock;

void Station::greet(const std::shared_ptr<PageConnection>& page, const protocol::Hello& hello) {
  if (hello.protocol != protocol::kProtocolVersion) {
    send_error(*page,
               "The page speaks protocol " + std::to_string(hello.protocol) + ", this station " +
                   std::to_string(protocol::kProtocolVersion),
               "Reload the page.");
    return page->close();
  }
  page->keep();
  if (std::string reason = why_busy(*page, hello.page); !reason.empty()) {
    const bool may_end = page->guest().role == Role::Instructor;
    return page->send_text(
        serialize(protocol::HostMessage(protocol::Busy{std::move(reason), may_end})));
  }
  const auto before = std::exchange(operator_, page);
  if (before == page) return welcome();
  if (before) {
    before->close();
    // What it held is its own: whoever goes on finds driver and pedal let go.
    if (exercise_) exercise_->loop().hold(exercise_->session().let_go());
  }
  if (before && operator_owns_) left_at_ = steady_clock::now();
  asked_meanwhile_.clear();
  operator_word_ = hello.page;
  operator_owns_ = owns(hello.page);
  // A station that was started anew does not know it yet.
  if (operator_owns_) owner_browser_ = page->guest().browser;
  operator_acts_ = false;
  last_heard_ = seat_used_at_ = steady_clock::now();
  // Time stands still until the page goes on.
  paused_by_page_ = true;
  apply_pause();
  welcome();
  if (exercise_ && may_watch()) show_again();
}

bool Station::owns(const std::string& word) const {
  return exercise_ && !word.empty() && same_secret(word, owner_word_);
}

void Station::own_what_begins() {
  owner_word_ = operator_word_;
  owner_browser_ = operator_->guest().browser;
  operator_owns_ = true;
}

bool Station::may_watch() const {
  return operator_ && (operator_owns_ || operator_->guest().role == Role::Instructor);
}

void Station::welcome() {
  protocol::Welcome message;
  message.protocol = protocol::kProtocolVersion;
  message.program = kProgramVersion;
  if (exercise_) {
    message.exercise = static_cast<std::int64_t>(exercise_number_);
    if (may_watch()) message.trainee = exercise_->trainee();
    message.started_at = exercise_->started_at();
    message.is_own = operator_owns_;
  }
  send(message);
}

std::string Station::why_busy(const PageConnection& page, const std::string& word) const {
  const auto now = steady_clock::now();
  if (operator_ && operator_.get() != &page) {
    // It comes back before its old connection is known to be dead, or to a seat that another has
    // and cannot use.
    const bool in_use = operator_owns_ && operator_acts_ && now - last_heard_ <= kSilence;
    if (owns(word) && !in_use) return {};
    const bool has_own = exercise_ && operator_owns_;
    if (now - seat_used_at_ > (has_own ? patience_.exercise : patience_.seat)) return {};
    return "Another page operates on this station. Close it there, then try again.";
  }
  if (!operator_ && exercise_ && !owns(word) && now - left_at_ < patience_.seat) {
    return "The page that operates here has just lost its connection; its seat is kept for a "
           "moment.";
  }
  return {};
}

void Station::end_for(const std::shared_ptr<PageConnection>& page) {
  if (page->guest().role != Role::Instructor) {
    return send_error(*page, "Only an instructor ends what another does",
                      "Wait, or ask the person who runs this station.");
  }
  if (exercise_) {
    log_("an instructor ends the operation that runs");
    if (page != operator_) {
      refuse("An instructor has ended this operation", "It is stored as unfinished.");
    }
  }
  store_running();
  if (page == operator_) return welcome();
  if (const auto before = std::exchange(operator_, nullptr)) before->close();
}

/// The exercise as a page must know it that comes back.
void Station::show_again() {
  exercise_->session().forget_what_was_sent();
  send(exercise_->session().exercise());
  const std::vector<protocol::LoggedEvent>& log = exercise_->log();
  for (std::size_t i = log.size() - std::min(log.size(), kEventsShown); i < log.size(); ++i) {
    send(protocol::Event{log[i]});
  }
  for (const std::string& frame : shown_) operator_->send_binary(frame);
  send_update();
}

}  // namespace carpus::server
