// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What every procedure can measure of how an operation went: pictures, dose, time, what was taken
// back, steps left out (docs/scoring.md).
#pragma once

#include <string>
#include <vector>

#include "procedure/grading.hpp"
#include "procedure/operation_record.hpp"
#include "procedure/procedure.hpp"

namespace carpus::procedure {

/// A number as findings show it: one decimal.
[[nodiscard]] std::string text_of(double value);

/// `shots`, `dose_cgy_cm2`, `time_s`, `undos`, `aids_used`, `steps_left_out`.
/// @param pictures  what was taken of what, one sentence for the finding; may be empty.
/// @param doses  the same of what each took.
[[nodiscard]] std::vector<Measure> thrift_measures(const Procedure& procedure,
                                                   const OperationRecord& record,
                                                   std::string pictures,
                                                   std::string doses = {});

}  // namespace carpus::procedure
