// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/grading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/error.hpp"

namespace carpus::procedure {
namespace {

const Measure& measure_of(std::span<const Measure> measures, std::string_view id) {
  for (const Measure& measure : measures) {
    if (measure.id == id) return measure;
  }
  std::string known;
  for (const Measure& measure : measures) {
    known += (known.empty() ? "" : ", ") + std::string(measure.id);
  }
  throw InvalidInput("score: nothing is measured as '" + std::string(id) +
                     "'; there are: " + known);
}

ScoreItem graded(const ScoreRule& rule, const Measure& measure) {
  ScoreItem item;
  item.id = rule.id;
  item.label = rule.label;
  item.unit = rule.unit;
  item.target = target_text(rule);
  item.points_possible = rule.weight;
  item.value = measure.value;
  item.reason = rule.why;
  item.mark = rule.mark;
  if (!measure.finding.empty()) item.reason += " " + measure.finding;
  if (!measure.value) return item;
  item.points = rule.weight * earned_share(rule, *measure.value);
  item.grade = rule.good.contain(*measure.value)    ? Grade::Good
               : !rule.fail.contain(*measure.value) ? Grade::Fail
                                                    : Grade::Acceptable;
  return item;
}

std::string number_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

std::string unit_text(std::string_view unit) {
  if (unit == "deg") return "°";
  if (unit == "1") return "";
  if (unit == "mm2") return " mm²";
  if (unit == "cGy cm2") return " cGy cm²";
  return " " + std::string(unit);
}

constexpr double kMinuteS = 60.0;

std::string quantity_text(double value, std::string_view unit) {
  if (unit == "s" && value >= 2 * kMinuteS) return number_text(value / kMinuteS) + " min";
  return number_text(value) + unit_text(unit);
}

std::string good_text(const Limits& good, std::string_view unit) {
  if (!std::isfinite(good.low)) return "at most " + quantity_text(good.high, unit);
  if (!std::isfinite(good.high)) return "at least " + quantity_text(good.low, unit);
  if (good.low == good.high) return quantity_text(good.low, unit);
  return number_text(good.low) + " to " + quantity_text(good.high, unit);
}

/// Of what is counted, where none is what is wanted: "at most 0 good, over 0 fails" says nobody.
bool is_count_of_none(const ScoreRule& rule) {
  return rule.unit == "1" && !std::isfinite(rule.good.low) && rule.good.high == 0.0;
}

}  // namespace

double earned_share(const ScoreRule& rule, double value) {
  if (rule.good.contain(value)) return 1.0;
  if (!rule.fail.contain(value)) return 0.0;
  const bool is_low = value < rule.good.low;
  const double good = is_low ? rule.good.low : rule.good.high;
  const double fail = is_low ? rule.fail.low : rule.fail.high;
  if (!std::isfinite(fail)) return 1.0;                  // nothing fails on this side
  return std::max(0.0, (value - fail) / (good - fail));  // never -0
}

void grade(ScoreReport& report, const ScoreRules& rules, std::span<const Measure> measures) {
  report.must_haves.clear();
  for (const SafetyRule& rule : rules.safety) {
    const Measure& measure = measure_of(measures, rule.measure);
    if (!measure.applies) continue;
    report.must_haves.push_back({rule.id, rule.label,
                                 measure.value && rule.within.contain(*measure.value),
                                 rule.opens_truth, !measure.value});
  }
  report.is_fixation_acceptable = std::all_of(report.must_haves.begin(), report.must_haves.end(),
                                              [](const MustHave& must) { return must.fulfilled; });
  report.items.clear();
  double earned = 0.0;
  double possible = 0.0;
  for (const ScoreRule& rule : rules.items) {
    const Measure& measure = measure_of(measures, rule.id);
    if (!measure.applies) continue;
    ScoreItem item = graded(rule, measure);
    if (!report.is_fixation_acceptable) item.points = 0.0;
    earned += item.points;
    possible += item.points_possible;
    report.items.push_back(std::move(item));
  }
  // What does not apply leaves its weight to the others.
  if (possible > 0.0) {
    for (ScoreItem& item : report.items) {
      item.points *= 100.0 / possible;
      item.points_possible *= 100.0 / possible;
    }
  }
  report.overall = possible > 0.0 ? std::clamp(100.0 * earned / possible, 0.0, 100.0) : 0.0;
}

std::string target_text(const ScoreRule& rule) {
  if (is_count_of_none(rule)) {
    if (rule.fail.high == 0.0) return "none; a single one fails";
    const std::string none = "none is good";
    return std::isfinite(rule.fail.high) ? none + ", over " + number_text(rule.fail.high) + " fails"
                                         : none;
  }
  std::string text = good_text(rule.good, rule.unit) + " good";
  const bool has_low = std::isfinite(rule.fail.low);
  const bool has_high = std::isfinite(rule.fail.high);
  if (!has_low && !has_high) return text;
  text += has_low && has_high ? "; " : ", ";
  if (has_low) text += "under " + quantity_text(rule.fail.low, rule.unit);
  if (has_low && has_high) text += " or ";
  if (has_high) text += "over " + quantity_text(rule.fail.high, rule.unit);
  return text + " fails";
}

}  // namespace carpus::procedure
