// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/replay_desk.hpp"

#include <algorithm>
#include <utility>

#include "core/hexadecimal.hpp"
#include "protocol/bodies.hpp"
#include "server/attempt_messages.hpp"
#include "server/cartilage_debrief.hpp"
#include "server/picture_worker.hpp"
#include "session/session.hpp"

namespace carpus::server {

namespace {

/// Between two pulses of the tube in a live look (procedure/shots.hpp: ten a second).
constexpr Tick kPulseTicks = 100;
/// Pictures that are gone through for the views; each is a seek.
constexpr std::size_t kMostLooks = 24;

HttpResponse no_such_attempt() { return make_problem(404, "There is no such attempt."); }

/// What cannot be shown, and never will be on this station as it is.
HttpResponse cannot_be_shown(const std::string& why) { return make_problem(409, why); }

/// As the trainee was told, or as the truth is told afterwards.
simulation::Snapshot as_told(const simulation::Snapshot& now, bool tells_truth) {
  simulation::Snapshot told = now;
  if (tells_truth) told.mode = procedure::Mode::Practice;
  return told;
}

}  // namespace

ReplayDesk::ReplayDesk(const cases::CaseData& data,
                       const procedure::ProcedureList& procedures,
                       Load load)
    : data_(data),
      procedures_(procedures),
      case_fingerprint_(hexadecimal(simulation::fingerprint_of(data))),
      load_(std::move(load)) {}

ReplayDesk::~ReplayDesk() = default;

ReplayDesk::Recorded ReplayDesk::decoded(const records::Attempt& attempt) const {
  Recorded made;
  if (attempt.summary.case_fingerprint != case_fingerprint_) {
    made.problem = "This attempt was made on another case, '" + attempt.summary.case_name +
                   "': its replay is shown once that is open. A case that was made anew is another "
                   "one, too.";
    return made;
  }
  auto recording = simulation::decode(attempt.recording);
  if (!recording) {
    made.problem = "The replay cannot be shown: " + recording.error() + ".";
    return made;
  }
  made.procedure = procedures_.find(recording->procedure);
  if (made.procedure == nullptr) {
    made.problem = "This station does not know the procedure '" + recording->procedure + "'.";
    return made;
  }
  made.tells_truth =
      recording->mode == procedure::Mode::Practice ||
      (attempt.summary.outcome == records::Outcome::Finished && is_truth_open(attempt));
  if (const auto events = protocol::parse_stored_events(attempt.events_json)) {
    for (const protocol::LoggedEvent& event : *events) {
      if (event.kind == "shot_taken" || event.kind == "live_ended") {
        made.looks.push_back(static_cast<Tick>(event.tick));
      }
    }
  }
  made.recording = std::make_shared<simulation::Recording>(std::move(recording.value()));
  return made;
}

std::shared_ptr<const ReplayDesk::Recorded> ReplayDesk::recorded_of(std::int64_t id) {
  const std::lock_guard lock(recorded_mutex_);
  const auto known = std::find_if(recorded_.begin(), recorded_.end(),
                                  [&](const auto& r) { return r.first == id; });
  if (known != recorded_.end()) {
    recorded_.splice(recorded_.begin(), recorded_, known);
    return known->second;
  }
  const auto attempt = load_(id);
  if (!attempt) return nullptr;
  recorded_.emplace_front(id, std::make_shared<Recorded>(decoded(*attempt)));
  if (recorded_.size() > kMostRecorded) recorded_.pop_back();
  return recorded_.front().second;
}

ReplayDesk::Opened& ReplayDesk::open(Shelf& shelf,
                                     std::int64_t id,
                                     const std::shared_ptr<const Recorded>& recorded) const {
  auto& opened = shelf.opened;
  const auto known =
      std::find_if(opened.begin(), opened.end(), [&](const Opened& o) { return o.id == id; });
  if (known != opened.end()) {
    opened.splice(opened.begin(), opened, known);
  } else {
    if (opened.size() >= kMostOpened) opened.pop_back();
    opened.push_front({id, recorded,
                       std::make_unique<simulation::ReplayPlayer>(data_, *recorded->procedure,
                                                                  recorded->recording)});
  }
  return opened.front();
}

HttpResponse ReplayDesk::exercise(std::int64_t id) {
  const auto recorded = recorded_of(id);
  if (!recorded) return no_such_attempt();
  if (!recorded->problem.empty()) return cannot_be_shown(recorded->problem);
  simulation::Snapshot opening;
  opening.mode = recorded->recording->mode;
  // What is wrong in an examined wrist follows from these.
  opening.seed = recorded->recording->seed;
  opening.prepared = recorded->recording->prepared;
  const session::Session session(data_, *recorded->procedure, opening);
  return make_json(serialize(protocol::HostMessage(session.exercise())));
}

HttpResponse ReplayDesk::states(std::int64_t id, const ReplayStretch& stretch) {
  if (stretch.every <= 0 || stretch.to < stretch.from || stretch.to - stretch.from > kMostTicks ||
      (stretch.to - stretch.from) / stretch.every >= kMostStates) {
    return make_problem(400, "A stretch is from= to= every= in ticks of 1 ms: at most " +
                                 std::to_string(kMostTicks) + " ticks and " +
                                 std::to_string(kMostStates) + " states.");
  }
  const auto recorded = recorded_of(id);
  if (!recorded) return no_such_attempt();
  if (!recorded->problem.empty()) return cannot_be_shown(recorded->problem);
  const std::lock_guard lock(for_states_.mutex);
  simulation::ReplayPlayer& player = *open(for_states_, id, recorded).player;
  session::Session session(data_, *recorded->procedure, player.now());
  std::string lines;
  for (std::int64_t tick = stretch.from; tick <= stretch.to; tick += stretch.every) {
    const auto reached = player.seek(static_cast<Tick>(tick));
    if (!reached) return cannot_be_shown("The replay cannot be shown: " + reached.error() + ".");
    for (const protocol::HostMessage& message :
         session.update(as_told(player.now(), recorded->tells_truth), {})) {
      // Nothing is asked for in a replay.
      if (std::holds_alternative<protocol::Actions>(message)) continue;
      lines += serialize(message);
      lines += '\n';
    }
    if (static_cast<Tick>(tick) >= player.length()) break;
  }
  return make_response(200, "application/x-ndjson", std::move(lines));
}

HttpResponse ReplayDesk::picture(std::int64_t id, std::int64_t tick) {
  const auto recorded = recorded_of(id);
  if (!recorded) return no_such_attempt();
  if (!recorded->problem.empty()) return cannot_be_shown(recorded->problem);
  const std::lock_guard lock(for_pictures_.mutex);
  simulation::ReplayPlayer& player = *open(for_pictures_, id, recorded).player;
  const auto at = static_cast<Tick>(tick);
  auto reached = player.seek(at > kPulseTicks ? at - kPulseTicks : 0);
  const simulation::Snapshot before = player.now();
  if (reached) reached = player.seek_with_events(at);
  if (!reached) return cannot_be_shown("The replay cannot be shown: " + reached.error() + ".");
  if (!pictures_) pictures_ = std::make_unique<session::ExercisePictures>(data_);
  const std::string frame = frame_of(*recorded->procedure, player, before);
  if (frame.empty()) return make_problem(404, "No picture was taken at that moment.");
  return make_response(200, "application/octet-stream", frame);
}

std::string ReplayDesk::frame_of(const procedure::Procedure& procedure,
                                 const simulation::ReplayPlayer& player,
                                 const simulation::Snapshot& before) {
  const auto view_of = [](const TakenShot& shot) {
    return session::PictureView{shot.target, shot.rotation_deg, shot.tilt_deg};
  };
  const auto live = [&](const simulation::Snapshot& now) {
    return TakenShot{PictureKind::Live,  0,  0, procedure.target, now.c_arm.rotation_deg,
                     now.c_arm.tilt_deg, now};
  };
  const std::vector<TakenShot> taken =
      pictures_of(procedure, {player.input().command, player.now()});
  if (!taken.empty()) {
    const TakenShot& shot = taken.back();
    return encode_picture(shot, shot.kind == PictureKind::Held
                                    ? pictures_->take_held(view_of(shot), shot.snapshot)
                                    : pictures_->take(view_of(shot), shot.snapshot));
  }
  if (!player.now().c_arm.pedal_is_down) return {};
  // Whether it was coarse then, because something moved, the one before it tells.
  if (before.c_arm.pedal_is_down) (void)pictures_->take_live(view_of(live(before)), before);
  const TakenShot shot = live(player.now());
  return encode_picture(shot, pictures_->take_live(view_of(shot), shot.snapshot));
}

std::optional<HttpResponse> ReplayDesk::closed(const std::shared_ptr<const Recorded>& recorded,
                                               const std::string& why) {
  if (!recorded) return no_such_attempt();
  if (!recorded->problem.empty()) return cannot_be_shown(recorded->problem);
  if (!recorded->tells_truth) return cannot_be_shown(why);
  return std::nullopt;
}

std::optional<HttpResponse> ReplayDesk::locked(const std::shared_ptr<const Recorded>& recorded) {
  if (auto refused =
          closed(recorded, "Of an assessed operation without a screw the truth stays closed.")) {
    return refused;
  }
  if (recorded->procedure->target != BoneId::Scaphoid) {
    return cannot_be_shown("Views are judged for the scaphoid alone.");
  }
  return std::nullopt;
}

HttpResponse ReplayDesk::cartilage(std::int64_t id) {
  const auto recorded = recorded_of(id);
  if (auto refused = closed(
          recorded, "Of an assessed arthroscopy that does not count the truth stays closed.")) {
    return *refused;
  }
  procedure::OperationRecord record;
  {
    const std::lock_guard lock(for_pictures_.mutex);
    simulation::ReplayPlayer& player = *open(for_pictures_, id, recorded).player;
    const auto reached = player.seek(player.length());
    if (!reached) return cannot_be_shown("The replay cannot be shown: " + reached.error() + ".");
    record = player.operation_record();
  }
  if (!record.scope || data_.arthroscopy == nullptr) {
    return make_problem(404, "This operation looked into no joint.");
  }
  return make_json(serialize(seen_cartilage(data_, *record.scope)));
}

ViewDebrief& ReplayDesk::debrief() {
  if (!debrief_) debrief_ = std::make_unique<ViewDebrief>(data_);
  return *debrief_;
}

HttpResponse ReplayDesk::truth(std::int64_t id, std::int64_t tick) {
  const auto recorded = recorded_of(id);
  if (auto refused = locked(recorded)) return *refused;
  const std::lock_guard lock(for_pictures_.mutex);
  simulation::ReplayPlayer& player = *open(for_pictures_, id, recorded).player;
  const auto reached = player.seek_with_events(static_cast<Tick>(tick));
  if (!reached) return cannot_be_shown("The replay cannot be shown: " + reached.error() + ".");
  const auto taken = pictures_of(*recorded->procedure, {player.input().command, player.now()});
  if (taken.empty()) return make_problem(404, "No picture was taken at that moment.");
  return make_json(serialize(debrief().truth_of(taken.back())));
}

HttpResponse ReplayDesk::views(std::int64_t id) {
  const auto recorded = recorded_of(id);
  if (auto refused = locked(recorded)) return *refused;
  const std::lock_guard lock(for_pictures_.mutex);
  simulation::ReplayPlayer& player = *open(for_pictures_, id, recorded).player;
  // Only the last of them can show the screw as it lies at the end.
  const std::size_t first = recorded->looks.size() - std::min(recorded->looks.size(), kMostLooks);
  std::vector<TakenShot> taken;
  for (std::size_t i = first; i < recorded->looks.size(); ++i) {
    const auto reached = player.seek_with_events(recorded->looks[i]);
    if (!reached) return cannot_be_shown("The replay cannot be shown: " + reached.error() + ".");
    if (!ViewDebrief::screw_in(data_, player.now())) continue;
    for (TakenShot& shot :
         pictures_of(*recorded->procedure, {player.input().command, player.now()})) {
      taken.push_back(shot);
    }
  }
  const auto reached = player.seek(player.length());
  if (!reached) return cannot_be_shown("The replay cannot be shown: " + reached.error() + ".");
  return make_json(serialize(debrief().debrief(player.now(), taken)));
}

}  // namespace carpus::server
