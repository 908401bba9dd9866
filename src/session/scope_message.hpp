// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a page is told of an arthroscopy: once what it goes by, then the scope as it is.
#pragma once

#include <cstdint>
#include <optional>

#include "cases/case_data.hpp"
#include "procedure/procedure.hpp"
#include "protocol/messages.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::session {

/// None where no scope is on the tray or the case has no map. Of an examination with what is wrong.
/// @param seed, prepared  of the exercise.
[[nodiscard]] std::optional<protocol::Arthroscopy> arthroscopy_of(
    const cases::CaseData& data,
    const procedure::Procedure& procedure,
    std::uint64_t seed,
    const std::optional<cases::PreparedPathology>& prepared = {});

/// None where no hand holds a scope. What is in view now is told in practice alone.
[[nodiscard]] std::optional<protocol::Scope> scope_message(const cases::CaseData& data,
                                                           const procedure::Procedure& procedure,
                                                           const simulation::Snapshot& now);

/// By how much this sheet is off where it was scanned; without numbers where it is not.
/// @param sheet  below Snapshot::sheet_count
[[nodiscard]] protocol::Sheet sheet_message(const simulation::Snapshot& now, std::size_t sheet);

}  // namespace carpus::session
