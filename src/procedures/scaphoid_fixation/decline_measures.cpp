// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// When not to operate. The truth is the case's lesson: what a teacher wrote, for geometry alone
// does not say what may be done about it.
#include <algorithm>
#include <bit>
#include <string>
#include <utility>

#include "procedures/scaphoid_fixation/measures.hpp"
#include "procedures/scaphoid_fixation/views.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

using cases::RightAnswer;
using procedure::Measure;

constexpr const char* kNoLesson = "Nobody wrote down which answer is right for this case.";

bool holds(const cases::Lesson& lesson, const std::string& reason) {
  return std::find(lesson.decline_for.begin(), lesson.decline_for.end(), reason) !=
         lesson.decline_for.end();
}

std::string listed(const char* lead, const std::string& labels) {
  return labels.empty() ? std::string{} : lead + labels + ".";
}

void add(std::string& list, const std::string& label) {
  list += (list.empty() ? "" : ", ") + label;
}

Measure declining_is_right(const cases::CaseData& data) {
  Measure measure{"declining_is_right", std::nullopt, kNoLesson};
  if (!data.lesson) return measure;
  measure.value = data.lesson->right_answer == RightAnswer::Decline ? 1.0 : 0.0;
  measure.finding = data.lesson->reason;
  return measure;
}

/// Of the reasons that hold here, how many were said; and how many were said that do not hold.
std::vector<Measure> reasons(const cases::CaseData& data,
                             const procedure::OperationRecord& record,
                             const procedure::Procedure& procedure) {
  Measure right{"right_reasons_percent", std::nullopt, kNoLesson};
  Measure wrong{"wrong_reasons", std::nullopt, kNoLesson};
  if (!data.lesson) return {right, wrong};
  const auto& all = procedure.decline.reasons;
  double hold = 0;
  double said = 0;
  wrong.value = 0.0;
  std::string missed;
  std::string mistaken;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool is_said = (record.declined_for >> i & 1U) != 0;
    if (holds(*data.lesson, all[i].id)) {
      hold += 1;
      if (is_said) said += 1;
      if (!is_said) add(missed, all[i].label);
    } else if (is_said) {
      *wrong.value += 1;
      add(mistaken, all[i].label);
    }
  }
  right.value = hold > 0 ? 100 * said / hold : 0.0;
  right.finding = hold > 0 ? listed("Not said: ", missed) : "No reason to decline holds here.";
  wrong.finding = listed("Said, and not so: ", mistaken);
  return {right, wrong};
}

Measure views_before(const procedure::OperationRecord& record) {
  unsigned seen = 0;
  for (const procedure::Shot& shot : record.shots) {
    for (const View view : {View::Pa, View::Lateral}) {
      if (shows(view, shot.rotation_deg, shot.tilt_deg)) seen |= 1U << static_cast<unsigned>(view);
    }
  }
  Measure measure{"views_before_declining", static_cast<double>(std::popcount(seen)), ""};
  return measure;
}

}  // namespace

Measure fixing_is_right(const cases::CaseData& data) {
  Measure measure{"fixing_is_right", std::nullopt, kNoLesson};
  measure.applies = data.lesson.has_value();
  if (!data.lesson) return measure;
  measure.value = data.lesson->right_answer == RightAnswer::Decline ? 0.0 : 1.0;
  measure.finding = data.lesson->reason;
  return measure;
}

std::vector<Measure> decline_measures(const cases::CaseData& data,
                                      const procedure::OperationRecord& record,
                                      const procedure::Procedure& procedure) {
  std::vector<Measure> all = reasons(data, record, procedure);
  all.push_back(declining_is_right(data));
  all.push_back(views_before(record));
  all.push_back({"bone_entered", static_cast<double>(record.passes.size()), ""});
  return all;
}

}  // namespace carpus::procedures::scaphoid_fixation
