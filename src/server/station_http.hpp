// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the station answers over HTTP (protocol/README.md): the page's files, the case, what can be
// practised with which instruments, and the records.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "cases/case_data.hpp"
#include "procedure/procedure.hpp"
#include "records/attempt_keeper.hpp"
#include "server/attempt_owners.hpp"
#include "server/case_shelf.hpp"
#include "server/http_message.hpp"
#include "server/static_files.hpp"

namespace carpus::server {

class ReplayDesk;

/// From which browsers attempts and answers of the quiz were made.
struct RecordOwners {
  const AttemptOwners& attempts;
  const AttemptOwners& quiz_answers;
};

class StationHttp {
 public:
  /// Prepares what never changes. @param records  and owners must outlive it.
  StationHttp(const cases::CaseData& data,
              const procedure::ProcedureList& procedures,
              std::string scene_glb,
              const records::AttemptKeeper& records,
              RecordOwners owners,
              const std::filesystem::path& web_root,
              std::shared_ptr<const SharedShelf> shelf = std::make_shared<SharedShelf>(),
              std::shared_ptr<const TruthGate> truth = {});
  ~StationHttp();

  /// Never throws for a bad request; IoError when the records cannot be read.
  /// May be called from several threads.
  [[nodiscard]] HttpResponse answer(const HttpRequest& request) const;

  /// Who answers, the ASSET's desk among them (NetworkOptions::lane_of): what is at hand at once,
  /// the records, the states and the pictures of a replay each in a thread of their own.
  [[nodiscard]] static std::size_t lane_of(const HttpRequest& request);

 private:
  [[nodiscard]] HttpResponse answer_api(std::string_view path, const HttpRequest& request) const;
  [[nodiscard]] HttpResponse answer_preview(std::string_view rest) const;
  [[nodiscard]] HttpResponse answer_attempts(const HttpRequest& request) const;
  [[nodiscard]] HttpResponse answer_quiz_answers(const HttpRequest& request) const;
  [[nodiscard]] HttpResponse answer_attempt(std::string_view rest,
                                            const HttpRequest& request) const;
  [[nodiscard]] HttpResponse answer_replay(std::int64_t id,
                                           std::string_view what,
                                           std::string_view target) const;
  [[nodiscard]] bool may_see(const Guest& guest, std::int64_t attempt) const;

  std::string case_fingerprint_;
  std::string case_json_;
  std::shared_ptr<const SharedShelf> shelf_;
  std::shared_ptr<const TruthGate> truth_;
  std::string procedures_json_;
  std::string instruments_json_;
  std::shared_ptr<const std::string> scene_glb_;
  const records::AttemptKeeper& records_;
  RecordOwners owners_;
  StaticFiles files_;
  std::unique_ptr<ReplayDesk> replays_;
};

}  // namespace carpus::server
