// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/predicates.hpp"

#include <span>

#include "procedures/scaphoid_fixation/screws.hpp"
#include "procedures/scaphoid_fixation/views.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

using instruments::Instrument;
using instruments::InstrumentIndex;
using instruments::Work;
using procedure::HandFacts;
using procedure::LineFacts;
using procedure::Shot;

// Limits of what counts as done rightly [E].
constexpr double kRing = 0.978;            // cos 12 degrees
constexpr double kLongShare = 0.85;        // of the longest line
constexpr double kCommittedMm = 4.0;       // a wire so deep has its line
constexpr double kUnderCortexMm = 2.5;     // "just under the far cortex"
constexpr double kBeyondMm = 0.3;          // what is not told from touching it
constexpr double kMeasuredWithinMm = 1.5;  // three marks of the gauge
constexpr double kReamedLeastMm = 0.5;     // of bone before the drill; 2 are wanted [K, B1 step 8]
constexpr double kReamedMostMm = 4.0;
constexpr double kNextScrewMm = 2.6;    // to the next shorter screw of the tray's families
constexpr double kBuriedLeastMm = 1.0;  // 2 are wanted [K, B1 step 9]
constexpr double kBuriedMostMm = 4.0;
constexpr double kTipCoverMm = 0.5;
constexpr double kFlushMm = 1.0;        // a wire's near end, out of the bone …
constexpr double kFlushDeepMm = 3.0;    // … or in it, when it is drawn through [K, B1 step 5]
constexpr double kExtendedRad = 0.175;  // 10 degrees of flexion: the wrist is straight
constexpr double kHeldAtMm = 20.0;      // of a wire out of the bone, to work over it

constexpr unsigned kPaAndLateral =
    1U << static_cast<unsigned>(View::Pa) | 1U << static_cast<unsigned>(View::Lateral);

const Instrument* kind_of(InstrumentIndex index) noexcept {
  const auto all = instruments::catalogue();
  return index < all.size() ? &all[index] : nullptr;
}

bool lies_in_target(const LineFacts& line, Work work) noexcept {
  const Instrument* kind = kind_of(line.instrument);
  return line.in_target && kind != nullptr && kind->work == work;
}

/// Whether a line of that work in the target is so.
template <typename Condition>
bool any_line(const Situation& now, Work work, Condition&& condition) noexcept {
  for (const LineFacts& line : now.lines) {
    if (lies_in_target(line, work) && condition(line)) return true;
  }
  return false;
}

bool is_under_far_cortex(const LineFacts& line) noexcept {
  return line.depth_mm >= line.chord_mm - kUnderCortexMm &&
         line.depth_mm <= line.chord_mm + kBeyondMm;
}

unsigned views_in(std::span<const Shot> shots) noexcept {
  unsigned seen = 0;
  for (const Shot& shot : shots) {
    for (int i = 0; i < kViewCount; ++i) {
      if (shows(static_cast<View>(i), shot.rotation_deg, shot.tilt_deg)) seen |= 1U << i;
    }
  }
  return seen;
}

bool has_all(unsigned seen, unsigned wanted) noexcept { return (seen & wanted) == wanted; }

bool is_right_length(const Instrument& screw, double measured_mm) noexcept {
  const double longest = measured_mm - kMeasuredMinusScrewMm;
  return screw.length_mm <= longest && screw.length_mm >= longest - kNextScrewMm;
}

}  // namespace

bool is_surveyed(const Situation& now) noexcept {
  return now.judgement != procedure::Judgement::None && has_all(views_in(now.shots), kPaAndLateral);
}

bool is_displaced(const Situation& now) noexcept { return lies_apart(now.fracture); }

bool lies_apart(const procedure::FractureFacts& fracture) noexcept {
  return fracture.is_apart &&
         anatomy::lies_apart({fracture.gap_mm, fracture.step_mm, fracture.cosine_angle});
}

bool is_reduced(const Situation& now) noexcept {
  if (!now.fracture.is_apart) return is_surveyed(now);
  return !is_displaced(now) && has_all(views_in(now.recent_shots), kPaAndLateral);
}

