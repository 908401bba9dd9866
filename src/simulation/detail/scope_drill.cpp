// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/scope_drill.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace carpus::simulation::detail {
namespace {

using procedure::ScopeDrill;

constexpr double kFromPlaceMm = 2.0;        // farther the scope looks from another place
constexpr std::uint32_t kBegunTicks = 500;  // so long kept, it counts as lost when it is lost
constexpr std::uint32_t kForgivenTicks = 250;
constexpr double kStepMm = 1.5;           // along the line, that may be left out
constexpr std::uint32_t kOffTicks = 500;  // so long off the line it is lost
constexpr double kBegunMm = 3.0;          // of the line: less was no beginning
constexpr double kEndMm = 0.5;            // before the line's end

double turned_by(double from_deg, double to_deg) noexcept {
  double by = to_deg - from_deg;
  if (by > 180.0) by -= 360.0;
  if (by < -180.0) by += 360.0;
  return std::abs(by);
}

void end_hold(DrillState& state) noexcept {
  if (state.hold_ticks >= kBegunTicks) ++state.done.hold_breaks;
  state.hold_ticks = state.off_hold_ticks = 0;
}

void watch_hold(DrillState& state, const ScopeDrill& drill, const DrillLook& look) noexcept {
  if (state.done.held >= drill.hold.size()) return;
  const bool is_kept =
      look.has_in_middle && look.is_level &&
      (state.hold_ticks == 0 || distance(look.tip, state.held_from) <= drill.still_mm);
  if (!is_kept) {
    // A tremor's moment, or a line of sight that grazes bone, is forgiven and does not count.
    if (state.hold_ticks > 0 && ++state.off_hold_ticks >= kForgivenTicks) end_hold(state);
    return;
  }
  state.off_hold_ticks = 0;
  if (state.hold_ticks == 0) state.held_from = look.tip;
  if (++state.hold_ticks * kTickSeconds < drill.hold_s) return;
  state.hold_ticks = 0;
  ++state.done.held;
}

void watch_round(DrillState& state, const ScopeDrill& drill, const DrillLook& look) noexcept {
  if (state.done.is_round_done) return;
  if (distance(look.tip, state.round_from) > kFromPlaceMm) {
    state.round_from = look.tip;
    state.round_bits = 0;
    state.round_turn_deg = 0.0;
    state.last_turn_deg = look.shaft_turn_deg;
  }
  state.round_turn_deg += turned_by(state.last_turn_deg, look.shaft_turn_deg);
  state.last_turn_deg = look.shaft_turn_deg;
  state.round_bits |= look.places_in_view;
  const auto count = static_cast<std::uint8_t>(std::popcount(state.round_bits));
  state.done.round_most = std::max(state.done.round_most, count);
  state.done.is_round_done =
      count >= drill.round_places && state.round_turn_deg >= drill.round_turn_deg;
}

void watch_touch(DrillState& state,
                 const ScopeDrill& drill,
                 const DrillGround& ground,
                 const DrillProbe& probe) noexcept {
  std::uint8_t& touched = state.done.touched;
  if (touched >= drill.touch.size()) return;
  // Of two that are near the one that is asked for.
  std::uint8_t place = kNothingTouched;
  if (probe.touches && state.is_probe_seen) {
    for (std::size_t i = 0; i < drill.touch.size(); ++i) {
      const bool is_asked = drill.touch[i] == drill.touch[touched];
      if (distance(ground.touch[i], probe.tip) > drill.touch_mm) continue;
      if (place == kNothingTouched || is_asked) place = drill.touch[i];
    }
  }
  const bool is_new = place != kNothingTouched && place != state.touches;
  state.touches = place;
  if (!is_new) return;
  if (place == drill.touch[touched]) {
    ++touched;
    state.done.are_touches_done = touched >= drill.touch.size();
  } else if (touched > 0 && place != drill.touch[touched - 1U]) {
    ++state.done.wrong_touches;
  }
}

struct OnLine {
  double at_mm = 0;
  double aside_mm = 0;
};

OnLine nearest_on_line(const ScopeDrill& drill, const DrillPlaces& line, const Vec3& at) noexcept {
  OnLine best{0, distance(line[0], at)};
  double before = 0;
  for (std::size_t i = 0; i + 1 < drill.line.size(); ++i) {
    const Vec3 along = line[i + 1] - line[i];
    const double whole = length(along);
    if (!(whole > 0)) continue;
    const double s = std::clamp(dot(at - line[i], along) / whole, 0.0, whole);
    const double aside = distance(line[i] + along * (s / whole), at);
    if (aside < best.aside_mm) best = {before + s, aside};
    before += whole;
  }
  return best;
}

void watch_line(DrillState& state,
                const ScopeDrill& drill,
                const DrillPlaces& line,
                const DrillProbe& probe) noexcept {
  // After the touches, so that going from one to the next is not taken for it.
  if (state.done.is_line_done || !state.done.are_touches_done) return;
  const double whole = length_of_line(drill, line);
  const OnLine on = nearest_on_line(drill, line, probe.tip);
  const bool is_on =
      probe.touches && on.aside_mm <= drill.line_mm && on.at_mm - state.line_at_mm <= kStepMm;
  if (is_on) {
    state.off_line_ticks = 0;
    // Resting unseen loses nothing and gains nothing.
    if (!state.is_probe_seen) return;
    state.line_at_mm = std::max(state.line_at_mm, on.at_mm);
    state.done.is_line_done = state.line_at_mm >= whole - kEndMm;
    state.line_share = state.done.is_line_done ? 1.0 : state.line_at_mm / whole;
    state.done.line_share = std::max(state.done.line_share, state.line_share);
    return;
  }
  if (state.line_at_mm <= 0.0 || ++state.off_line_ticks < kOffTicks) return;
  if (state.line_at_mm >= kBegunMm) ++state.done.line_breaks;
  state.line_at_mm = state.line_share = 0.0;
  state.off_line_ticks = 0;
}

}  // namespace

