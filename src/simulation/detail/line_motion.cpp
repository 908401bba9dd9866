// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An instrument whose line is fixed in bone: a wire that drills its way, what reams or screws over
// it. Bone is removed along the way; what is left decides how hard it goes.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "contact/track_pull.hpp"
#include "instruments/drilling_resistance.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::absolute;
using detail::bit_of;
using detail::Item;
using detail::kNoHole;
using instruments::Work;

namespace {

/// What is about to be cut is read so far before a tool's own hole: half the width over which a
/// hole's edge is told (detail/tissue.cpp), the step that is cut at once, and the cut field's error
/// at a round front.
constexpr double kLookAheadMm = 0.3;
constexpr double kDeepestMm = 90.0;  // no wire goes further
constexpr double kScratchMm = 0.3;   // deeper, a bone counts as entered
constexpr double kFarExitMm = 0.3;   // beyond the far surface, past what is doubtful
constexpr double kNearBoneMm = 1.5;  // as far as a CT blurs a bone's density around it
constexpr double kSoftTissueHu = 40.0;
constexpr double kStiffLengthMm = 10.0;  // of a wire in bone, over which it gives way [E]
constexpr double kCutStepMm = 0.05;      // removed at once by a wire: a fifth of a voxel
constexpr double kWideCutStepMm = 0.25;  // by what is wide and slow: half a voxel
constexpr double kCutReachMm = 0.3;      // farther from a tool's side no bone feels it

/// Of the round front that a tool's hole ends in. A tapered tool makes a hole of its mean radius:
/// widening the whole way behind the tip with each advance would cost a tick ten times as much for
/// at most a tenth of a millimetre.
double hole_radius_mm(const instruments::Instrument& kind) noexcept {
  return 0.5 * (kind.cut_tip_radius_mm + kind.cut_tail_radius_mm);
}

/// The tip has come into this body.
void note_crossing(Item& item, std::uint8_t body) noexcept {
  for (std::size_t i = 0; i < item.crossing_count; ++i) {
    if (item.crossings[i].body == body) return;
  }
  if (item.crossing_count == detail::kMaxCrossings) return;
  item.crossings[item.crossing_count++] = {body, item.travel_mm};
}

}  // namespace

/// Density at a point of what is left: of the body that it lies in, or in whose blur.
double World::State::density_hu(const Model& model, const Vec3& point) const noexcept {
  double nearest = kNearBoneMm;
  std::uint8_t body = kNoBody;
  Vec3 in_body;
  for (std::uint8_t b = 0; b < snapshot.body_count; ++b) {
    const Vec3 local = (inverses[b] * Point<frame::Patient>{point}).v;
    if (!tissue.is_near(b, local)) continue;
    // Bone that was removed is still where that body's density is read.
    const double distance_mm = tissue.untouched_distance_mm(b, local);
    if (distance_mm >= nearest) continue;
    nearest = distance_mm;
    body = b;
    in_body = local;
  }
  return body == kNoBody ? kSoftTissueHu : tissue.density_hu(model.data.ct.view(), body, in_body);
}

/// Mean density before a tool's face [HU]: before its point, and where a wire has been along its
/// middle, before rings that share the rest of its face.
double World::State::density_ahead_hu(const Model& model, const Item& item) const noexcept {
  constexpr int kRings = 2;
  const instruments::Instrument& kind = kind_of(model, item);
  const detail::BodyPose& pose = poses[item.body];
  const auto density_at = [&](const Vec3& in_bone) {
    return density_hu(model, (pose * Point<frame::Bone>{in_bone}).v);
  };
  const Vec3& along = item.direction_in_bone;
  const Vec3 tip = item.origin_in_bone + along * item.travel_mm;
  const double radius = hole_radius_mm(kind);
  const double bore = kind.bore_radius_mm;
  if (!(bore > 0.0) || !(radius > bore)) return density_at(tip + along * kLookAheadMm);
  const Vec3 u = any_perpendicular(along);
  const Vec3 v = cross(along, u);
  const double reach = radius + kLookAheadMm;
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double squared =
        bore * bore + (radius * radius - bore * bore) * (i + 0.5) / kRings;  // of equal areas
    const double aside = std::sqrt(squared);
    const Vec3 middle = tip + along * (std::sqrt(reach * reach - squared) - radius);
    for (const Vec3& way : {u, v}) {
      sum += density_at(middle + way * aside) + density_at(middle - way * aside);
    }
  }
  return sum / (4 * kRings);
}

