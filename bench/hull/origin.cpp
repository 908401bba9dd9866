// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/origin.hpp"

#include <cmath>

#include "core/text_format.hpp"

namespace carpus::bench {
namespace {

constexpr double kCountTolerance = 0.05;

}  // namespace

bool has_thesis_count(const Origin& origin, std::size_t points) {
  const auto wanted = static_cast<double>(origin.thesis_points);
  return std::abs(static_cast<double>(points) - wanted) <= kCountTolerance * wanted;
}

std::string note_on(const Origin& origin, std::size_t points) {
  std::string note = origin.is_stand_in ? origin.source + " stands for it" : "";
  if (origin.thesis_points != 0 && !has_thesis_count(origin, points)) {
    note += format("%s%zu vertices for the thesis's %zu", note.empty() ? "" : ", ", points,
                   origin.thesis_points);
  }
  return note;
}

}  // namespace carpus::bench
