// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "view_trainer/view_quiz.hpp"

#include <algorithm>
#include <string>

#include "view_trainer/outline_message.hpp"
#include "view_trainer/silhouette.hpp"

namespace carpus::view_trainer {
namespace {

std::optional<std::size_t> find_view(std::string_view id) {
  const auto views = standard_views();
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i].id == id) return i;
  }
  return std::nullopt;
}

protocol::ScrewPlace place_of(const GeneratedScrew& screw) {
  if (!screw.is_out()) return protocol::ScrewPlace::Inside;
  switch (screw.truth.region) {
    case Region::Distal:
      return protocol::ScrewPlace::Distal;
    case Region::Proximal:
      return protocol::ScrewPlace::Proximal;
    case Region::Side:
      break;
  }
  return protocol::ScrewPlace::Side;
}

std::string no_such_view(std::string_view id) {
  return "The quiz has no view '" + std::string(id.substr(0, 32)) + "'";
}

std::vector<StandardView> quiz_views() {
  const auto views = standard_views();
  return {views.begin(), views.end()};
}

}  // namespace

ViewQuiz::ViewQuiz(const cases::CaseData& data)
    : scaphoid_(data), views_(scaphoid_, quiz_views()), renderer_(make_renderer(data)) {}

void ViewQuiz::begin(std::uint64_t seed) {
  seeds_.emplace(seed);
  screw_.reset();
  tally_ = {};
  number_ = 0;
}

Result<protocol::QuizQuestion> ViewQuiz::next() {
  if (!seeds_) return Refusal{"No quiz was begun"};
  if (screw_ && !is_answered_) return Refusal{"The question is not answered yet"};
  do {
    screw_ = generate_screw(scaphoid_, seeds_->next());
  } while (!can_be_known(*screw_));
  is_answered_ = false;
  taken_.assign(views_.views().size(), false);
  protocol::QuizQuestion question;
  question.number = ++number_;
  for (const StandardView& view : views_.views()) {
    question.views.push_back({std::string(view.id), std::string(view.label), std::string(view.name),
                              view.angles.rotation_deg, view.angles.tilt_deg});
  }
  // What is looked at first in an operation too.
  question.first_view = seeds_->below(2) == 0 ? "pa" : "lateral";
  question.screw = screw_->placed.instrument().name;
  question.tally = tally_;
  return question;
}

Result<QuizPicture> ViewQuiz::look(std::string_view id) {
  if (!screw_) return Refusal{"No question is asked"};
  const auto view = find_view(id);
  if (!view) return Refusal{no_such_view(id)};
  if (!is_answered_ && !taken_[*view]) {
    taken_[*view] = true;
    ++tally_.views_taken;
  }
  const PosedView& posed = views_.at(*view).posed;
  const auto metal = metal_of(screw_->placed, posed.patient_from_scaphoid);
  fluoroscopy::Exposure exposure;
  exposure.seed = static_cast<std::uint64_t>(number_) * 16 + *view;
  return QuizPicture{number_, views_.views()[*view].angles,
                     renderer_.render({posed.c_arm, posed.patient_from_bone, metal}, exposure)};
}

std::vector<double> ViewQuiz::overhangs_of(const PlacedScrew& placed) const {
  std::vector<double> overhangs;
  for (std::size_t i = 0; i < views_.views().size(); ++i) {
    overhangs.push_back(views_.overhang_of(placed, i).true_mm);
  }
  return overhangs;
}

bool ViewQuiz::can_be_known(const GeneratedScrew& screw) const {
  const std::vector<double> overhangs = overhangs_of(screw.placed);
  return !screw.is_out() || *std::max_element(overhangs.begin(), overhangs.end()) >= kRevealedMm;
}

PlacedScrew ViewQuiz::as_if_out() const {
  PlacedScrew placed = screw_->placed;
  if (screw_->is_out()) return placed;
  const double height = dot(screw_->truth.at - placed.tip, placed.shaft);
  const Vec3 outwards = height < placed.instrument().length_mm / 2 ? -placed.shaft : placed.shaft;
  constexpr double kStepMm = 0.25;
  constexpr int kFarthest = 80;
  for (int i = 0; i < kFarthest; ++i) {
    if (scaphoid_.protrusion_of(placed).depth_mm >= kWereItOutMm) break;
    placed.tip += outwards * kStepMm;
  }
  return placed;
}

bool ViewQuiz::is_view_right(std::size_t view) const {
  const std::vector<double> overhangs = overhangs_of(as_if_out());
  double greatest = -1e9;
  for (std::size_t i = 0; i < overhangs.size(); ++i) {
    if (!taken_[i]) greatest = std::max(greatest, overhangs[i]);
  }
  // Where none of those left would tell, the one that comes nearest.
  return overhangs[view] >= std::min(kRevealedMm, greatest);
}

protocol::QuizViewTruth ViewQuiz::truth_of(std::size_t view) const {
  const CaseView& seen = views_.at(view);
  protocol::QuizViewTruth truth;
  truth.view = views_.views()[view].id;
  truth.overhang_mm = views_.overhang_of(screw_->placed, view).true_mm;
  truth.reveals = truth.overhang_mm >= kRevealedMm;
  truth.bone = outline_messages(seen.truth);
  truth.screw = outline_message(screw_outline(screw_->placed, seen.posed));
  return truth;
}

Result<protocol::QuizTruth> ViewQuiz::answer(const protocol::QuizAnswer& answer) {
  if (!screw_) return Refusal{"No question is asked"};
  if (is_answered_) return Refusal{"The question is answered already"};
  const auto view = find_view(answer.next_view);
  if (!view) return Refusal{no_such_view(answer.next_view)};
  const bool all_taken = std::find(taken_.begin(), taken_.end(), false) == taken_.end();
  if (taken_[*view] && !all_taken) return Refusal{"That view was taken already"};
  protocol::QuizTruth truth;
  truth.number = number_;
  truth.place = place_of(*screw_);
  truth.depth_mm = screw_->truth.depth_mm;
  if (screw_->is_out()) truth.towards = scaphoid_.neighbour_at(screw_->truth.at);
  truth.answered = answer.place;
  truth.next_view = answer.next_view;
  truth.is_place_right = truth.place == answer.place;
  truth.is_view_right = all_taken || is_view_right(*view);
  truth.is_false_safety = answer.place == protocol::ScrewPlace::Inside && !truth.is_place_right;
  const std::vector<double> overhangs = overhangs_of(as_if_out());
  const auto best = std::max_element(overhangs.begin(), overhangs.end()) - overhangs.begin();
  truth.best_view = views_.views()[static_cast<std::size_t>(best)].id;
  truth.revealed_mm = kRevealedMm;
  for (std::size_t i = 0; i < views_.views().size(); ++i) truth.views.push_back(truth_of(i));
  is_answered_ = true;
  ++tally_.answers;
  if (truth.is_place_right) ++tally_.right_places;
  if (truth.is_view_right) ++tally_.right_views;
  if (truth.is_false_safety) ++tally_.false_safety;
  truth.tally = tally_;
  return truth;
}

}  // namespace carpus::view_trainer
