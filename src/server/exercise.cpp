// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/exercise.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "core/version.hpp"
#include "protocol/bodies.hpp"
#include "records/utc_time.hpp"
#include "server/score_message.hpp"

namespace carpus::server {

namespace {

using simulation::EventKind;

/// Exercises of ordinary length need no second allocation of the recording.
constexpr std::size_t kReservedRuns = 10 * 60 * 1000;

void add_news(const EventfulTick& tick, ExerciseNews& news) {
  const simulation::Snapshot& snapshot = tick.snapshot;
  for (std::size_t i = 0; i < snapshot.event_count; ++i) {
    const simulation::Event& event = snapshot.events[i];
    news.events.push_back(describe(event));
    if (event.kind != EventKind::ShotTaken) continue;
    news.shots.push_back({static_cast<std::uint32_t>(event.detail), 0, tick.command.rotation_deg,
                          tick.command.tilt_deg, snapshot});
  }
}

}  // namespace

Exercise::Exercise(const cases::CaseData& posed_case,
                   std::uint64_t case_fingerprint,
                   ExerciseSetup setup)
    : setup_(std::move(setup)),
      posed_case_(posed_case),
      case_fingerprint_(case_fingerprint),
      started_at_(records::utc_now()),
      world_(posed_case, setup_.procedure, setup_.seed),
      recorder_(kProgramVersion, case_fingerprint_, setup_.procedure, setup_.seed),
      state_{world_.now(), {}},  // before the thread starts: from then on the world is its own
      loop_(
          [this](const simulation::Input& input) -> const simulation::Snapshot& {
            return world_.step(input);
          },
          world_.now()) {
  recorder_.reserve(kReservedRuns);
}

ExerciseNews Exercise::collect() {
  ExerciseNews news;
  // Events first: their ticks' inputs are then certain to be there already.
  while (const auto tick = loop_.next_eventful_tick()) add_news(*tick, news);
  while (const auto input = loop_.next_input()) recorder_.append(*input);
  log_.insert(log_.end(), news.events.begin(), news.events.end());
  return news;
}

records::Attempt Exercise::end() {
  loop_.stop();
  (void)collect();
  (void)update();
  const simulation::Recording recording = recorder_.finished(world_.now().state_hash);
  std::optional<procedure::ScoreReport> score;
  if (world_.now().finished) {
    score = procedure::score_operation(posed_case_, world_.operation_record());
  }
  return make_attempt({posed_case_, recording, log_, std::move(score), setup_.trainee,
                       setup_.input_device, started_at_});
}

records::Attempt make_attempt(const AttemptParts& parts) {
  records::Attempt attempt;
  records::AttemptSummary& summary = attempt.summary;
  summary.trainee = parts.trainee;
  summary.case_name = parts.posed_case.pseudonym;
  summary.case_fingerprint = hexadecimal(parts.recording.case_fingerprint);
  summary.case_simulated = parts.posed_case.provenance.simulated;
  summary.procedure = procedure::name_of(parts.recording.procedure);
  summary.input_device = parts.input_device;
  summary.started_at = parts.started_at;
  summary.ended_at = records::utc_now();
  summary.duration_ticks = parts.recording.tick_count();
  summary.final_hash = hexadecimal(parts.recording.end_hash);
  if (parts.score) {
    summary.outcome = records::Outcome::Finished;
    summary.overall = parts.score->overall;
    attempt.score_json = protocol::serialize_stored_score(score_message(*parts.score));
  }
  std::vector<protocol::LoggedEvent> log = parts.log;
  log.resize(std::min(log.size(), protocol::kMaxStoredEvents));
  attempt.events_json = protocol::serialize_stored_events(log);
  attempt.recording = simulation::encode(parts.recording);
  return attempt;
}

std::string hexadecimal(std::uint64_t value) {
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
  return text.data();
}

}  // namespace carpus::server
