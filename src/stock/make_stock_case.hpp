// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "cases/lesson.hpp"
#include "core/progress.hpp"
#include "stock/stock_list.hpp"

namespace carpus::stock {

/// Whether `folder` holds a case with its lesson: made to the end, and of this item.
[[nodiscard]] bool is_made(const std::filesystem::path& folder, const StockItem& item);

/// Simulates the wrist, reconstructs it, measures how hard it is, lets the scripted expert try
/// where it is to be fixed as it lies, and writes case, picture and, last, lesson into `folder`,
/// replacing what was begun there. Returns the lesson.
/// @param made_at  UTC, ISO 8601, for the case's provenance.
/// @throws IoError, InvalidInput as phantom, reconstruct and case_io.
[[nodiscard]] cases::Lesson make_stock_case(const StockItem& item,
                                            const std::filesystem::path& folder,
                                            const std::string& made_at,
                                            const Progress& progress = no_progress);

}  // namespace carpus::stock
