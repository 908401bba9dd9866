// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The score as the protocol says it: the one form in which it is stored, sent and printed.
#pragma once

#include "procedure/score.hpp"
#include "protocol/bodies.hpp"

namespace carpus::session {

[[nodiscard]] protocol::ScoreReport score_message(const procedure::ScoreReport& report);

}  // namespace carpus::session
