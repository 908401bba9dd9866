// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A logarithmic axis: where values lie on the page, and which of them are labelled.
#pragma once

#include <string>
#include <vector>

namespace carpus::bench {

/// What is to be shown; empty until something positive is included.
struct ValueRange {
  double low = 1e300;
  double high = 0;
  void include(double value);
  [[nodiscard]] bool is_empty() const { return high < low; }
  /// Wider by this factor on either side, so that no mark lies on the frame.
  [[nodiscard]] ValueRange widened(double factor) const { return {low / factor, high * factor}; }
};

class LogScale {
 public:
  /// The range's ends lie at `from` and `to` on the page; `to` may be the smaller (upward axes).
  LogScale(const ValueRange& range, double from, double to);
  [[nodiscard]] double at(double value) const;
  /// Round values: 1, 2 and 5 times powers of ten where they are `spacing` apart on the page, or
  /// powers alone, or only so many of these.
  [[nodiscard]] std::vector<double> ticks(double spacing) const;

 private:
  ValueRange range_;
  double from_;
  double to_;
};

/// "100 ns", "5 µs", "1 ms", "20 s".
[[nodiscard]] std::string time_label(double seconds);
/// "200", "10 000".
[[nodiscard]] std::string count_label(double count);

}  // namespace carpus::bench
