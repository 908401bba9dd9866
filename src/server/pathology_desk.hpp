// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What an instructor prepares to be wrong in a case's joints (cases/prepared_pathology.hpp), over
// HTTP. A trainee is told nothing of it; nobody is while an assessed operation runs.
//
//   GET  /api/pathology           protocol's case_pathology, whether who asks may do all this
//   GET  /api/pathology?case=ID   the same with what that case has prepared
//   PUT  /api/pathology?case=ID   protocol's pathology_wish; answered by case_pathology
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "cases/prepared_pathology.hpp"
#include "protocol/bodies.hpp"
#include "server/case_shelf.hpp"
#include "server/http_message.hpp"
#include "server/truth_gate.hpp"

namespace carpus::server {

/// The file of a case folder; throw carpus::Error where they fail. None: at random each time.
struct PathologyFiles {
  std::function<std::optional<cases::PreparedPathology>(const std::filesystem::path& folder)> read;
  std::function<void(const std::filesystem::path& folder,
                     const std::optional<cases::PreparedPathology>& pathology)>
      write;
};

class PathologyDesk {
 public:
  /// A longer wish is refused before a byte of it is read.
  static constexpr std::uint64_t kMostBytes = 16384;

  PathologyDesk(std::shared_ptr<const SharedShelf> shelf,
                std::shared_ptr<const TruthGate> truth,
                PathologyFiles files);

  /// Whether a request is for this desk.
  [[nodiscard]] static bool is_for(const HttpRequest& request);
  /// Reads the disk: not for the network's thread.
  [[nodiscard]] HttpResponse answer(const HttpRequest& request) const;
  /// That the page is our own is the door's to see.
  [[nodiscard]] std::variant<std::unique_ptr<BodyTaker>, HttpResponse> take_body(
      const HttpRequest& request,
      std::uint64_t bytes) const;

 private:
  class WishTaker;
  /// Why the request is not granted; nothing where it is.
  [[nodiscard]] std::optional<HttpResponse> refused(const HttpRequest& request) const;
  /// Of the case that a target names; empty where there is none.
  [[nodiscard]] std::filesystem::path folder_of(const std::string& target) const;
  [[nodiscard]] HttpResponse tell(const std::string& target) const;
  [[nodiscard]] HttpResponse prepare(const std::string& target, std::string_view text) const;

  std::shared_ptr<const SharedShelf> shelf_;
  std::shared_ptr<const TruthGate> truth_;
  PathologyFiles files_;
};

}  // namespace carpus::server
