// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The quiz: a generated screw, pictures of it, the question where it is out and which view would
// tell, and then the truth. Nothing of the truth leaves before the answer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "core/rng.hpp"
#include "fluoroscopy/composed_renderer.hpp"
#include "protocol/messages.hpp"
#include "view_trainer/generated_screw.hpp"
#include "view_trainer/seen_screw.hpp"

namespace carpus::view_trainer {

/// A picture of the question that is asked.
struct QuizPicture {
  std::int64_t question = 0;
  fluoroscopy::ViewAngles angles;
  fluoroscopy::Image image;
};

/// What a screw that is inside is moved out by, to say which view would show it [mm].
inline constexpr double kWereItOutMm = 1.5;

class ViewQuiz {
 public:
  /// Takes the scan apart: about a second. @param data  must outlive it.
  /// @throws InvalidInput where the case has no scaphoid.
  explicit ViewQuiz(const cases::CaseData& data);

  /// Forgets what was answered; the same seed asks the same questions.
  void begin(std::uint64_t seed);
  /// The next question. @return why not: none was begun, or the last is not answered.
  [[nodiscard]] Result<protocol::QuizQuestion> next();
  /// A picture of it. @return why not: no question, or no such view.
  [[nodiscard]] Result<QuizPicture> look(std::string_view view);
  /// @return why not: no question, answered already, or no such view, or one taken already.
  [[nodiscard]] Result<protocol::QuizTruth> answer(const protocol::QuizAnswer& answer);

 private:
  /// By view, of a screw as it lies.
  [[nodiscard]] std::vector<double> overhangs_of(const PlacedScrew& placed) const;
  /// Whether one of the views reveals it where it is out: nothing else is asked.
  [[nodiscard]] bool can_be_known(const GeneratedScrew& screw) const;
  /// The screw, or where it is inside the same moved out of its nearest end.
  [[nodiscard]] PlacedScrew as_if_out() const;
  [[nodiscard]] bool is_view_right(std::size_t view) const;
  [[nodiscard]] protocol::QuizViewTruth truth_of(std::size_t view) const;

  ScaphoidSurface scaphoid_;
  CaseViews views_;
  fluoroscopy::ComposedRenderer renderer_;
  std::optional<Rng> seeds_;
  std::optional<GeneratedScrew> screw_;
  bool is_answered_ = false;
  std::int64_t number_ = 0;
  std::vector<bool> taken_;  ///< by view
  protocol::QuizTally tally_;
};

}  // namespace carpus::view_trainer
