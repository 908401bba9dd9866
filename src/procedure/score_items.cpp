// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/score_items.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "procedure/shots.hpp"

namespace carpus::procedure {
namespace {

void grade_thrift(ScoreItem& item, bool is_acceptable, double value, double good, double fail) {
  grade_falling(item, value, good, fail);
  if (is_acceptable) return;
  item.points = 0.0;
  item.reason += " Earns points only with an acceptable fixation.";
}

}  // namespace

std::string text_of(double value, const char* format) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

double falling_points(double value, double good, double fail, double possible) {
  if (!(value > good)) return possible;
  if (!(value < fail)) return 0.0;
  return possible * (fail - value) / (fail - good);
}

void grade_falling(ScoreItem& item, double value, double good, double fail) {
  item.value = value;
  item.points = falling_points(value, good, fail, item.points_possible);
  item.grade = value <= good ? Grade::Good : (value > fail ? Grade::Fail : Grade::Acceptable);
}

ScoreItem make_item(const char* id, const char* label, const char* unit, double points_possible) {
  ScoreItem item;
  item.id = id;
  item.label = label;
  item.unit = unit;
  item.points_possible = points_possible;
  return item;
}

ScoreItem shots_item(const OperationRecord& record,
                     bool is_acceptable,
                     double points,
                     const std::string& taken) {
  ScoreItem item = make_item("shots", "Fluoroscopy shots", "1", points);
  item.target = "at most 40 good, over 90 fail";
  item.reason = "Counts only what is beyond need; fewer shots never earn more." + taken;
  const auto looks = std::count_if(record.shots.begin(), record.shots.end(),
                                   [](const Shot& shot) { return shot.look != Look::LiveOn; });
  grade_thrift(item, is_acceptable, static_cast<double>(looks), 40.0, 90.0);
  return item;
}

ScoreItem dose_item(const OperationRecord& record, bool is_acceptable, double points) {
  ScoreItem item = make_item("dose_cgy_cm2", "Dose-area product", "cGy cm2", points);
  item.target = "at most 20 cGy cm² good, over 45.6 cGy cm² fail";
  item.reason = "A whole conventional operation was measured at 45.6 cGy cm²; a shot counts 0.5.";
  std::uint64_t pulses = 0;
  bool has_live = false;
  for (const Shot& shot : record.shots) {
    pulses += shot.pulses;
    has_live = has_live || shot.look != Look::Single;
  }
  if (has_live) item.reason += " So do five seconds of live pictures.";
  grade_thrift(item, is_acceptable, dose_cgy_cm2(pulses), 20.0, 45.6);
  return item;
}

ScoreItem time_item(const OperationRecord& record, bool is_acceptable, double points) {
  ScoreItem item = make_item("time_s", "Time", "s", points);
  item.target = "at most 10 min good, over 30 min fail";
  item.reason =
      "Time separates experts from novices in most studies, but only beside a good result.";
  grade_thrift(item, is_acceptable, static_cast<double>(record.ticks) * kTickSeconds, 600.0,
               1800.0);
  return item;
}

ScoreItem undos_item(const OperationRecord& record,
                     bool has_begun,
                     const std::string& nothing_done,
                     double points) {
  ScoreItem item = make_item("undos", "Steps taken back", "1", points);
  item.target = "none good, over 2 fail";
  if (!has_begun) {
    item.reason = nothing_done;
    return item;
  }
  item.reason = "Patients have no undo.";
  grade_falling(item, record.undos, 0.0, 2.0);
  return item;
}

void sum_up(ScoreReport& report) {
  report.overall = 0.0;
  for (const ScoreItem& item : report.items) report.overall += item.points;
  report.overall = std::clamp(report.overall, 0.0, 100.0);
}

}  // namespace carpus::procedure
