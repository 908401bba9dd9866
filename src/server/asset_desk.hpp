// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How instructors rate arthroscopies by the ASSET (arthroscopy/asset_table.hpp), over HTTP. A form
// is nobody's measure but its rater's: it changes no score.
//
//   GET  /api/asset?attempt=ID   protocol's asset_forms; a trainee sees the finished ones of their
//                                own attempts
//   PUT  /api/asset?attempt=ID   protocol's asset_rating, an instructor's; answered by all forms
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <variant>

#include "arthroscopy/asset_table.hpp"
#include "records/attempt_keeper.hpp"
#include "server/attempt_owners.hpp"
#include "server/http_message.hpp"

namespace carpus::server {

class AssetDesk {
 public:
  /// A longer form is refused before a byte of it is read.
  static constexpr std::uint64_t kMostBytes = 32768;

  /// @param records  and all else must outlive it.
  AssetDesk(records::AttemptKeeper& records,
            const AttemptOwners& owners,
            const arthroscopy::AssetTable& table = arthroscopy::AssetTable::built_in())
      : records_(records), owners_(owners), table_(table) {}

  /// Whether a request is for this desk.
  [[nodiscard]] static bool is_for(const HttpRequest& request);
  /// Reads the records: not for the network's thread.
  [[nodiscard]] HttpResponse answer(const HttpRequest& request) const;
  /// That the page is our own is the door's to see.
  [[nodiscard]] std::variant<std::unique_ptr<BodyTaker>, HttpResponse> take_body(
      const HttpRequest& request,
      std::uint64_t bytes) const;

 private:
  class FormTaker;
  [[nodiscard]] HttpResponse rate(const Guest& guest,
                                  std::int64_t attempt,
                                  std::string_view text) const;
  [[nodiscard]] HttpResponse forms_of(const Guest& guest, std::int64_t attempt) const;

  records::AttemptKeeper& records_;
  const AttemptOwners& owners_;
  const arthroscopy::AssetTable& table_;
};

}  // namespace carpus::server
