// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/chart/log_scale.hpp"

#include <algorithm>
#include <cmath>

#include "core/text_format.hpp"

namespace carpus::bench {
namespace {

/// The narrowest step of 1, 2, 5, 10 in decades: log10(2).
constexpr double kNarrowestStep = 0.30103;

}  // namespace

void ValueRange::include(double value) {
  if (!(value > 0)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

LogScale::LogScale(const ValueRange& range, double from, double to)
    : range_(range), from_(from), to_(to) {}

double LogScale::at(double value) const {
  return from_ + std::log(value / range_.low) / std::log(range_.high / range_.low) * (to_ - from_);
}

std::vector<double> LogScale::ticks(double spacing) const {
  const double decade = std::abs(to_ - from_) / std::log10(range_.high / range_.low);
  const bool is_fine = decade * kNarrowestStep >= spacing;
  const int step = std::max(1, static_cast<int>(std::ceil(spacing / decade)));
  const int first = static_cast<int>(std::floor(std::log10(range_.low)));
  const int last = static_cast<int>(std::ceil(std::log10(range_.high)));
  std::vector<double> values;
  for (int power = first; power <= last; ++power) {
    if (power % step != 0) continue;
    for (const double digit : {1.0, 2.0, 5.0}) {
      if (digit > 1 && !is_fine) break;
      const double value = digit * std::pow(10.0, power);
      if (value >= range_.low && value <= range_.high) values.push_back(value);
    }
  }
  return values;
}

std::string time_label(double seconds) {
  struct Unit {
    double seconds;
    const char* name;
  };
  constexpr double kRounding = 1 - 1e-9;  // 1e-6 may come as 9.99...e-7
  for (const Unit unit : {Unit{1, "s"}, Unit{1e-3, "ms"}, Unit{1e-6, "µs"}}) {
    if (seconds >= unit.seconds * kRounding)
      return format("%g %s", seconds / unit.seconds, unit.name);
  }
  return format("%g ns", seconds / 1e-9);
}

std::string count_label(double count) {
  std::string text = format("%.0f", count);
  if (text.size() < 5) return text;
  for (std::size_t end = text.size(); end > 3; end -= 3) text.insert(end - 3, 1, ' ');
  return text;
}

}  // namespace carpus::bench
