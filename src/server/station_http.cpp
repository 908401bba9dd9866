// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/station_http.hpp"

#include <charconv>
#include <nlohmann/json.hpp>
#include <utility>

#include "procedure/score_json.hpp"
#include "server/case_messages.hpp"
#include "server/exercise.hpp"
#include "simulation/recording.hpp"

namespace carpus::server {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const records::AttemptSummary& attempt) {
  return {{"id", attempt.id},
          {"trainee", attempt.trainee},
          {"case", attempt.case_name},
          {"case_fingerprint", attempt.case_fingerprint},
          {"case_simulated", attempt.case_simulated ? Json(*attempt.case_simulated) : Json()},
          {"procedure", attempt.procedure},
          {"input_device", attempt.input_device},
          {"started_at", attempt.started_at},
          {"ended_at", attempt.ended_at},
          {"outcome", std::string(name_of(attempt.outcome))},
          {"overall", attempt.overall ? Json(*attempt.overall) : Json()},
          {"duration_s", static_cast<double>(attempt.duration_ticks) / 1000.0},
          {"state_hash", attempt.final_hash}};
}

std::string dump(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// Stored JSON; null where it is empty or damaged.
Json stored(const std::string& text) {
  Json json = Json::parse(text, nullptr, false);
  return json.is_discarded() ? Json() : json;
}

HttpResponse no_such_attempt() { return make_problem(404, "There is no such attempt."); }

}  // namespace

std::string attempts_json(const std::vector<records::AttemptSummary>& attempts, int indent) {
  Json list = Json::array();
  for (const records::AttemptSummary& attempt : attempts) list.push_back(to_json(attempt));
  return dump({{"attempts", std::move(list)}}, indent);
}

std::string attempt_json(const records::Attempt& attempt,
                         const std::string& open_case_fingerprint,
                         int indent) {
  Json json = to_json(attempt.summary);
  json["case_is_open"] = attempt.summary.case_fingerprint == open_case_fingerprint;
  json["score"] = stored(attempt.score_json);
  json["events"] = stored(attempt.events_json);
  json["recording_bytes"] = attempt.recording.size();
  return dump(json, indent);
}

StationHttp::StationHttp(const cases::CaseData& posed_case,
                         std::string scene_glb,
                         const records::AttemptKeeper& records,
                         const std::filesystem::path& web_root)
    : case_fingerprint_(hexadecimal(simulation::fingerprint_of(posed_case))),
      case_json_(serialize(case_description(posed_case))),
      screws_json_("{\"screws\":" + procedure::screw_catalogue_json() + "}"),
      scene_glb_(std::make_shared<const std::string>(std::move(scene_glb))),
      records_(records),
      files_(web_root) {}

HttpResponse StationHttp::answer(const HttpRequest& request) const {
  const auto path = decode_path(request.target);
  if (!path) return make_problem(400, "That is not a path of this station.");
  if (path->starts_with("/api/")) return answer_api(*path);
  return files_.get(*path);
}

HttpResponse StationHttp::answer_api(std::string_view path) const {
  constexpr std::string_view kAttempts = "/api/attempts";
  if (path == "/api/case") return make_json(case_json_);
  if (path == "/api/screws") return make_json(screws_json_);
  if (path == "/api/scene.glb") {
    HttpResponse response;
    response.content_type = "model/gltf-binary";
    response.body = scene_glb_;
    return response;
  }
  if (path == kAttempts) return make_json(attempts_json(records_.list()));
  if (path.starts_with(kAttempts) && path[kAttempts.size()] == '/') {
    return answer_attempt(path.substr(kAttempts.size() + 1));
  }
  return make_problem(404, "There is no such thing here; protocol/README.md lists what there is.");
}

HttpResponse StationHttp::answer_attempt(std::string_view rest) const {
  std::int64_t id = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), id);
  const std::string_view what = rest.substr(static_cast<std::size_t>(end - rest.data()));
  if (error != std::errc{} || id <= 0 || (!what.empty() && what != "/recording")) {
    return no_such_attempt();
  }
  const auto attempt = records_.find(id);
  if (!attempt) return no_such_attempt();
  if (what.empty()) return make_json(attempt_json(*attempt, case_fingerprint_));
  HttpResponse response =
      make_response(200, "application/octet-stream",
                    std::string(reinterpret_cast<const char*>(attempt->recording.data()),
                                attempt->recording.size()));
  response.download_name = "attempt-" + std::to_string(id) + ".carpus";
  return response;
}

}  // namespace carpus::server
