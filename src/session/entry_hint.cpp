// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/entry_hint.hpp"

#include <cmath>

#include "cases/direction_words.hpp"
#include "core/units.hpp"

namespace carpus::session {

namespace {

constexpr double kNearMm = 2.0;
constexpr double kNearDeg = 5.0;

std::string whole(double value) { return std::to_string(std::lround(value)); }

}  // namespace

std::string entry_hint(const cases::CaseData& data,
                       const procedure::Aim& aim,
                       const simulation::Snapshot& now,
                       const simulation::ItemView& item) {
  // In the bone as scanned: there the case's directions are those of the hand.
  const auto bone_from_patient = now.patient_from_bone[aim.body].inverse();
  const Vec3 entry = (bone_from_patient * Point<frame::Patient>{item.entry_in_patient}).v;
  const Vec3 line = (bone_from_patient * Direction<frame::Patient>{-item.shaft_in_patient}).v;
  const Vec3 to_entry = aim.entry - entry;
  const Vec3 across = to_entry - aim.direction * dot(to_entry, aim.direction);
  const double angle_deg = degrees_from_radians(
      std::atan2(length(cross(line, aim.direction)), dot(line, aim.direction)));
  std::string hint;
  if (length(across) > kNearMm) {
    hint = "Enter " + whole(length(across)) + " mm more " +
           cases::direction_in_words(data, across) + ".";
  }
  if (angle_deg > kNearDeg) {
    if (!hint.empty()) hint += " ";
    hint += "Aim " + whole(angle_deg) + "° more " +
            cases::direction_in_words(data, aim.direction - line) + ".";
  }
  return hint.empty() ? "It lies where it should." : hint;
}

}  // namespace carpus::session
