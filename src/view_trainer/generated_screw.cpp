// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// In or out is drawn once a seed, so that both come as often in narrow bones; then where and how
// far, and lines and screws until one does it. What no line of many does is drawn anew.
#include "view_trainer/generated_screw.hpp"

#include <cmath>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "core/rng.hpp"

namespace carpus::view_trainer {
namespace {

using instruments::InstrumentIndex;

constexpr double kSpreadMm = 2.0;

struct Wanted {
  Region region = Region::Distal;
  bool is_out = false;
  /// Of a screw that is out how far it stands out; of one that is in how much bone is before the
  /// end that is nearest to its pole, along the screw, negative.
  double depth_mm = 0.0;
};

Wanted draw_wanted(Rng& rng, bool is_out) {
  Wanted wanted;
  wanted.is_out = is_out;
  wanted.region = static_cast<Region>(rng.below(wanted.is_out ? 3 : 2));
  wanted.depth_mm = wanted.is_out ? rng.uniform(kOutMm + 0.02, kFarthestOutMm)
                                  : -rng.uniform(0.0, kBestCoveredMm);
  return wanted;
}

/// Even in a disc across a direction.
Vec3 draw_offset(Rng& rng, const Vec3& direction) {
  const Vec3 a = any_perpendicular(direction);
  const Vec3 b = cross(direction, a);
  while (true) {
    const double x = rng.uniform(-1, 1);
    const double y = rng.uniform(-1, 1);
    if (x * x + y * y <= 1) return a * (x * kSpreadMm) + b * (y * kSpreadMm);
  }
}

/// A screw of the catalogue between two lengths; nothing where there is none.
std::optional<InstrumentIndex> draw_screw(Rng& rng, double shortest_mm, double longest_mm) {
  std::vector<InstrumentIndex> fitting;
  const auto all = instruments::catalogue();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool fits = all[i].work == instruments::Work::Thread && all[i].length_mm >= shortest_mm &&
                      all[i].length_mm <= longest_mm;
    if (fits) fitting.push_back(static_cast<InstrumentIndex>(i));
  }
  if (fitting.empty()) return std::nullopt;
  return fitting[rng.below(fitting.size())];
}

/// One attempt; nothing where this line and this screw cannot be brought there.
std::optional<GeneratedScrew> attempt(const ScaphoidSurface& scaphoid,
                                      const Wanted& wanted,
                                      Rng& rng) {
  const cases::ScaphoidLandmarks& marks = scaphoid.data().scaphoid;
  const double share = rng.uniform();
  const auto between = [&](const Vec3& central, const Vec3& longest) {
    return central + (longest - central) * share;
  };
  const Vec3 axis_start = between(marks.central_axis.proximal, marks.longest_line.proximal);
  const Vec3 axis_end = between(marks.central_axis.distal, marks.longest_line.distal);
  const Vec3 along = normalized_or(axis_end - axis_start, {0, 0, 1});
  const Vec3 proximal = axis_start + draw_offset(rng, along);
  const Vec3 distal = axis_end + draw_offset(rng, along);
  const Vec3 line = normalized_or(distal - proximal, along);
  const auto chord = scaphoid.solid().chord_through((proximal + distal) * 0.5, line);
  const bool tip_is_distal = rng.below(2) == 0;
  const Vec3 aside = normalized_or(draw_offset(rng, line), any_perpendicular(line));
  if (!chord) return std::nullopt;
  const double room = chord->leave_mm - chord->enter_mm;
  const bool is_side = wanted.region == Region::Side;
  const auto screw = draw_screw(rng, 0.4 * room, is_side ? 0.75 * room : room - 2.0);
  if (!screw) return std::nullopt;
  const double length = instruments::catalogue()[*screw].length_mm;
  const Vec3 middle = (proximal + distal) * 0.5;
  // Where its distal end is along the line; a side's screw lies anywhere in the middle.
  double end = 0;
  if (wanted.region == Region::Distal) end = chord->leave_mm + wanted.depth_mm;
  if (wanted.region == Region::Proximal) end = chord->enter_mm - wanted.depth_mm + length;
  if (is_side) end = chord->enter_mm + (room - length) * rng.uniform(0.3, 0.7) + length;
  double shift = 0;  // aside
  GeneratedScrew made;
  constexpr int kCorrections = 4;
  for (int i = 0; i < kCorrections; ++i) {
    const Vec3 distal_end = middle + line * end + aside * shift;
    made.placed = {*screw, tip_is_distal ? distal_end : distal_end - line * length,
                   tip_is_distal ? -line : line};
    made.truth = scaphoid.protrusion_of(made.placed);
    if (!wanted.is_out) break;  // where it is put it is, or it is not taken
    const double missing = wanted.depth_mm - made.truth.depth_mm;
    constexpr double kNearEnoughMm = 0.1;
    if (made.truth.region == wanted.region && std::abs(missing) < kNearEnoughMm) break;
    if (i + 1 == kCorrections || std::abs(missing) > 6.0) return std::nullopt;
    if (wanted.region == Region::Distal) end += missing;
    if (wanted.region == Region::Proximal) end -= missing;
    if (is_side) shift += missing;
  }
  const bool is_right_side = wanted.is_out ? made.is_out() : made.truth.depth_mm <= 0;
  return is_right_side ? std::optional(made) : std::nullopt;
}

}  // namespace

GeneratedScrew generate_screw(const ScaphoidSurface& scaphoid, std::uint64_t seed) {
  Rng rng(seed);
  constexpr int kDraws = 12;
  constexpr int kAttempts = 20;
  const bool is_out = rng.below(2) == 0;
  // In an angulated bone there may be no line on which a screw is in.
  for (const bool side : {is_out, !is_out}) {
    for (int draw = 0; draw < kDraws; ++draw) {
      const Wanted wanted = draw_wanted(rng, side);
      for (int i = 0; i < kAttempts; ++i) {
        if (const auto made = attempt(scaphoid, wanted, rng)) return *made;
      }
    }
  }
  throw InvalidInput("view trainer: no screw of the catalogue fits this scaphoid");
}

}  // namespace carpus::view_trainer
