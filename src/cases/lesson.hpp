// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a case is for: its title, what is to be learnt, which answer is right and how hard it is. A
// file of its own beside the case (docs/case_format.md), so that a teacher can write one for any.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carpus::cases {

inline constexpr int kLessonSchemaVersion = 2;

/// What should be done about the fracture.
enum class RightAnswer : std::uint8_t {
  Fix,          ///< as it lies
  ReduceFirst,  ///< then fix
  Decline,      ///< not percutaneously: open, with a graft, by somebody else
};
inline constexpr std::array<std::string_view, 3> kRightAnswers{"fix", "reduce_first", "decline"};

[[nodiscard]] constexpr std::string_view name_of(RightAnswer answer) noexcept {
  return kRightAnswers[static_cast<std::size_t>(answer)];
}

/// What makes a case hard, measured [mm, deg], and the figure made of it (lesson_difficulty.hpp).
struct Difficulty {
  double corridor_clearance_mm = 0;  ///< around the smallest screw on the central axis
  double corridor_length_mm = 0;     ///< of the central axis, for the screw
  double smaller_part_mm = 0;        ///< of the central axis in the shorter fragment
  double gap_mm = 0;
  double step_mm = 0;
  double flexion_deg = 0;  ///< of the distal fragment
  double overall = 0;      ///< 0 easy to 100
  bool operator==(const Difficulty&) const = default;
};

/// How a scripted expert fared: proof that the case can be solved. In silico.
struct ExpertProof {
  std::string procedure;
  std::uint64_t seed = 0;
  bool is_acceptable = false;
  double overall = 0;  ///< of the score
  bool operator==(const ExpertProof&) const = default;
};

struct Lesson {
  std::string title;
  std::string history;  ///< what the patient tells: no diagnosis, so that it can be told beforehand
  std::string goal;     ///< what is to be learnt
  std::string size;     ///< "small", "average", "large"
  RightAnswer right_answer = RightAnswer::Fix;
  std::string reason;  ///< for that answer
  /// Which of a procedure's reasons to decline hold here (procedure.json); none unless Decline.
  std::vector<std::string> decline_for;
  Difficulty difficulty;
  std::optional<ExpertProof> expert;  ///< none: nobody tried
  bool operator==(const Lesson&) const = default;
};

}  // namespace carpus::cases
