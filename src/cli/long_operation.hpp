// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A long operation for measuring: a hand that searches the bone for most of the time, never at
// rest, then a scripted expert who operates.
#pragma once

#include <vector>

#include "cases/case_data.hpp"
#include "procedure/procedure.hpp"
#include "simulation/recording.hpp"

namespace carpus::cli {

struct LongOperation {
  simulation::Recording recording;
  std::vector<Tick> shots;  ///< when pictures were taken
};

/// @param ticks  at least that long, and the rest of what the expert needs.
[[nodiscard]] LongOperation make_long_operation(const cases::CaseData& data,
                                                const procedure::Procedure& procedure,
                                                Tick ticks);

}  // namespace carpus::cli
