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
          steps_left_out(procedure, record)};
}

}  // namespace carpus::procedure
