// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a station that was killed left behind: the exercise that ran is gone on with, what cannot be
// gone on with is stored as it is, what cannot be read is set aside; each with a word.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "procedure/procedure.hpp"
#include "server/exercise.hpp"

namespace carpus::server {

/// An exercise that ran when its station was killed, and stands where its journal ends.
struct ResumedExercise {
  ExerciseSetup setup;
  ExerciseStart start;
  std::string owner;             ///< of the page that operated, its word in hello
  std::vector<TakenShot> shots;  ///< its last pictures, to be made again
};

/// An attempt that goes into the records; its journal is deleted when it is there.
struct AttemptLeftBehind {
  records::Attempt attempt;
  std::shared_ptr<ExerciseJournal> journal;
};

struct LeftBehind {
  std::unique_ptr<ResumedExercise> running;
  std::vector<AttemptLeftBehind> ended;
  std::vector<std::string> words;
};

/// @param is_stored  whether an attempt of this origin is in the records already.
/// @param shots  how many pictures are wanted again.
[[nodiscard]] LeftBehind look_for_what_was_left(
    const cases::CaseData& data,
    std::uint64_t case_fingerprint,
    const procedure::ProcedureList& procedures,
    const std::filesystem::path& records,
    const std::function<bool(const std::string& origin)>& is_stored,
    std::size_t shots);

}  // namespace carpus::server
