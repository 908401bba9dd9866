// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The score and the tray of screws as the protocol says them: the one form in which they are
// stored, sent and printed.
#pragma once

#include "procedure/score.hpp"
#include "protocol/bodies.hpp"

namespace carpus::server {

[[nodiscard]] protocol::ScoreReport score_message(const procedure::ScoreReport& report);

/// In the order of the indices.
[[nodiscard]] protocol::ScrewTray screw_tray();

}  // namespace carpus::server
