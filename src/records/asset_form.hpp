// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is kept of an ASSET: how one person rated one attempt. What its rows mean and what they come
// to is not known here (arthroscopy/asset_table.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace carpus::records {

/// Of one attempt; a further rater is refused.
inline constexpr std::size_t kMostAssetForms = 16;

struct AssetForm {
  std::int64_t attempt = 0;
  std::string rater;           ///< as typed; of one attempt no two forms have the same
  std::int64_t revision = 0;   ///< how often it was saved; given by the store
  std::string saved_at;        ///< UTC, ISO 8601
  std::string answers_json;    ///< protocol's `stored_asset_answers`
  std::string comment;         ///< may be empty
  std::optional<int> total;    ///< none while rows are missing
  std::optional<bool> passes;  ///< likewise
  bool operator==(const AssetForm&) const = default;
};

/// What became of a form that was to be saved.
enum class AssetSaving : std::uint8_t {
  Saved,
  NoAttempt,  ///< there is none of that number
  Stale,      ///< the form is not, or no longer, the one that was to be amended
  Full,       ///< so many have rated the attempt
};

}  // namespace carpus::records
