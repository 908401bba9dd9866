// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The table of ASSET forms in an open records file. SQLite's exceptions pass through.
#pragma once

#include <SQLiteCpp/Database.h>

#include <cstdint>
#include <vector>

#include "records/asset_form.hpp"

namespace carpus::records::detail {

/// In a transaction of the caller's. @param amended  the revision that the rater saw; 0 of none
[[nodiscard]] AssetSaving save(SQLite::Database& database,
                               const AssetForm& form,
                               std::int64_t amended);

/// Of one attempt, the oldest first.
[[nodiscard]] std::vector<AssetForm> read_forms(const SQLite::Database& database,
                                                std::int64_t attempt);

}  // namespace carpus::records::detail