void World::State::engage(const Model& model, std::uint8_t hand, const Touched& surface) noexcept {
  save_checkpoint();
  Item& item = *in_hand(hand);
  const std::uint8_t body = surface.body;
  item.body = body;
  item.origin_in_bone = (inverses[body] * Point<frame::Patient>{item.tip}).v;
  item.direction_in_bone = (inverses[body] * Direction<frame::Patient>{-item.shaft}).v;
  item.travel_mm = 0.0;
  item.entry_at_mm = -way_back_to_surface(body, item);
  item.chord_mm = 0.0;
  item.cut_to_mm = 0.0;
  item.in_target = false;
  item.has_left = false;
  item.told_bodies = 0;
  item.hole = kNoHole;
  item.pass = spent.pass_count < detail::kMaxPasses ? static_cast<std::uint8_t>(spent.pass_count)
                                                    : std::uint8_t{255};
  if (item.pass != 255) {
    spent.passes[item.pass] = {item.instrument, body, false, bit_of(body), 0, 0.0};
  }
  ++spent.pass_count;
  emit(EventKind::EnteredBone, now.held[hand], body, 0.0);
  if ((model.kinds.target & bit_of(body)) != 0) {
    enter_target(model, item, body, item.entry_at_mm);
  }
}

/// How far back along the shaft the bone's surface is where a tip starts in an older hole [mm].
double World::State::way_back_to_surface(std::uint8_t body, const Item& item) const noexcept {
  constexpr double kStepMm = 0.1;
  constexpr int kSteps = 600;
  double back = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 p = item.origin_in_bone - item.direction_in_bone * back;
    if (!tissue.is_near(body, p) || !(tissue.untouched_distance_mm(body, p) < -kStepMm)) break;
    back += kStepMm;
  }
  return back;
}

/// From here on the line is the target's: a wire that came through another bone keeps to the target
/// when the wrist moves, and what is measured of it is measured there.
void World::State::enter_target(const Model& model,
                                Item& item,
                                std::uint8_t body,
                                double entry_at_mm) noexcept {
  if (item.body != body) {
    const detail::BodyPose& from = poses[item.body];
    item.origin_in_bone = (inverses[body] * (from * Point<frame::Bone>{item.origin_in_bone})).v;
    item.direction_in_bone =
        (inverses[body] * (from * Direction<frame::Bone>{item.direction_in_bone})).v;
    item.body = body;
  }
  item.in_target = true;
  item.entry_at_mm = entry_at_mm;
  item.chord_mm = way_in_target_mm(model, item);
}

