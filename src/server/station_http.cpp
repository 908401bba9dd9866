// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/station_http.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "core/hexadecimal.hpp"
#include "protocol/bodies.hpp"
#include "server/attempt_messages.hpp"
#include "server/query_number.hpp"
#include "server/replay_desk.hpp"
#include "server/request_head.hpp"
#include "server/scan_files.hpp"
#include "session/descriptions.hpp"
#include "simulation/recording.hpp"

namespace carpus::server {

namespace {

constexpr std::string_view kAttempts = "/api/attempts";
constexpr std::string_view kQuizAnswers = "/api/quiz_answers";
constexpr std::string_view kReplay = "/replay";
constexpr std::string_view kCases = "/api/cases/";
constexpr std::string_view kPreview = "/preview.png";

HttpResponse no_such_attempt() { return make_problem(404, "There is no such attempt."); }

}  // namespace

StationHttp::StationHttp(const cases::CaseData& data,
                         const procedure::ProcedureList& procedures,
                         std::string scene_glb,
                         const records::AttemptKeeper& records,
                         RecordOwners owners,
                         const std::filesystem::path& web_root,
                         std::shared_ptr<const SharedShelf> shelf,
                         std::shared_ptr<const TruthGate> truth)
    : case_fingerprint_(hexadecimal(simulation::fingerprint_of(data))),
      case_json_(serialize(session::case_description(data))),
      shelf_(std::move(shelf)),
      truth_(std::move(truth)),
      procedures_json_(serialize(session::procedure_list(procedures))),
      instruments_json_(serialize(session::instrument_list())),
      scene_glb_(std::make_shared<const std::string>(std::move(scene_glb))),
      records_(records),
      owners_(owners),
      files_(web_root),
      replays_(std::make_unique<ReplayDesk>(data, procedures, [&records](std::int64_t id) {
        return records.find(id);
      })) {}

StationHttp::~StationHttp() = default;

HttpResponse StationHttp::answer(const HttpRequest& request) const {
  const auto path = decode_path(request.target);
  if (!path) return make_problem(400, "That is not a path of this station.");
  if (path->starts_with("/api/")) return answer_api(*path, request);
  return files_.get(*path);
}

std::size_t StationHttp::lane_of(const HttpRequest& request) {
  const auto path = decode_path(request.target);
  if (path && path->starts_with(kCases) && is_scan_path(*path)) return 3;
  if (path && (*path == kQuizAnswers || *path == kAssetPath || *path == kPathologyPath)) return 1;
  if (!path || !path->starts_with(kAttempts)) return 0;
  const std::size_t replay = path->find(kReplay);
  if (replay == std::string::npos) return 1;
  return path->substr(replay) == "/replay/states" ? 2 : 3;
}

HttpResponse StationHttp::answer_api(std::string_view path, const HttpRequest& request) const {
  if (path == "/api/case") return make_json(case_json_);
  if (path == "/api/cases") return make_json(serialize(message_of(*shelf_->now())));
  if (path.starts_with(kCases)) {
    const std::string_view rest = path.substr(kCases.size());
    return is_scan_path(rest) ? answer_scan(*shelf_->now(), truth_.get(), rest)
                              : answer_preview(rest);
  }
  if (path == "/api/procedures") return make_json(procedures_json_);
  if (path == "/api/instruments") return make_json(instruments_json_);
  if (path == "/api/scene.glb") {
    HttpResponse response;
    response.content_type = "model/gltf-binary";
    response.body = scene_glb_;
    return response;
  }
  if (path == kAttempts) return answer_attempts(request);
  if (path == kQuizAnswers) return answer_quiz_answers(request);
  if (path.starts_with(kAttempts) && path[kAttempts.size()] == '/') {
    return answer_attempt(path.substr(kAttempts.size() + 1), request);
  }
  return make_problem(404, "There is no such thing here; protocol/README.md lists what there is.");
}

HttpResponse StationHttp::answer_preview(std::string_view rest) const {
  const bool is_preview = rest.ends_with(kPreview);
  const auto shelf = shelf_->now();
  const ShelvedCase* found =
      is_preview ? shelf->find(rest.substr(0, rest.size() - kPreview.size())) : nullptr;
  if (found == nullptr || !found->preview) return make_problem(404, "There is no such picture.");
  HttpResponse response;
  response.content_type = "image/png";
  response.body = found->preview;
  return response;
}

bool StationHttp::may_see(const Guest& guest, std::int64_t attempt) const {
  return guest.role == Role::Instructor || owners_.attempts.is_of(attempt, guest.browser);
}

HttpResponse StationHttp::answer_attempts(const HttpRequest& request) const {
  const auto before = number_in_query(request.target, "before");
  if (!before) return make_problem(400, "'before' is the number of an attempt.");
  records::AttemptFilter seen;
  if (request.guest.role != Role::Instructor) {
    seen = [&](std::int64_t attempt) { return may_see(request.guest, attempt); };
  }
  return make_json(
      serialize(attempt_list(records_.page(*before, protocol::kMaxAttemptListAttempts, seen))));
}

HttpResponse StationHttp::answer_quiz_answers(const HttpRequest& request) const {
  const auto before = number_in_query(request.target, "before");
  if (!before) return make_problem(400, "'before' is the number of an answer.");
  records::AttemptFilter seen;
  if (request.guest.role != Role::Instructor) {
    seen = [&](std::int64_t answer) {
      return owners_.quiz_answers.is_of(answer, request.guest.browser);
    };
  }
  return make_json(serialize(
      quiz_answer_list(records_.quiz_page(*before, protocol::kMaxQuizAnswerListAnswers, seen))));
}

HttpResponse StationHttp::answer_attempt(std::string_view rest, const HttpRequest& request) const {
  std::int64_t id = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), id);
  const std::string_view what = rest.substr(static_cast<std::size_t>(end - rest.data()));
  const bool is_replay = what.starts_with(kReplay);
  if (error != std::errc{} || id <= 0 || (!what.empty() && what != "/recording" && !is_replay)) {
    return no_such_attempt();
  }
  if (!may_see(request.guest, id)) return no_such_attempt();
  if (is_replay) return answer_replay(id, what.substr(kReplay.size()), request.target);
  const auto attempt = records_.find(id);
  if (!attempt) return no_such_attempt();
  if (what.empty()) {
    return make_json(serialize(attempt_message(*attempt, case_fingerprint_, *shelf_->now())));
  }
  // With the case at hand it would tell all that a replay keeps to itself.
  if (!is_truth_open(*attempt)) {
    return make_problem(
        409, "This attempt was assessed and does not count: its recording stays closed.");
  }
  HttpResponse response =
      make_response(200, "application/octet-stream",
                    std::string(reinterpret_cast<const char*>(attempt->recording.data()),
                                attempt->recording.size()));
  response.download_name = "attempt-" + std::to_string(id) + ".carpus";
  return response;
}

HttpResponse StationHttp::answer_replay(std::int64_t id,
                                        std::string_view what,
                                        std::string_view target) const {
  const auto number = [&](std::string_view name) {
    return number_in_query(target, name).value_or(-1);
  };
  if (what == "/exercise") return replays_->exercise(id);
  if (what == "/states")
    return replays_->states(id, {number("from"), number("to"), number("every")});
  if (what == "/picture") return replays_->picture(id, std::max<std::int64_t>(number("at"), 0));
  if (what == "/truth") return replays_->truth(id, std::max<std::int64_t>(number("at"), 0));
  if (what == "/views") return replays_->views(id);
  if (what == "/cartilage") return replays_->cartilage(id);
  return make_problem(
      404, "Of a replay there are exercise, states, picture, truth, views and cartilage.");
}

}  // namespace carpus::server
