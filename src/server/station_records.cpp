// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The station's dealings with what lasts: exercises end and are stored, and one that another
// station left behind goes on.
#include <array>
#include <cstdio>
#include <utility>

#include "protocol/bodies.hpp"
#include "server/station.hpp"

namespace carpus::server {

namespace {

/// "62000 ticks of 12 us (p50), 30 us (p99), 210 us (worst), 0 late; ordinary priority"
std::string in_words(const TickTiming& timing, const RealTimeGrants& grants) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(),
                "%llu ticks of %.0f us (p50), %.0f us (p99), %.0f us (worst), %llu late; %s",
                static_cast<unsigned long long>(timing.ticks), timing.whole_p50_us,
                timing.whole_p99_us, timing.worst_us,
                static_cast<unsigned long long>(timing.late_ticks),
                grants.real_time_priority ? "real-time priority" : "ordinary priority");
  return text.data();
}

}  // namespace

Station::~Station() { detach(); }

void Station::detach() {
  asked_meanwhile_.clear();
  aside_.reset();  // does what waits
  take_begun();
  store_running();
  pictures_.reset();  // waits for the picture that is being made
  quiz_.reset();
  network_ = nullptr;
  (void)records_.settle();
  take_stored();
}

void Station::recover() {
  LeftBehind left = look_for_what_was_left(
      data_, case_fingerprint_, procedures_, records_.file(),
      [this](const std::string& origin) { return records_.holds(origin); }, kPicturesKept);
  for (const std::string& word : left.words) log_(word);
  for (AttemptLeftBehind& each : left.ended) {
    records_.save(std::move(each.attempt), [journal = each.journal](const auto& kept) {
      if (kept.is_on_disk) journal->remove();
    });
  }
  if (left.running) resume(std::move(*left.running));
}

void Station::resume(ResumedExercise&& resumed) {
  exercise_number_ = resumed.setup.number;
  resumed.setup.guest = &devices_->guest();
  owner_word_ = resumed.owner;
  over_cases_.truth->close(resumed.setup.mode == procedure::Mode::Assessed);
  // As after a lost connection: the seat is kept, and time stands still until the page goes on.
  left_at_ = std::chrono::steady_clock::now();
  paused_by_page_ = true;
  exercise_ = std::make_unique<Exercise>(data_, std::move(resumed.setup), std::move(resumed.start));
  for (TakenShot& shot : resumed.shots) {
    shot.exercise = exercise_number_;
    pictures_->request(shot);
  }
}

void Station::store_running() {
  if (exercise_) conclude();
}

void Station::conclude() {
  send_news();
  over_cases_.truth->close(false);
  // A score takes a moment, and ending the thread of ticks another.
  const std::shared_ptr<Exercise> ended = std::move(exercise_);
  do_aside([this, ended, number = exercise_number_, browser = owner_browser_, network = network_] {
    store(*ended, {number, {}, {}, browser, {}}, network);
  });
}

void Station::store(Exercise& ended, ConcludedExercise concluded, NetworkServer* network) {
  records::Attempt attempt = ended.end();
  std::shared_ptr<ExerciseJournal> journal = ended.take_journal();
  const bool finished = attempt.summary.outcome == records::Outcome::Finished;
  concluded.in_words = (finished ? " finished" : " unfinished") + std::string(" after ") +
                       std::to_string(attempt.summary.duration_ticks / 1000) + " s; " +
                       in_words(ended.state().timing, ended.loop().grants());
  if (finished) concluded.score_json = attempt.score_json;
  // Called in the records' thread. The journal goes when the attempt is on disk elsewhere.
  records_.save(std::move(attempt),
                [this, journal, network, concluded](const records::KeptAttempt& kept) mutable {
                  if (kept.is_on_disk && journal) journal->remove();
                  concluded.kept = kept;
                  {
                    const std::lock_guard lock(stored_mutex_);
                    stored_.push_back(std::move(concluded));
                  }
                  if (network != nullptr) network->post([this] { take_stored(); });
                });
}

void Station::take_stored() {
  std::vector<ConcludedExercise> stored;
  {
    const std::lock_guard lock(stored_mutex_);
    stored.swap(stored_);
  }
  for (const ConcludedExercise& each : stored) tell_stored(each);
}

void Station::tell_stored(const ConcludedExercise& concluded) {
  const records::KeptAttempt& kept = concluded.kept;
  if (kept.id > 0) over_cases_.owners->add(kept.id, concluded.browser);
  log_("attempt " + (kept.id > 0 ? std::to_string(kept.id) : std::string("(not stored)")) +
       concluded.in_words);
  if (!kept.problem.empty()) {
    log_(kept.problem);
    refuse(kept.problem, "Tell the person who runs this station; nothing is lost yet.");
  }
  // Who has begun another exercise meanwhile finds the score among the past attempts.
  const bool is_awaited = concluded.number == exercise_number_ && !exercise_ && operator_owns_;
  if (is_awaited && !concluded.score_json.empty()) send_score(kept.id, concluded.score_json);
}

void Station::send_score(std::int64_t id, const std::string& score_json) {
  // What was stored is what is told: it can be read again, or somebody learns of it now.
  auto report = protocol::parse_stored_score(score_json);
  if (!report) {
    log_("the score cannot be read: " + report.error());
    return refuse("The score cannot be shown: " + report.error(),
                  "Tell the person who runs this station; the recording is stored.");
  }
  send(protocol::Score{id, report->overall, std::move(*report)});
}

}  // namespace carpus::server