bool is_ring_seen(const Situation& now) noexcept {
  for (const Shot& shot : now.shots) {
    if (shot.along_aim >= kRing) return true;
  }
  return false;
}

bool is_entry_right(const Situation& now) noexcept {
  return any_line(now, Work::Drill, [&](const LineFacts& line) {
    return line.from_aim_mm <= now.aim.entry_within_mm;
  });
}

bool is_line_long(const Situation& now) noexcept {
  return any_line(now, Work::Drill, [&](const LineFacts& line) {
    return line.depth_mm >= kCommittedMm && line.chord_mm >= kLongShare * now.aim.length_mm;
  });
}

bool is_driven(const Situation& now) noexcept {
  return any_line(now, Work::Drill, is_under_far_cortex);
}

bool is_flush(const Situation& now) noexcept {
  return any_line(now, Work::Drill, [](const LineFacts& line) {
    return line.near_end_out_mm <= kFlushMm && line.near_end_out_mm >= -kFlushDeepMm;
  });
}

bool is_seen_extended(const Situation& now) noexcept {
  unsigned seen = 0;
  for (const Shot& shot : now.recent_shots) {
    if (!shot.shows_wire || shot.wrist.flexion_rad > kExtendedRad) continue;
    seen |= views_in({&shot, 1});
  }
  return has_all(seen, kPaAndLateral);
}

bool is_driven_back(const Situation& now) noexcept {
  return any_line(now, Work::Drill, [](const LineFacts& line) {
    return line.was_flush && line.near_end_out_mm >= kHeldAtMm && is_under_far_cortex(line);
  });
}

bool is_checked(const Situation& now) noexcept {
  return is_driven(now) && has_all(views_of(now.recent_shots, false), kViewsOfWire);
}

bool is_measured(const Situation& now) noexcept {
  return any_line(now, Work::Drill, [&](const LineFacts& line) {
    const double off = now.gauge_reading_mm - line.chord_mm;
    return off >= -kMeasuredWithinMm && off <= kMeasuredWithinMm;
  });
}

bool is_held_at_both_ends(const Situation& now) noexcept {
  return now.gauge_reading_mm >= 0.0 && any_line(now, Work::Drill, [](const LineFacts& line) {
           return line.far_end_is_out && line.near_end_out_mm >= kHeldAtMm;
         });
}

bool is_reamed(const Situation& now) noexcept {
  return any_line(now, Work::Drill, [&](const LineFacts& line) {
    const double left = line.chord_mm - now.reamed_mm;
    return now.reamed_mm > 0.0 && left >= kReamedLeastMm && left <= kReamedMostMm;
  });
}

bool is_screw_chosen(const Situation& now) noexcept {
  if (now.gauge_reading_mm < 0.0) return false;
  for (const HandFacts& hand : now.hands) {
    const Instrument* kind = kind_of(hand.instrument);
    if (kind != nullptr && kind->work == Work::Thread &&
        is_right_length(*kind, now.gauge_reading_mm)) {
      return true;
    }
  }
  return any_line(now, Work::Thread, [&](const LineFacts& line) {
    return is_right_length(*kind_of(line.instrument), now.gauge_reading_mm);
  });
}

bool is_screw_seated(const Situation& now) noexcept {
  return any_line(now, Work::Thread, [](const LineFacts& line) {
    return line.buried_mm >= kBuriedLeastMm && line.buried_mm <= kBuriedMostMm &&
           line.depth_mm <= line.chord_mm - kTipCoverMm;
  });
}

bool is_wire_out(const Situation& now) noexcept {
  const auto is_there = [](const LineFacts&) { return true; };
  return any_line(now, Work::Thread, is_there) && !any_line(now, Work::Drill, is_there);
}

bool is_verified(const Situation& now) noexcept {
  return is_screw_seated(now) && has_all(views_of(now.recent_shots, true), kViewsOfScrew);
}

bool has_no_line(const Situation& now) noexcept {
  for (const LineFacts& line : now.lines) {
    if (lies_in_target(line, Work::Drill) || lies_in_target(line, Work::Thread)) return false;
  }
  return true;
}

}  // namespace carpus::procedures::scaphoid_fixation
