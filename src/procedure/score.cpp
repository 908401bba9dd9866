// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/score.hpp"

#include <array>
#include <cstddef>
#include <utility>

namespace carpus::procedure {

std::string_view name_of(Grade grade) noexcept {
  static constexpr std::array<std::string_view, 4> kNames{"good", "acceptable", "fail",
                                                          "not_measured"};
  const auto index = static_cast<std::size_t>(grade);
  return index < kNames.size() ? kNames[index] : std::string_view{"unknown"};
}

ScoreReport locked_where_void(ScoreReport report) {
  std::vector<MustHave> missing;
  for (const MustHave& must : report.must_haves) {
    if (must.opens_truth && !must.fulfilled) missing.push_back(must);
  }
  if (missing.empty()) return report;
  ScoreReport locked;
  locked.must_haves = std::move(missing);
  locked.is_void = true;
  locked.declined_for = std::move(report.declined_for);
  return locked;
}

}  // namespace carpus::procedure
