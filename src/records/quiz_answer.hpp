// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is kept of one answered question of the view quiz.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace carpus::records {

struct QuizAnswer {
  std::int64_t id = 0;    ///< given by the store; 0 until stored
  std::string trainee;    ///< as typed; may be empty
  std::string case_name;  ///< the case's pseudonym
  std::string case_fingerprint;
  std::int64_t seed = 0;      ///< of the quiz: with the case and the number it is the question
  std::int64_t question = 0;  ///< its number in the quiz, from 1
  std::string answered_at;    ///< UTC, ISO 8601
  std::string place;          ///< protocol's `screw_place`, the truth
  double depth_mm = 0;        ///< out of the bone; negative: the least that covers it
  std::string answered;       ///< protocol's `screw_place`
  std::string next_view;
  bool is_view_right = false;
  std::int64_t views_taken = 0;  ///< before the answer, the first too
  bool operator==(const QuizAnswer&) const = default;
};

/// Answers as a list shows them, newest first.
struct QuizAnswerPage {
  std::vector<QuizAnswer> answers;
  bool older = false;  ///< there are older ones than the last of these
};

}  // namespace carpus::records