void World::State::drive(const Model& model, std::uint8_t hand) noexcept {
  Item& item = *in_hand(hand);
  const std::uint8_t index = now.held[hand];
  detail::HandState& held = spent.hands[hand];
  const instruments::Instrument& kind = kind_of(model, item);
  HandView& view = snapshot.hands[hand];
  if (item.by_far_end) return draw_by_far_end(model, hand);
  if (kind.is_joystick && held.wish.driver == Driver::Off) lead_fragment(model, hand);
  if (kind.work != Work::None) {
    const double travel_before = item.travel_mm;
    const double resistance = instruments::resistance_n(
        kind.feed, instruments::wire_resistance_n(density_ahead_hu(model, item)));
    const double thrust = held.wish.thrust_n;
    if (held.wish.driver == Driver::Forward) {
      if (kind.work != Work::Drill && item.depth_mm() <= 0.0 && !held.forward_is_held) {
        save_checkpoint();
      }
      const double feed = instruments::speed_mm_per_s(kind.feed, thrust, resistance);
      item.travel_mm =
          std::min(item.travel_mm + feed * kTickSeconds, item.entry_at_mm + kDeepestMm);
      if (kind.work == Work::Drill) steer(model, item, item.travel_mm - travel_before);
      view.resistance_n = std::min(thrust, resistance);
      if (model.kinds.fragments != 0) push_fragment(model, item, view.resistance_n);
    } else if (held.wish.driver == Driver::Reverse && !held.reverse_is_held) {
      item.travel_mm -= kind.feed.back_mm_per_s * kTickSeconds;
      const double left = kind.work == Work::Drill ? item.travel_mm : item.depth_mm();
      if (left <= 0.0) return come_out(model, hand);
    } else {
      view.resistance_n = std::min(thrust, resistance);
    }
    cut(model, item);
    note_tip(model, index);
    if (kind.work == Work::Thread) {
      seat(model, index);
      compress(model, index, item.travel_mm - travel_before);
      view.torque_n_mm = torque_n_mm(model, item, held.wish.driver);
    }
    if (kind.work == Work::Ream) note_reamed(model, item);
  }
  carry_fixed_items();
}

/// How deep, and whether the wire beneath stands out at both ends: else it may come along with the
/// drill [clinical: B1 step 8].
void World::State::note_reamed(const Model& model, const Item& item) noexcept {
  if (item.depth_mm() > now.reamed_mm) now.reamed_mm = item.depth_mm();
  if (!(item.depth_mm() > spent.unheld_ream_mm)) return;
  const Item* wire = item.wire < kMaxItems ? &now.items[item.wire] : nullptr;
  const bool is_held = wire != nullptr && is_far_end_out(model, *wire);
  if (!is_held) spent.unheld_ream_mm = item.depth_mm();
}

/// Removes bone from where it was last cut to where the tip is now. The hole's round front ends at
/// the tip, which so stands before bone that is whole.
void World::State::cut(const Model& model, Item& item) noexcept {
  const instruments::Instrument& kind = kind_of(model, item);
  const double step = kind.work == Work::Drill ? kCutStepMm : kWideCutStepMm;
  if (!(item.travel_mm - item.cut_to_mm >= step) || !(kind.cut_tip_radius_mm > 0.0)) return;
  const double radius = hole_radius_mm(kind);
  if (item.hole == kNoHole && now.hole_count < kNoHole) item.hole = now.hole_count++;
  const detail::BodyPose& pose = poses[item.body];
  const Vec3 behind = item.origin_in_bone - item.direction_in_bone * radius;
  const Point<frame::Patient> from =
      pose * Point<frame::Bone>{behind + item.direction_in_bone * item.cut_to_mm};
  const Point<frame::Patient> to =
      pose * Point<frame::Bone>{behind + item.direction_in_bone * item.travel_mm};
  bool has_changed = false;
  for (std::uint8_t b = 0; b < snapshot.body_count; ++b) {
    const Vec3 from_in_body = (inverses[b] * from).v;
    const Vec3 to_in_body = (inverses[b] * to).v;
    if (!tissue.is_near(b, to_in_body)) continue;
    const double beside = tissue.untouched_distance_mm(b, to_in_body) - radius;
    if (beside > kCutReachMm) continue;
    const fields::Removal removal =
        tissue.remove(b, SweptTool::bar(from_in_body, radius, to_in_body, radius));
    if (removal.outcome == fields::RemovalOutcome::ReserveUsedUp) ++faults.lost_cuts;
    if (removal.outcome != fields::RemovalOutcome::Removed) continue;
    has_changed = true;
    if (beside < 0.0) note_track(item, b, from_in_body, to_in_body, radius);
  }
  item.cut_to_mm = item.travel_mm;
  if (has_changed) ++spent.tissue_revision;
}

