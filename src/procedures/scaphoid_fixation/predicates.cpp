// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/predicates.hpp"

#include "procedure/shots.hpp"
#include "procedures/scaphoid_fixation/views.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

using instruments::InstrumentIndex;
using instruments::Work;
using procedure::HandFacts;
using procedure::LineFacts;
using procedure::Shot;

constexpr double kDoneShare = 0.6;  // of the line's length inside the scaphoid [E]

Work work_of(InstrumentIndex index) noexcept {
  const auto all = instruments::catalogue();
  return index < all.size() ? all[index].work : Work::None;
}

bool lies_in_target(const LineFacts& line, Work work) noexcept {
  return line.in_target && work_of(line.instrument) == work;
}

/// Whether the shots from `first` on hold two different views, and the oblique if needed.
bool are_views_enough(const Situation& now, std::size_t first, bool needs_oblique) noexcept {
  bool has_two = false;
  bool has_oblique = !needs_oblique;
  for (std::size_t i = first; i < now.shots.size(); ++i) {
    const Shot& shot = now.shots[i];
    has_two = has_two || procedure::are_different_views(shot, now.shots[first]);
    has_oblique = has_oblique || shows(View::PronatedOblique, shot.rotation_deg, shot.tilt_deg);
  }
  return has_two && has_oblique;
}

}  // namespace

bool is_surveyed(const Situation& now) noexcept { return are_views_enough(now, 0, false); }

bool wire_touches_target(const Situation& now) noexcept {
  for (const HandFacts& hand : now.hands) {
    if (hand.touches_target && work_of(hand.instrument) == Work::Drill) return true;
  }
  return false;
}

bool is_wire_in_target(const Situation& now) noexcept {
  for (const LineFacts& line : now.lines) {
    if (lies_in_target(line, Work::Drill)) return true;
  }
  return false;
}

bool is_driven(const Situation& now) noexcept {
  for (const LineFacts& line : now.lines) {
    if (lies_in_target(line, Work::Drill) && line.depth_mm >= kDoneShare * line.chord_mm) {
      return true;
    }
  }
  return false;
}

bool is_checked(const Situation& now, std::size_t drive) noexcept {
  return procedure::is_completed(now.completed_steps, drive) &&
         are_views_enough(now, now.shots_at_completion[drive], true);
}

bool is_measured(const Situation& now) noexcept {
  return now.gauge_reading_mm >= 0.0 && is_wire_in_target(now);
}

bool is_reamed(const Situation& now) noexcept {
  for (const LineFacts& line : now.lines) {
    if (lies_in_target(line, Work::Drill) && now.reamed_mm > 0.0 &&
        now.reamed_mm >= kDoneShare * line.chord_mm) {
      return true;
    }
  }
  return false;
}

bool is_screw_chosen(const Situation& now) noexcept {
  for (const HandFacts& hand : now.hands) {
    if (work_of(hand.instrument) == Work::Thread) return true;
  }
  for (const LineFacts& line : now.lines) {
    if (lies_in_target(line, Work::Thread)) return true;
  }
  return false;
}

bool is_screw_seated(const Situation& now) noexcept {
  for (const LineFacts& line : now.lines) {
    if (lies_in_target(line, Work::Thread) && line.buried_mm >= 0.0) return true;
  }
  return false;
}

bool is_verified(const Situation& now, std::size_t insert) noexcept {
  return now.is_finishing && is_screw_seated(now) && !now.shots.empty() &&
         procedure::is_completed(now.shots[now.shots.size() - 1].completed_steps, insert);
}

bool has_no_line(const Situation& now) noexcept {
  for (const LineFacts& line : now.lines) {
    if (lies_in_target(line, Work::Drill) || lies_in_target(line, Work::Thread)) return false;
  }
  return true;
}

}  // namespace carpus::procedures::scaphoid_fixation
