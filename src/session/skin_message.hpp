// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cases/case_data.hpp"
#include "procedure/procedure.hpp"
#include "protocol/messages.hpp"
#include "session/body_names.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::session {

/// Skin as it is worked on now; none where the procedure makes no portals. What shows a portal's
/// place is in it in practice alone, once a ghost was asked for.
[[nodiscard]] std::optional<protocol::Skin> skin_message(const cases::CaseData& data,
                                                         const BodyNames& names,
                                                         const simulation::Snapshot& now);

/// A step's text with the second portal's name and landmarks in place of {second} and
/// {second_landmarks}, and what goes before its needle of {second_before_needle}; as it is where
/// the procedure makes no portals.
[[nodiscard]] std::string with_second_portal(std::string text,
                                             const cases::CaseData& data,
                                             const procedure::Procedure& procedure,
                                             std::uint64_t seed);

}  // namespace carpus::session
