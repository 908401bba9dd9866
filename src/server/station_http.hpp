// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the station answers over HTTP (protocol/README.md): the page's files, the case, the tray of
// screws and the records.
#pragma once

#include <memory>
#include <string>

#include "cases/case_data.hpp"
#include "records/attempt_keeper.hpp"
#include "server/http_message.hpp"
#include "server/static_files.hpp"

namespace carpus::server {

class StationHttp {
 public:
  /// Prepares what never changes. @param records must outlive it.
  StationHttp(const cases::CaseData& posed_case,
              std::string scene_glb,
              const records::AttemptKeeper& records,
              const std::filesystem::path& web_root);

  /// Never throws for a bad request; IoError when the records cannot be read.
  [[nodiscard]] HttpResponse answer(const HttpRequest& request) const;

 private:
  [[nodiscard]] HttpResponse answer_api(std::string_view path) const;
  [[nodiscard]] HttpResponse answer_attempts() const;
  [[nodiscard]] HttpResponse answer_attempt(std::string_view rest) const;

  std::string case_fingerprint_;
  std::string case_json_;
  std::string screws_json_;
  std::shared_ptr<const std::string> scene_glb_;
  const records::AttemptKeeper& records_;
  StaticFiles files_;
};

}  // namespace carpus::server
