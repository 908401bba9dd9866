// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a page may know of case, procedure and instruments before anything is done: no landmark that
// would give an answer away.
#pragma once

#include <vector>

#include "arthroscopy/pathology_table.hpp"
#include "cases/case_data.hpp"
#include "procedure/mode.hpp"
#include "procedure/procedure.hpp"
#include "protocol/bodies.hpp"
#include "protocol/messages.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::session {

[[nodiscard]] protocol::CaseDescription case_description(const cases::CaseData& data);
[[nodiscard]] protocol::ProcedureList procedure_list(const procedure::ProcedureList& procedures);
/// The whole catalogue.
[[nodiscard]] protocol::InstrumentList instrument_list();
/// What an examination asks about, with the grades that may be answered.
[[nodiscard]] std::vector<protocol::Finding> findings_of(const arthroscopy::PathologyTable& table);
/// What is being done. @param aim  of the procedure on this case. @param opening  of the exercise:
/// its way, its seed and what is prepared to be wrong.
[[nodiscard]] protocol::Exercise exercise_message(const cases::CaseData& data,
                                                  const procedure::Procedure& procedure,
                                                  const procedure::Aim& aim,
                                                  const simulation::Snapshot& opening);

[[nodiscard]] protocol::WristPose message_of(const procedure::WristPose& wrist) noexcept;

}  // namespace carpus::session
