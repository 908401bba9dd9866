// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Loading what several verbs need: a case ready to operate on, a recording, a score as a table.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "cases/case_data.hpp"
#include "procedure/procedure.hpp"
#include "procedure/score.hpp"
#include "simulation/recording.hpp"

namespace carpus::cli {

/// The case that ./run makes.
inline constexpr const char* kDefaultCase = "cases/demo";
/// Where ./run keeps attempts.
inline constexpr const char* kDefaultRecords = "recordings/attempts.sqlite";

/// Reads a case folder as scanned, trims the skin's ends, and makes the table of hand motion where
/// the case is of a program that had none.
/// @throws IoError, SchemaError  as case_io::read_case.
[[nodiscard]] cases::CaseData load_case(const std::filesystem::path& folder);

/// The procedure of this program with this id. @throws InvalidInput naming those that there are.
[[nodiscard]] const procedure::Procedure& find_procedure(const std::string& id);

/// Reads a recording. @throws IoError  where it is missing, cut short or damaged.
[[nodiscard]] simulation::Recording load_recording(const std::filesystem::path& file);

/// Replays a recording on the case that it was made on; `see` is called after each tick.
/// @throws InvalidInput  when it was made on another case, naming --case, or with a procedure that
///     this program does not have.
[[nodiscard]] simulation::Replay replay_on_its_case(
    const cases::CaseData& data,
    const simulation::Recording& recording,
    const std::function<void(const simulation::Snapshot&)>& see = {});

/// " (simulated)" after the name of such a case, nothing after others.
[[nodiscard]] std::string simulated_mark(bool is_simulated);

/// How a verb names its case: "'demo wrist' (simulated)".
[[nodiscard]] std::string in_words(const cases::CaseData& data);

/// The score for people: two lines an item, with value, grade, points and target, then the reason;
/// what must hold; the lengths in the scaphoid.
[[nodiscard]] std::string score_table(const procedure::ScoreReport& report);

/// The score report of docs/json.md with the case that it is about.
[[nodiscard]] std::string score_file(const cases::CaseData& data,
                                     const procedure::ScoreReport& report);

}  // namespace carpus::cli
