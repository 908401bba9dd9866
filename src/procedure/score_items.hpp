// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How items of a score are made and graded, and the items that every procedure can share: pictures,
// dose, time, undos (docs/scoring.md).
#pragma once

#include <string>

#include "procedure/operation_record.hpp"
#include "procedure/score.hpp"

namespace carpus::procedure {

[[nodiscard]] ScoreItem make_item(const char* id,
                                  const char* label,
                                  const char* unit,
                                  double points_possible);

/// A number as texts show it.
[[nodiscard]] std::string text_of(double value, const char* format = "%.1f");

/// Full points up to `good`, falling linearly to none at `fail`.
[[nodiscard]] double falling_points(double value, double good, double fail, double possible);

/// Grades a value of which less is better: sets value, points and grade.
void grade_falling(ScoreItem& item, double value, double good, double fail);

/// Thrift earns points only when the result is acceptable: novices take the fewest pictures.
/// @param taken  what was taken of what, one sentence, at the end of the reason; may be empty.
[[nodiscard]] ScoreItem shots_item(const OperationRecord& record,
                                   bool is_acceptable,
                                   double points,
                                   const std::string& taken);
[[nodiscard]] ScoreItem dose_item(const OperationRecord& record, bool is_acceptable, double points);
[[nodiscard]] ScoreItem time_item(const OperationRecord& record, bool is_acceptable, double points);

/// @param has_begun  whether there was anything to take back.
/// @param nothing_done  the reason where there was not.
[[nodiscard]] ScoreItem undos_item(const OperationRecord& record,
                                   bool has_begun,
                                   const std::string& nothing_done,
                                   double points);

/// Sets `overall` to the sum of the items' points, 0 to 100.
void sum_up(ScoreReport& report);

}  // namespace carpus::procedure