double length_of_line(const ScopeDrill& drill, const DrillPlaces& line) noexcept {
  double whole = 0;
  for (std::size_t i = 0; i + 1 < drill.line.size(); ++i) whole += distance(line[i], line[i + 1]);
  return whole;
}

void watch_look(DrillState& state, const ScopeDrill& drill, const DrillLook& look) noexcept {
  watch_hold(state, drill, look);
  watch_round(state, drill, look);
}

void lose_look(DrillState& state) noexcept {
  end_hold(state);
  state.round_bits = 0;
  state.round_turn_deg = 0.0;
  state.is_probe_seen = false;
}

void watch_probe(DrillState& state,
                 const ScopeDrill& drill,
                 const DrillGround& ground,
                 const DrillProbe& probe) noexcept {
  if (state.was_probing) {
    const double went = distance(state.last_probe, probe.tip);
    (state.is_probe_seen ? state.done.seen_path_mm : state.done.unseen_path_mm) += went;
  }
  state.was_probing = true;
  state.last_probe = probe.tip;
  watch_touch(state, drill, ground, probe);
  watch_line(state, drill, ground.line, probe);
}

void lose_probe(DrillState& state) noexcept {
  state.was_probing = false;
  state.touches = kNothingTouched;
  state.is_probe_seen = false;
}

bool is_possible(const DrillState& state, const ScopeDrill& drill) noexcept {
  const procedure::DrillFacts& done = state.done;
  return done.held <= drill.hold.size() && done.touched <= drill.touch.size() &&
         done.line_share >= 0.0 && done.line_share <= 1.0 && done.seen_path_mm >= 0.0 &&
         done.unseen_path_mm >= 0.0 && state.line_at_mm >= 0.0 && state.line_share >= 0.0 &&
         state.line_share <= 1.0 && state.round_turn_deg >= 0.0;
}

}  // namespace carpus::simulation::detail
