// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The table of the view quiz's answers in an open records file. SQLite's exceptions pass through.
#pragma once

#include <SQLiteCpp/Database.h>

#include <cstddef>
#include <cstdint>
#include <functional>

#include "records/quiz_answer.hpp"

namespace carpus::records::detail {

/// @return its number.
std::int64_t insert(SQLite::Database& database, const QuizAnswer& answer);

/// At most so many that `seen` lets through, with numbers below `before`; 0 begins with the newest.
[[nodiscard]] QuizAnswerPage read_page(const SQLite::Database& database,
                                       std::int64_t before,
                                       std::size_t most,
                                       const std::function<bool(std::int64_t id)>& seen);

}  // namespace carpus::records::detail
