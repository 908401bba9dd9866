// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What lines a joint and yields: a tip is stopped where the sheet lies, and sinks in until the
// tissue bears what the hand presses with. Laid where the bones are -> which of them each tip is
// over -> (tips move, stopped there) -> the sheets' step -> how far the tips have sunk in.
#include <algorithm>

#include "simulation/detail/intervals.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::Item;
using detail::kDiscSheet;
using detail::kNoPortal;
using detail::kNoSheet;
using detail::YieldingSheet;

namespace {

constexpr double kOverMm = 1.6;   // a tip so near to a particle, aside, lies over the sheet
constexpr double kAboveMm = 0.3;  // ... and touches it at most so far from it
constexpr double kDeepMm = 4.5;   // or has sunk in no deeper than this
// Deeper than the tissue has given and so much more no press brings a tip: it lies beside the
// sheet.
constexpr double kBesideMm = 0.9;
constexpr double kKeepsMm = 0.05;       // what has given so much is gone on with
constexpr double kSmoothMm = 1.5;       // what it lies on is the mean of so much of the sheet
constexpr double kAgainstCosine = 0.3;  // a wall that faces another way stops a tip as it is
constexpr double kGivesMmPerN = 0.02;   // a tick, for each newton that the hand presses more
constexpr double kComesBackMm = 0.02;   // a tick, once nothing presses
constexpr double kAheadMm = 0.05;       // so far the tissue gives before the tip follows

}  // namespace

/// Those between two bones go with both.
void World::State::lay_sheets(const Model& model) noexcept {
  for (std::size_t s = 0; s < model.sheets.size(); ++s) {
    const YieldingSheet& sheet = model.sheets[s];
    if (!sheet.net.is_between_two()) continue;
    const Pose<frame::Bone, frame::Bone> first_from_second =
        inverses[sheet.first] * poses[sheet.second];
    if (first_from_second == sheet_poses[s]) continue;
    sheet_poses[s] = first_from_second;
    sheets[s].lay(sheet.net, first_from_second);
    has_sheet_moved[s] = true;
  }
}

/// The middle of its foremost ball, frame Bone of the sheet's first body; radius up to the sheet.
yielding::Tip World::State::tip_on(const Model& model,
                                   const YieldingSheet& sheet,
                                   const Item& item,
                                   const Vec3& tip) const noexcept {
  const auto& shape = kind_of(model, item).shape;
  yielding::Tip made;
  made.at =
      (inverses[sheet.first] * Point<frame::Patient>{tip + item.shaft * shape.front_z_mm()}).v;
  made.radius_mm = shape.greatest_radius_mm() + sheet.half_thick_mm;
  return made;
}

/// What of a sheet a tip lies over: the mean of what is about the nearest place.
World::State::UnderTip World::State::under_tip(const Model& model,
                                               std::uint8_t s,
                                               const yielding::Tip& tip) const noexcept {
  const YieldingSheet& sheet = model.sheets[s];
  const yielding::NetState& state = sheets[s];
  const std::size_t near = state.nearest(sheet.net, tip.at);
  if (near >= sheet.net.size()) return {};
  const double least = squared_length(tip.at - state.rest(near));
  const Vec3 off = tip.at - state.rest(near);
  const double side = tip.is_behind ? -1.0 : 1.0;
  const double high = dot(off, sheet.net.normals()[near]) * side;
  if (least - high * high >= kOverMm * kOverMm || high <= -kDeepMm) return {};
  // From behind it is met at the far end of an interval, whose sides are something else.
  if (tip.is_behind && high > tip.radius_mm + kAboveMm) return {};
  UnderTip under;
  under.is_behind = tip.is_behind;
  double sum = 0.0;
  double held = 0.0;
  for (std::size_t i = 0; i < sheet.net.size(); ++i) {
    const double more = squared_length(tip.at - state.rest(i)) - least;
    if (more >= kSmoothMm * kSmoothMm || state.is_cut(i)) continue;
    const double weight = 1.0 - more / (kSmoothMm * kSmoothMm);
    under.at += state.rest(i) * weight;
    under.out += sheet.net.normals()[i] * (side * weight);
    if (sheet.net.is_held(i)) held += weight;
    sum += weight;
  }
  if (!(sum > 0.0)) return {};
  under.sheet = s;
  under.at = under.at / sum;
  under.out = normalized_or(under.out, sheet.net.normals()[near] * side);
  under.most_gives_mm = sheet.most_gives_mm * (1.0 - held / sum);
  return under;
}

/// Of several the one that is pressed most, or is nearest.
void World::State::find_sheets(const Model& model) noexcept {
  for (std::uint8_t h = 0; h < kHands; ++h) {
    under_tips[h] = {};
    const Item* item = in_hand(h);
    const std::uint8_t portal = scope_state.portal[h];
    if (item == nullptr || !enters_joints(model, *item) || portal == kNoPortal ||
        !scope_state.is_in_joint[h]) {
      continue;
    }
    const std::uint8_t joint = joint_of(model, portal);
    double least = 0.0;
    for (std::uint8_t s = 0; s < model.sheets.size(); ++s) {
      const YieldingSheet& sheet = model.sheets[s];
      const bool is_behind = detail::lies_behind(sheet, joint);
      if ((sheet.joint != joint && !is_behind) || sheet.net.size() == 0) continue;
      yielding::Tip tip = tip_on(model, sheet, *item, item->tip);
      tip.is_behind = is_behind;
      if (distance(tip.at, sheet.middle) > sheet.reach_mm + tip.radius_mm + kDeepMm) continue;
      const UnderTip under = under_tip(model, s, tip);
      if (under.sheet == kNoSheet) continue;
      const double high = dot(tip.at - under.at, under.out) - tip.radius_mm;
      const bool is_pressed = scope_state.gives_on[h] == s && scope_state.gives_mm[h] > kKeepsMm;
      if (!is_pressed && under_tips[h].sheet != kNoSheet && high >= least) continue;
      least = high;
      under_tips[h] = under;
      if (is_pressed) break;
    }
  }
}

