// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/exercise.hpp"

#include <algorithm>
#include <utility>

#include "core/hexadecimal.hpp"
#include "core/version.hpp"
#include "protocol/bodies.hpp"
#include "records/utc_time.hpp"
#include "session/score_message.hpp"

namespace carpus::server {

namespace {

using simulation::EventKind;

/// A hand that moves in every tick fills it in a minute and a half; then it grows, off the 1 kHz
/// thread.
constexpr std::size_t kReservedRuns = 100'000;

}  // namespace

Exercise::Exercise(const cases::CaseData& data, std::uint64_t case_fingerprint, ExerciseSetup setup)
    : setup_(std::move(setup)),
      data_(data),
      case_fingerprint_(case_fingerprint),
      started_at_(records::utc_now()),
      world_(data, *setup_.procedure, setup_.seed),
      session_(data, *setup_.procedure, world_.now()),
      recorder_(kProgramVersion, case_fingerprint_, *setup_.procedure, setup_.seed),
      shadow_(data, *setup_.procedure, setup_.seed),
      state_{world_.now(), {}},  // before the thread starts: from then on the world is its own
      loop_(
          [this](const simulation::Input& input) -> const simulation::Snapshot& {
            return world_.step(input);
          },
          world_.now(),
          session::resting(world_.now())) {
  recorder_.reserve(kReservedRuns);
}

void Exercise::add_news(const EventfulTick& tick, ExerciseNews& news) const {
  const simulation::Snapshot& snapshot = tick.snapshot;
  for (std::size_t i = 0; i < snapshot.event_count; ++i) {
    const simulation::Event& event = snapshot.events[i];
    news.events.push_back(session_.describe(event));
    const auto number = static_cast<std::uint32_t>(event.detail);
    if (event.kind == EventKind::ShotTaken) {
      news.shots.push_back({PictureKind::Shot, number, 0, setup_.procedure->target,
                            tick.command.rotation_deg, tick.command.tilt_deg, snapshot});
    } else if (event.kind == EventKind::LiveEnded) {
      news.shots.push_back({PictureKind::Held, number, 0, setup_.procedure->target,
                            snapshot.c_arm.rotation_deg, snapshot.c_arm.tilt_deg, snapshot});
    }
  }
}

std::optional<TakenShot> Exercise::live_picture() {
  const simulation::Snapshot& now = state_.snapshot;
  if (!now.c_arm.pedal_is_down || now.pulses == pulses_shown_) return std::nullopt;
  pulses_shown_ = now.pulses;
  return TakenShot{PictureKind::Live,  0,  0, setup_.procedure->target, now.c_arm.rotation_deg,
                   now.c_arm.tilt_deg, now};
}

ExerciseNews Exercise::collect() {
  ExerciseNews news;
  // Events first: their ticks' inputs are then certain to be there already.
  while (const auto tick = loop_.next_eventful_tick()) add_news(*tick, news);
  while (const auto input = loop_.next_input()) {
    recorder_.append(*input);
    shadow_.step(*input);
    if (recorder_.tick() % simulation::kKeyframeTicks == 0) {
      recorder_.append_keyframe({recorder_.tick(), shadow_.write_state()});
    }
  }
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
    score = setup_.procedure->score(data_, world_.operation_record());
  }
  return make_attempt(
      {data_, recording, log_, std::move(score), setup_.trainee, setup_.input_device, started_at_});
}

records::Attempt make_attempt(const AttemptParts& parts) {
  records::Attempt attempt;
  records::AttemptSummary& summary = attempt.summary;
  summary.trainee = parts.trainee;
  summary.case_name = parts.data.pseudonym;
  summary.case_fingerprint = hexadecimal(parts.recording.case_fingerprint);
  summary.case_simulated = parts.data.provenance.simulated;
  summary.procedure = parts.recording.procedure;
  summary.input_device = parts.input_device;
  summary.started_at = parts.started_at;
  summary.ended_at = records::utc_now();
  summary.duration_ticks = parts.recording.tick_count();
  summary.final_hash = hexadecimal(parts.recording.end_hash);
  if (parts.score) {
    summary.outcome = records::Outcome::Finished;
    summary.overall = parts.score->overall;
    attempt.score_json = protocol::serialize_stored_score(session::score_message(*parts.score));
  }
  std::vector<protocol::LoggedEvent> log = parts.log;
  log.resize(std::min(log.size(), protocol::kMaxStoredEvents));
  attempt.events_json = protocol::serialize_stored_events(log);
  attempt.recording = simulation::encode(parts.recording);
  return attempt;
}

}  // namespace carpus::server
