// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/station_http.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "core/hexadecimal.hpp"
#include "protocol/bodies.hpp"
#include "server/attempt_messages.hpp"
#include "session/descriptions.hpp"
#include "simulation/recording.hpp"

namespace carpus::server {

namespace {

constexpr std::string_view kAttempts = "/api/attempts";

HttpResponse no_such_attempt() { return make_problem(404, "There is no such attempt."); }

}  // namespace

StationHttp::StationHttp(const cases::CaseData& data,
                         const procedure::ProcedureList& procedures,
                         std::string scene_glb,
                         const records::AttemptKeeper& records,
                         const AttemptOwners& owners,
                         const std::filesystem::path& web_root)
    : case_fingerprint_(hexadecimal(simulation::fingerprint_of(data))),
      case_json_(serialize(session::case_description(data))),
      procedures_json_(serialize(session::procedure_list(procedures))),
      instruments_json_(serialize(session::instrument_list())),
      scene_glb_(std::make_shared<const std::string>(std::move(scene_glb))),
      records_(records),
      owners_(owners),
      files_(web_root) {}

HttpResponse StationHttp::answer(const HttpRequest& request) const {
  const auto path = decode_path(request.target);
  if (!path) return make_problem(400, "That is not a path of this station.");
  if (path->starts_with("/api/")) return answer_api(*path, request.guest);
  return files_.get(*path);
}

bool StationHttp::reads_records(const HttpRequest& request) {
  const auto path = decode_path(request.target);
  return path && path->starts_with(kAttempts);
}

HttpResponse StationHttp::answer_api(std::string_view path, const Guest& guest) const {
  if (path == "/api/case") return make_json(case_json_);
  if (path == "/api/procedures") return make_json(procedures_json_);
  if (path == "/api/instruments") return make_json(instruments_json_);
  if (path == "/api/scene.glb") {
    HttpResponse response;
    response.content_type = "model/gltf-binary";
    response.body = scene_glb_;
    return response;
  }
  if (path == kAttempts) return answer_attempts(guest);
  if (path.starts_with(kAttempts) && path[kAttempts.size()] == '/') {
    return answer_attempt(path.substr(kAttempts.size() + 1), guest);
  }
  return make_problem(404, "There is no such thing here; protocol/README.md lists what there is.");
}

bool StationHttp::may_see(const Guest& guest, std::int64_t attempt) const {
  return guest.role == Role::Instructor || owners_.is_of(attempt, guest.browser);
}

HttpResponse StationHttp::answer_attempts(const Guest& guest) const {
  auto attempts = records_.list();
  std::erase_if(attempts, [&](const auto& attempt) { return !may_see(guest, attempt.id); });
  attempts.resize(std::min(attempts.size(), protocol::kMaxAttemptListAttempts));
  return make_json(serialize(attempt_list(attempts)));
}

HttpResponse StationHttp::answer_attempt(std::string_view rest, const Guest& guest) const {
  std::int64_t id = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), id);
  const std::string_view what = rest.substr(static_cast<std::size_t>(end - rest.data()));
  if (error != std::errc{} || id <= 0 || (!what.empty() && what != "/recording")) {
    return no_such_attempt();
  }
  if (!may_see(guest, id)) return no_such_attempt();
  const auto attempt = records_.find(id);
  if (!attempt) return no_such_attempt();
  if (what.empty()) {
    return make_json(serialize(attempt_message(*attempt, case_fingerprint_)));
  }
  HttpResponse response =
      make_response(200, "application/octet-stream",
                    std::string(reinterpret_cast<const char*>(attempt->recording.data()),
                                attempt->recording.size()));
  response.download_name = "attempt-" + std::to_string(id) + ".carpus";
  return response;
}

}  // namespace carpus::server