/// Where a sheet stops a tip; in none where no sheet is under it. A wall that faces the same way
/// as the sheet is the sheet itself.
std::optional<World::State::Wall> World::State::sheet_at(const Model& model,
                                                         std::uint8_t hand,
                                                         const Vec3& tip_in_patient,
                                                         const Vec3& wall_outwards) const noexcept {
  const UnderTip& under = under_tips[hand];
  if (under.sheet == kNoSheet || scope_state.hooked[hand] != detail::kNothingHooked) {
    return std::nullopt;
  }
  const YieldingSheet& sheet = model.sheets[under.sheet];
  const yielding::Tip tip = tip_on(model, sheet, now.items[now.held[hand]], tip_in_patient);
  const Vec3 off = tip.at - under.at;
  const double high = dot(off, under.out);
  const double gives = scope_state.gives_mm[hand];
  if (squared_length(off) - high * high >= kOverMm * kOverMm ||
      high < tip.radius_mm - gives - kBesideMm) {
    return std::nullopt;
  }
  const Vec3 out = (poses[sheet.first] * Direction<frame::Bone>{under.out}).v;
  if (dot(wall_outwards, out) > -kAgainstCosine && squared_length(wall_outwards) > 0.5) {
    return std::nullopt;
  }
  return Wall{tip.radius_mm - gives - high, out};
}

/// How far the tissue has given where a tip is.
void World::State::sink_in(const Model& model,
                           std::uint8_t hand,
                           const yielding::Tip& tip) noexcept {
  double& gives = scope_state.gives_mm[hand];
  const UnderTip& under = under_tips[hand];
  if (under.sheet != scope_state.gives_on[hand]) {
    scope_state.gives_on[hand] = under.sheet;
    gives = 0.0;
  }
  if (!tip.is_there || tip.hooked != yielding::kMaxParticles) {
    gives = std::max(0.0, gives - kComesBackMm);
    return;
  }
  const std::uint8_t first = model.sheets[under.sheet].first;
  const Vec3 felt = (inverses[first] * Direction<frame::Patient>{scope_state.felt[hand]}).v;
  const double bears = dot(sheets[under.sheet].force_on(hand), under.out);
  const double sunk = tip.radius_mm - dot(tip.at - under.at, under.out);
  // Where bone has stopped the tip already, the tissue gives no further.
  const double most = std::min(under.most_gives_mm, std::max(0.0, sunk) + kAheadMm);
  const double wanted = gives + kGivesMmPerN * (dot(felt, under.out) - bears);
  gives = std::max(std::clamp(wanted, 0.0, most), std::min(gives, wanted) - kComesBackMm);
  gives = std::max(0.0, gives);
}

void World::State::yield_sheets(const Model& model) noexcept {
  std::array<std::array<yielding::Tip, kHands>, kMaxSheets> tips;
  for (std::uint8_t h = 0; h < kHands; ++h) {
    const UnderTip& under = under_tips[h];
    if (under.sheet == kNoSheet) continue;
    yielding::Tip& tip = tips[under.sheet][h];
    const Item* item = in_hand(h);
    if (item == nullptr) continue;
    tip = tip_on(model, model.sheets[under.sheet], *item, item->tip);
    tip.is_behind = under.is_behind;
    const double high = dot(tip.at - under.at, under.out);
    const std::uint8_t joint = model.sheets[under.sheet].joint;
    const double thick_mm = kind_of(model, *item).shape.greatest_radius_mm();
    const bool is_through = is_in_hole(model, joint, item->tip, thick_mm) ||
                            is_in_cut_disc(model, joint, item->tip, thick_mm);
    const double deepest_mm =
        is_through ? -kDeepMm : tip.radius_mm - scope_state.gives_mm[h] - kBesideMm;
    tip.is_there = high < tip.radius_mm + kAboveMm && high > deepest_mm;
  }
  hook_disc(model, tips[kDiscSheet]);
  for (std::size_t s = 0; s < model.sheets.size(); ++s) {
    const bool was_still = sheets[s].is_still();
    sheets[s].step(model.sheets[s].net, tips[s]);
    has_sheet_moved[s] = has_sheet_moved[s] || !was_still || !sheets[s].is_still();
  }
  for (std::uint8_t h = 0; h < kHands; ++h) {
    const std::uint8_t s = under_tips[h].sheet;
    sink_in(model, h, s == kNoSheet ? yielding::Tip{} : tips[s][h]);
  }
  let_go_of_disc(model);
}

void World::State::publish_sheets(const Model& model) noexcept {
  snapshot.sheet_count = static_cast<std::uint8_t>(model.sheets.size());
  for (std::size_t s = 0; s < model.sheets.size(); ++s) {
    if (!has_sheet_moved[s]) continue;
    has_sheet_moved[s] = false;
    const yielding::Net& net = model.sheets[s].net;
    SheetView& view = snapshot.sheets[s];
    view.count = static_cast<std::uint16_t>(net.size());
    view.is_still = sheets[s].is_still();
    for (std::size_t i = 0; i < net.size(); ++i) {
      const Vec3 off = sheets[s].at(i) - net.scanned()[i];
      view.off[i] = {static_cast<float>(off.x), static_cast<float>(off.y),
                     static_cast<float>(off.z)};
    }
  }
}

}  // namespace carpus::simulation
