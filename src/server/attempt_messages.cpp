// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/attempt_messages.hpp"

#include <utility>

#include "session/event_text.hpp"

namespace carpus::server {

namespace {

// The enumeration of protocol.json is in the order of the records'.
static_assert(static_cast<int>(protocol::Outcome::Finished) ==
              static_cast<int>(records::Outcome::Finished));

protocol::AttemptSummary summary_message(const records::AttemptSummary& attempt) {
  protocol::AttemptSummary message;
  message.id = attempt.id;
  message.trainee = attempt.trainee;
  message.case_ = attempt.case_name;
  message.case_fingerprint = attempt.case_fingerprint;
  message.case_simulated = attempt.case_simulated;
  message.procedure = attempt.procedure;
  if (attempt.mode == name_of(protocol::Mode::Assessed)) message.mode = protocol::Mode::Assessed;
  if (attempt.mode == name_of(protocol::Mode::Practice)) message.mode = protocol::Mode::Practice;
  message.input_device = attempt.input_device;
  message.started_at = attempt.started_at;
  message.ended_at = attempt.ended_at;
  message.outcome = static_cast<protocol::Outcome>(attempt.outcome);
  message.overall = attempt.overall;
  message.duration_s = static_cast<double>(attempt.duration_ticks) / 1000.0;
  message.state_hash = attempt.final_hash;
  if (attempt.asset) {
    message.asset = protocol::AssetSummary{attempt.asset->forms, attempt.asset->passed,
                                           attempt.asset->mean_total};
  }
  return message;
}

std::optional<protocol::ScrewPlace> screw_place_of(const std::string& name) {
  using enum protocol::ScrewPlace;
  for (const protocol::ScrewPlace place : {Inside, Distal, Proximal, Side}) {
    if (name == name_of(place)) return place;
  }
  return std::nullopt;
}

/// Nothing where it cannot be read.
template <typename Value>
std::optional<Value> readable(Result<Value> parsed) {
  if (!parsed) return std::nullopt;
  return std::move(*parsed);
}

std::vector<protocol::LoggedEvent> blinded(std::vector<protocol::LoggedEvent> events) {
  std::vector<protocol::LoggedEvent> told;
  for (protocol::LoggedEvent& event : events) {
    if (auto seen = session::blinded(std::move(event))) told.push_back(std::move(*seen));
  }
  return told;
}

}  // namespace

bool is_truth_open(const records::Attempt& attempt) {
  if (attempt.summary.mode != name_of(protocol::Mode::Assessed)) return true;
  const auto score = readable(protocol::parse_stored_score(attempt.score_json));
  return attempt.summary.outcome == records::Outcome::Finished && score &&
         !score->is_void.value_or(false);
}

protocol::AttemptList attempt_list(const records::AttemptPage& page) {
  protocol::AttemptList list;
  list.older = page.older;
  list.total = page.total;
  for (const records::AttemptSummary& attempt : page.attempts) {
    list.attempts.push_back(summary_message(attempt));
  }
  return list;
}

protocol::QuizAnswerList quiz_answer_list(const records::QuizAnswerPage& page) {
  protocol::QuizAnswerList list;
  list.older = page.older;
  for (const records::QuizAnswer& answer : page.answers) {
    const auto place = screw_place_of(answer.place);
    const auto answered = screw_place_of(answer.answered);
    if (!place || !answered) continue;
    protocol::AnsweredQuestion message;
    message.id = answer.id;
    message.trainee = answer.trainee;
    message.case_ = answer.case_name;
    message.case_fingerprint = answer.case_fingerprint;
    message.seed = answer.seed;
    message.number = answer.question;
    message.answered_at = answer.answered_at;
    message.place = *place;
    message.depth_mm = answer.depth_mm;
    message.answered = *answered;
    message.next_view = answer.next_view;
    message.is_place_right = place == answered;
    message.is_view_right = answer.is_view_right;
    message.is_false_safety =
        *answered == protocol::ScrewPlace::Inside && *place != protocol::ScrewPlace::Inside;
    message.views_taken = answer.views_taken;
    list.answers.push_back(std::move(message));
  }
  return list;
}

protocol::Attempt attempt_message(const records::Attempt& attempt,
                                  const std::string& open_case_fingerprint,
                                  const CaseShelf& cases) {
  protocol::Attempt message{summary_message(attempt.summary), false, {}, {}, {}, 0};
  message.case_is_open = attempt.summary.case_fingerprint == open_case_fingerprint;
  message.case_here = cases.id_of_named(attempt.summary.case_name);
  // Open, it is either the attempt's or was made anew since: there is nothing to open.
  if (message.case_here == cases.open) message.case_here.clear();
  message.score = readable(protocol::parse_stored_score(attempt.score_json));
  message.events = readable(protocol::parse_stored_events(attempt.events_json));
  if (message.events && !is_truth_open(attempt)) {
    message.events = blinded(std::move(*message.events));
  }
  message.recording_bytes = static_cast<std::int64_t>(attempt.recording.size());
  return message;
}

}  // namespace carpus::server