/// Draws the item's hole on in a body, or begins it there.
void World::State::note_track(const Item& item,
                              std::uint8_t body,
                              const Vec3& from_in_body,
                              const Vec3& to_in_body,
                              double radius_mm) noexcept {
  for (std::size_t i = 0; i < now.track_count; ++i) {
    if (now.track_hole[i] != item.hole || now.tracks[i].body != body) continue;
    now.tracks[i].to_in_bone = to_in_body;
    return;
  }
  if (now.track_count == kMaxTracks) {
    ++faults.lost_cuts;  // it is removed all the same, only not shown
    return;
  }
  now.track_hole[now.track_count] = item.hole;
  now.tracks[now.track_count++] = {body, from_in_body, to_in_body, radius_mm, radius_mm};
}

/// The way of least resistance: a tip beside an older hole is drawn into it.
void World::State::steer(const Model& model, Item& item, double advanced_mm) noexcept {
  if (!(advanced_mm > 0.0)) return;
  const double radius = kind_of(model, item).cut_tip_radius_mm;
  // Looked at before its own front, which has taken the bone behind the tip on all sides.
  const Vec3 ahead = item.origin_in_bone + item.direction_in_bone * (item.travel_mm + kLookAheadMm);
  const contact::TrackPull pull = contact::track_pull(tissue.cuts().field(item.body), {ahead},
                                                      {-item.direction_in_bone}, radius);
  if (!(pull.strength > 0.0)) return;
  // The tip goes aside by a share of its way; what is in bone behind it bends by no more than that
  // over a stiff length.
  const double aside = pull.strength * contact::kPullPerMm * advanced_mm;
  const double lever = std::max(item.travel_mm, kStiffLengthMm);
  const Vec3 tip = item.origin_in_bone + item.direction_in_bone * item.travel_mm;
  item.direction_in_bone = normalized_or(
      item.direction_in_bone + pull.direction.v * (aside / lever), item.direction_in_bone);
  // The line turns about the middle of that length behind the tip.
  const double behind = std::min(item.travel_mm, 0.5 * kStiffLengthMm);
  const Vec3 held = tip + pull.direction.v * (aside * behind / lever);
  item.origin_in_bone = held - item.direction_in_bone * item.travel_mm;
}

/// What the tip has come into or out of.
void World::State::note_tip(const Model& model, std::uint8_t index) noexcept {
  Item& item = now.items[index];
  const detail::BodyPose& pose = poses[item.body];
  const Vec3 tip =
      (pose * Point<frame::Bone>{item.origin_in_bone + item.direction_in_bone * item.travel_mm}).v;
  while (item.crossing_count > 0 &&
         item.crossings[item.crossing_count - 1].at_mm > item.travel_mm) {
    --item.crossing_count;
  }
  detail::PassState unkept;
  detail::PassState& pass = item.pass != 255 ? spent.passes[item.pass] : unkept;
  for (std::uint8_t b = 0; b < snapshot.body_count; ++b) {
    const Vec3 local = (inverses[b] * Point<frame::Patient>{tip}).v;
    if (!tissue.is_near(b, local)) continue;
    const double depth = -tissue.untouched_distance_mm(b, local);
    if (!(depth > 0.0)) continue;
    const bool is_target = (model.kinds.target & bit_of(b)) != 0;
    if (is_target && !item.in_target) enter_target(model, item, b, item.travel_mm);
    if (depth > kScratchMm) {
      pass.bodies_entered |= bit_of(b);
      note_crossing(item, b);
    }
    const bool is_wrong = !is_target && (model.kinds.allowed & bit_of(b)) == 0;
    if (is_wrong && depth > kScratchMm && (item.told_bodies & bit_of(b)) == 0) {
      item.told_bodies |= bit_of(b);
      emit(EventKind::WrongBone, index, b, depth);
    }
  }
  if (!item.in_target) return;
  const double beyond = item.depth_mm() - item.chord_mm;
  if (beyond > kFarExitMm && !item.has_left) {
    item.has_left = true;
    ++pass.far_exits;
    if (pass.shortest_exit_mm == 0.0 || item.chord_mm < pass.shortest_exit_mm) {
      pass.shortest_exit_mm = item.chord_mm;
    }
    emit(EventKind::LeftFarSide, index, item.body, beyond);
  }
  if (beyond <= 0.0) item.has_left = false;
  double& most =
      kind_of(model, item).work == Work::Drill ? pass.far_exit_mm : pass.follower_exit_mm;
  if (beyond > most) most = beyond;
}

