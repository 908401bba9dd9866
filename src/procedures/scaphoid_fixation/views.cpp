// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/views.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "procedure/shots.hpp"
#include "procedure/thrift_measures.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

constexpr double kProximalTiltDeg = 20.0;  // the skyline view is a 30 degree one [skyline2021]

}  // namespace

std::string in_words(View view) {
  static constexpr std::array<std::string_view, kViewCount> kWords{
      "PA", "lateral", "45° pronated oblique", "proximal pole"};
  return std::string(kWords.at(static_cast<std::size_t>(view)));
}

bool shows(View view, double rotation_deg, double tilt_deg) noexcept {
  using procedure::is_near_angle;
  const double rotation = procedure::folded_rotation_deg(rotation_deg);
  const bool is_level = is_near_angle(tilt_deg, 0);
  switch (view) {
    case View::Pa:
      return is_level && is_near_angle(rotation, 0);
    case View::Lateral:
      return is_level && (is_near_angle(rotation, 90) || is_near_angle(rotation, -90));
    case View::PronatedOblique:
      return is_level && is_near_angle(rotation, 45);
    case View::ProximalPole:
      return (tilt_deg >= kProximalTiltDeg || tilt_deg <= -kProximalTiltDeg) &&
             is_near_angle(rotation, 0);
  }
  return false;
}

unsigned views_of(std::span<const procedure::Shot> shots, bool of_screw) noexcept {
  unsigned seen = 0;
  for (const procedure::Shot& shot : shots) {
    if (of_screw ? !shot.shows_screw : (!shot.shows_wire || shot.shows_screw)) continue;
    for (int i = 0; i < kViewCount; ++i) {
      if (shows(static_cast<View>(i), shot.rotation_deg, shot.tilt_deg)) seen |= 1U << i;
    }
  }
  return seen;
}

std::string views_taken(const procedure::OperationRecord& record) {
  std::string words;
  for (int i = 0; i < kViewCount; ++i) {
    const auto view = static_cast<View>(i);
    const auto count = std::count_if(
        record.shots.begin(), record.shots.end(),
        [&](const procedure::Shot& shot) { return shows(view, shot.rotation_deg, shot.tilt_deg); });
    words += i == 0 ? "Taken: " : ", ";
    words += in_words(view) + " " + std::to_string(count);
  }
  return words + ".";
}

std::string doses_by_view(const procedure::OperationRecord& record) {
  std::array<std::uint64_t, kViewCount + 1> units{};
  for (const procedure::Shot& shot : record.shots) {
    int view = 0;
    while (view < kViewCount && !shows(static_cast<View>(view), shot.rotation_deg, shot.tilt_deg)) {
      ++view;
    }
    units.at(static_cast<std::size_t>(view)) += procedure::dose_units_of(shot);
  }
  std::string words;
  for (int i = 0; i <= kViewCount; ++i) {
    const std::uint64_t dose = units.at(static_cast<std::size_t>(i));
    if (dose == 0) continue;
    words += words.empty() ? "" : ", ";
    words += i == kViewCount ? "other views" : in_words(static_cast<View>(i));
    words += " " + procedure::text_of(procedure::dose_cgy_cm2(dose));
  }
  return words.empty() ? words : words + " cGy cm².";
}

}  // namespace carpus::procedures::scaphoid_fixation
