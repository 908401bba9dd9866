// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/exercise.hpp"

#include <algorithm>
#include <utility>

#include "core/hexadecimal.hpp"
#include "core/version.hpp"
#include "protocol/bodies.hpp"
#include "records/attempt_origin.hpp"
#include "records/journals_left_behind.hpp"
#include "records/utc_time.hpp"
#include "session/score_message.hpp"
#include "simulation/keyframe_due.hpp"

namespace carpus::server {

namespace {

using simulation::EventKind;

}  // namespace

ExerciseStart begin_anew(const cases::CaseData& data,
                         std::uint64_t case_fingerprint,
                         const ExerciseSetup& setup,
                         const std::filesystem::path& records) {
  return begin_anew(
      data, case_fingerprint, setup, records,
      simulation::World(data, *setup.procedure, setup.seed, setup.mode, setup.prepared),
      simulation::World(data, *setup.procedure, setup.seed, setup.mode, setup.prepared));
}

ExerciseStart begin_anew(const cases::CaseData& data,
                         std::uint64_t case_fingerprint,
                         const ExerciseSetup& setup,
                         const std::filesystem::path& records,
                         simulation::World world,
                         simulation::World shadow) {
  simulation::Recorder recorder(kProgramVersion, case_fingerprint, world);
  ExerciseStart start{records::new_origin(),
                      records::utc_now(),
                      std::move(world),
                      std::move(shadow),
                      std::move(recorder),
                      {},
                      nullptr,
                      false};
  if (!records.empty()) {
    const protocol::RunningExercise head{start.origin,
                                         static_cast<std::int64_t>(setup.number),
                                         setup.trainee,
                                         data.pseudonym,
                                         data.provenance.simulated,
                                         setup.input_device,
                                         start.started_at};
    start.journal =
        std::make_unique<ExerciseJournal>(records::journal_path(records, start.origin), head,
                                          start.recorder.finished(start.world.now().state_hash));
  }
  return start;
}

Exercise::Exercise(const cases::CaseData& data, ExerciseSetup setup, ExerciseStart start)
    : setup_(std::move(setup)),
      data_(data),
      origin_(std::move(start.origin)),
      started_at_(std::move(start.started_at)),
      world_(std::move(start.world)),
      shadow_(std::move(start.shadow)),
      session_(data, *setup_.procedure, world_.now()),
      recorder_(std::move(start.recorder)),
      log_(std::move(start.log)),
      journal_(std::move(start.journal)),
      state_{world_.now(), {}},  // before the thread starts: from then on the world is its own
      loop_(
          [this](const simulation::Input& input) -> const simulation::Snapshot& {
            return world_.step(input);
          },
          world_.now(),
          session::resting(world_.now()),
          start.paused,
          setup_.guest) {}

std::vector<TakenShot> pictures_of(const procedure::Procedure& procedure,
                                   const EventfulTick& tick) {
  std::vector<TakenShot> pictures;
  const simulation::Snapshot& snapshot = tick.snapshot;
  for (std::size_t i = 0; i < snapshot.event_count; ++i) {
    const simulation::Event& event = snapshot.events[i];
    const auto number = static_cast<std::uint32_t>(event.detail);
    if (event.kind == EventKind::ShotTaken) {
      pictures.push_back({PictureKind::Shot, number, 0, procedure.target, tick.command.rotation_deg,
                          tick.command.tilt_deg, snapshot});
    } else if (event.kind == EventKind::LiveEnded) {
      pictures.push_back({PictureKind::Held, number, 0, procedure.target,
                          snapshot.c_arm.rotation_deg, snapshot.c_arm.tilt_deg, snapshot});
    }
  }
  return pictures;
}

void Exercise::add_news(const EventfulTick& tick, ExerciseNews& news) const {
  for (std::size_t i = 0; i < tick.snapshot.event_count; ++i) {
    news.events.push_back(session_.describe(tick.snapshot.events[i]));
    if (auto told = session_.tell(tick.snapshot.events[i], tick.snapshot))
      news.told.push_back(std::move(*told));
  }
  for (const TakenShot& shot : pictures_of(*setup_.procedure, tick)) news.shots.push_back(shot);
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
  if (journal_) journal_->append(news.events);
  while (const auto input = loop_.next_input()) {
    recorder_.append(*input);
    shadow_.step(*input);
    if (journal_) journal_->append(*input);
    if (simulation::is_keyframe_due(shadow_.now())) {
      const simulation::Keyframe keyframe{recorder_.tick(), shadow_.write_state()};
      if (journal_) journal_->append(keyframe, shadow_.now().state_hash);
      recorder_.append_keyframe(keyframe);
    }
  }
  log_.insert(log_.end(), news.events.begin(), news.events.end());
  if (journal_) journal_->hand_over(shadow_.now().state_hash);
  return news;
}

void Exercise::note_owner(const std::string& word) {
  if (journal_) journal_->note_owner(word);
}

std::optional<records::JournalProgress> Exercise::on_disk() const {
  if (!journal_) return std::nullopt;
  return journal_->progress();
}

records::Attempt Exercise::end() {
  loop_.stop();
  (void)collect();
  (void)update();
  if (journal_) journal_->hand_over_now(shadow_.now().state_hash);
  const simulation::Recording recording = std::move(recorder_).finished(world_.now().state_hash);
  std::optional<procedure::ScoreReport> score;
  if (world_.now().finished) {
    score = setup_.procedure->score(data_, world_.operation_record());
    if (setup_.mode == procedure::Mode::Assessed) {
      score = procedure::locked_where_void(std::move(*score));
    }
  }
  return make_attempt({data_, recording, log_, std::move(score), setup_.trainee,
                       setup_.input_device, started_at_, origin_});
}

records::Attempt make_attempt(const AttemptParts& parts) {
  records::Attempt attempt;
  records::AttemptSummary& summary = attempt.summary;
  summary.origin = parts.origin;
  summary.trainee = parts.trainee;
  summary.case_name = parts.data.pseudonym;
  summary.case_fingerprint = hexadecimal(parts.recording.case_fingerprint);
  summary.case_simulated = parts.data.provenance.simulated;
  summary.procedure = parts.recording.procedure;
  summary.mode = procedure::name_of(parts.recording.mode);
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
