// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which cases the stock has: data/stock.json, so that words and answers can be corrected without a
// compiler's knowledge.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cases/lesson.hpp"
#include "phantom/phantom.hpp"

namespace carpus::stock {

struct StockItem {
  std::string id;  ///< of its folder
  phantom::PhantomOptions wrist;
  cases::Lesson lesson;  ///< title, goal, size, answer and reason; the rest is measured
};

/// In the order in which they are learnt. Read once.
/// @throws InvalidInput naming file and field when the built-in data are wrong.
[[nodiscard]] std::span<const StockItem> stock_list();

/// Reads such a list; `file` names it in errors. @throws InvalidInput.
[[nodiscard]] std::vector<StockItem> read_stock_list(std::string_view json, std::string_view file);

}  // namespace carpus::stock