bool World::State::has_screw_in_target(const Model& model) const noexcept {
  for (const Item& item : now.items) {
    if (item.is_there() && item.is_fixed() && item.in_target &&
        kind_of(model, item).work == Work::Thread) {
      return true;
    }
  }
  return false;
}

/// Drawn back to where it went in: a wire is free in the hand again; what rode comes off and the
/// hand has the wire again.
void World::State::come_out(const Model& model, std::uint8_t hand) noexcept {
  Item& item = *in_hand(hand);
  const std::uint8_t index = now.held[hand];
  const std::uint8_t wire = item.wire;
  spent.hands[hand].reverse_is_held = true;
  emit(EventKind::Withdrawn, index, item.instrument, 0.0);
  if (kind_of(model, item).work == Work::Thread) {  // the next one begins anew
    now.closure_mm = now.compression_n = 0.0;
    now.is_stripped = false;
    now.holding_share = 1.0;
  }
  if (kind_of(model, item).work != Work::Drill) {
    item = Item{};
    const bool is_free = wire < kMaxItems && now.items[wire].hand == kNoHand;
    now.held[hand] = is_free ? wire : kNoItem;
    if (is_free) now.items[wire].hand = hand;
    scene.clear_instrument(hand);
    if (is_free) scene.set_instrument(hand, kind_of(model, now.items[wire]).shape);
  } else {
    item.travel_mm = 0.0;
    carry_fixed_items();
    item.body = kNoBody;
    item.in_target = false;
    item.has_left = false;
    item.hole = kNoHole;
    item.crossing_count = 0;
    item.press = {};
    if (!has_screw_in_target(model)) now.gauge_reading_mm = -1.0;  // of a line that is no more
    scene.forget();
  }
  spent.hands[hand].touched_body = kNoBody;
}

double World::State::holding_share_of(const Model& model, const Item& item) const noexcept {
  const instruments::Instrument& kind = kind_of(model, item);
  const auto& thread = kind.shape.thread();
  if (!thread) return 1.0;
  const double crest = kind.shape.greatest_radius_mm();
  const ThreadedCylinderShape screw{crest - thread->depth_mm, crest, thread->pitch_mm,
                                    kind.length_mm};
  const Vec3 z = -item.direction_in_bone;
  const Vec3 x = any_perpendicular(z);
  const Vec3 tip = item.origin_in_bone + item.direction_in_bone * item.travel_mm;
  return tissue.holding_share(model.data.ct.view(), item.body, screw,
                              {Mat3::from_columns(x, cross(z, x), z), tip});
}

/// A screw whose tail comes level with the surface, and how it holds there.
void World::State::seat(const Model& model, std::uint8_t index) noexcept {
  Item& item = now.items[index];
  const double buried = buried_mm(model, item);
  if (buried >= 0.0 && !item.told_seated) {
    item.told_seated = true;
    now.holding_share = holding_share_of(model, item);
    emit(EventKind::Seated, index, item.instrument, buried);
  }
  if (buried < 0.0) item.told_seated = false;
}

}  // namespace carpus::simulation
