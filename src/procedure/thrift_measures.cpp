// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/thrift_measures.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "procedure/aid.hpp"
#include "procedure/shots.hpp"

namespace carpus::procedure {
namespace {

Measure steps_left_out(const Procedure& procedure, const OperationRecord& record) {
  Measure measure{"steps_left_out", 0.0, ""};
  std::string names;
  for (std::size_t i = 0; i < procedure.steps.size(); ++i) {
    if (is_completed(record.completed_steps, i)) continue;
    *measure.value += 1.0;
    names += (names.empty() ? "" : ", ") + procedure.steps[i].title;
  }
  measure.finding = names.empty() ? "All were done." : "Not done, or not rightly: " + names + ".";
  return measure;
}

/// Of the steps that were done, those that would have to be moved for all to have come in order:
/// all but the longest row of them in which each was first done no earlier than the one before.
Measure steps_out_of_order(const Procedure& procedure, const OperationRecord& record) {
  Measure measure{"steps_out_of_order", 0.0, ""};
  std::vector<std::size_t> done;
  for (std::size_t i = 0; i < record.first_done.size() && i < procedure.steps.size(); ++i) {
    if (record.first_done[i] != 0) done.push_back(i);
  }
  std::vector<std::size_t> row(done.size(), 1);               // the longest that ends at each
  std::vector<std::size_t> before(done.size(), done.size());  // its last but one
  std::size_t last = done.size();
  for (std::size_t i = 0; i < done.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const bool is_in_order = record.first_done[done[j]] <= record.first_done[done[i]];
      if (is_in_order && row[j] + 1 > row[i]) {
        row[i] = row[j] + 1;
        before[i] = j;
      }
    }
    if (last == done.size() || row[i] > row[last]) last = i;
  }
  std::vector<bool> is_kept(done.size(), false);
  for (std::size_t i = last; i < done.size(); i = before[i]) is_kept[i] = true;
  std::string names;
  for (std::size_t i = 0; i < done.size(); ++i) {
    if (is_kept[i]) continue;
    *measure.value += 1.0;
    names += (names.empty() ? "" : ", ") + procedure.steps[done[i]].title;
  }
  measure.finding = names.empty() ? "All came in order." : "Not in their place: " + names + ".";
  return measure;
}

Measure aids_used(const OperationRecord& record) {
  Measure measure{"aids_used", static_cast<double>(record.aids_used), ""};
  std::string names;
  for (std::size_t i = 0; i < kAidCount; ++i) {
    if ((record.aids >> i & 1U) != 0) names += (names.empty() ? "" : ", ") + in_words(Aid(i));
  }
  if (!names.empty()) measure.finding = "Used: " + names + ".";
  return measure;
}

}  // namespace

std::string text_of(double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.1f", value);
  return text.data();
}

std::vector<Measure> thrift_measures(const Procedure& procedure,
                                     const OperationRecord& record,
                                     std::string pictures,
                                     std::string doses) {
  const auto looks = std::count_if(record.shots.begin(), record.shots.end(),
                                   [](const Shot& shot) { return shot.look != Look::LiveOn; });
  std::uint64_t dose = 0;
  for (const Shot& shot : record.shots) dose += dose_units_of(shot);
  return {{"shots", static_cast<double>(looks), std::move(pictures)},
          {"dose_cgy_cm2", dose_cgy_cm2(dose), std::move(doses)},
          {"time_s", static_cast<double>(record.ticks) * kTickSeconds, ""},
          {"undos", static_cast<double>(record.undos), ""},
          aids_used(record),
          steps_left_out(procedure, record),
          steps_out_of_order(procedure, record)};
}

}  // namespace carpus::procedure
