// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What enters joints: it goes in by a portal, whose hole in the skin it pivots in, and stops at the
// walls of the joint's space, which are rigid but for what yields (yielding_sheets). What the scope
// shows for how long; how it was led.
#include <algorithm>
#include <bit>
#include <cstdint>

#include "arthroscopy/optics.hpp"
#include "arthroscopy/pathology_table.hpp"
#include "arthroscopy/seen_share.hpp"
#include "simulation/detail/intervals.hpp"
#include "simulation/detail/world_state.hpp"
#include "simulation/questions.hpp"

namespace carpus::simulation {

using detail::Item;
using detail::kInjuryN;
using detail::kNoPortal;
using detail::kWarnN;

namespace {

constexpr double kHoleMm = 2.5;        // so near to a portal's way a tip slips into it
constexpr double kFunnelMm = 3.0;      // ... from before the skin to so deep
constexpr double kFacingCosine = 0.5;  // a shaft within 60 degrees of the way in
constexpr double kPivotMm = 3.0;       // deeper than this the hole leads the shaft
constexpr double kTunnelMm = 2.0;      // soft tissue gives so much aside of the way to the capsule
constexpr double kWallMm = 0.3;        // a rigid wall, less the roughness of its grid
constexpr double kKeptOutMm = 3.0;     // skin and fat keep a tip so far from the joint elsewhere
constexpr double kDentMm = 1.0;        // so far closed skin gives way
constexpr double kFarOutMm = 100.0;
constexpr double kLeftMm = 1.0;  // so far back through the capsule it has come out
constexpr double kSightStepMm = 0.5;
constexpr double kSightShortMm = 0.8;  // before the point: it lies on the wall itself
constexpr double kBehindWallMm = 0.6;  // so far the wall's grid is off
constexpr double kHiddenMm = 0.05;     // this deep in bone a line of sight is cut
constexpr double kProbedMm = 2.5;
constexpr double kNewLookMm = 0.5;
constexpr double kNewLookCosine = 0.9976;  // 4 degrees
constexpr double kLevelCosine = 0.9659;    // 15 degrees

bool has_bit(std::uint32_t bits, int at) noexcept { return (bits >> at & 1U) != 0; }

}  // namespace

bool World::State::enters_joints(const Model& model, const Item& item) const noexcept {
  return model.map != nullptr && !item.is_fixed() && kind_of(model, item).enters_joints;
}

World::State::WayIn World::State::marked_way(const Model& model,
                                             std::uint8_t portal) const noexcept {
  const cases::Portal& at = model.map->portals[portal];
  const detail::BodyPose& pose = poses[at.body];
  return {(pose * Point<frame::Bone>{at.skin}).v, (pose * Direction<frame::Bone>{at.inwards}).v,
          at.capsule_mm};
}

World::State::WayIn World::State::way_in(const Model& model, std::uint8_t portal) const noexcept {
  const detail::OwnWay* own = own_way(model, portal);
  if (own == nullptr) return marked_way(model, portal);
  const detail::BodyPose& pose = poses[model.map->portals[portal].body];
  return {(pose * Point<frame::Bone>{own->skin}).v, (pose * Direction<frame::Bone>{own->inwards}).v,
          own->capsule_mm};
}

const detail::OwnWay* World::State::own_way(const Model& model,
                                            std::uint8_t portal) const noexcept {
  if (!model.goes_in_by_own()) return nullptr;
  for (std::size_t i = 0; i < making.facts.made && i < making.ways.size(); ++i) {
    if (model.asked[i] == portal) return &making.ways[i];
  }
  return nullptr;
}

bool World::State::is_open(const Model& model, std::uint8_t portal) const noexcept {
  return !model.goes_in_by_own() || own_way(model, portal) != nullptr;
}

std::uint8_t World::State::joint_of(const Model& model, std::uint8_t portal) const noexcept {
  const detail::OwnWay* own = own_way(model, portal);
  return own != nullptr ? own->joint : model.map->portals[portal].joint;
}

/// The shaft runs through the hole in the skin once the tip is well in.
Vec3 World::State::led_by_portal(const Model& model,
                                 std::uint8_t hand,
                                 const Vec3& tip,
                                 const Vec3& shaft) const noexcept {
  const std::uint8_t portal = scope_state.portal[hand];
  if (model.map == nullptr || portal == kNoPortal) return shaft;
  const Vec3 to_hole = way_in(model, portal).skin - tip;
  return length(to_hole) > kPivotMm ? normalized_or(to_hole, shaft) : shaft;
}

arthroscopy::OpenedSpace World::State::joint_space_at(const Model& model,
                                                      std::uint8_t joint,
                                                      const Vec3& point) const noexcept {
  const cases::JointSpace& space = model.map->joints[joint];
  arthroscopy::OpenedSpace opened = arthroscopy::opened_space_at(
      space.wall, inverses[space.proximal], inverses[space.distal], point);
  // What tore loose takes its part of the wall along.
  for (std::size_t i = 0; i < model.loose_count; ++i) {
    const auto& loose = inverses[model.loose[i]];
    const auto at = arthroscopy::opened_space_at(space.wall, loose, loose, point);
    if (at.is_near && (!opened.is_near || at.distance_mm < opened.distance_mm)) opened = at;
  }
  return opened;
}

/// How deep a tip is in what does not yield, and which way is out; depth 0 where it is in none.
World::State::Wall World::State::wall_at(const Model& model,
                                         std::uint8_t hand,
                                         const Vec3& tip) const noexcept {
  const Item& item = now.items[now.held[hand]];
  if (!enters_joints(model, item)) return {};
  const std::uint8_t portal = scope_state.portal[hand];
  if (portal == kNoPortal) {
    Wall deepest;
    if (model.goes_in_by_own()) {
      const detail::SkinPlace at = skin_at(model, tip);
      deepest = {at.depth_mm - kDentMm, at.normal};
    }
    for (std::uint8_t joint = 0; joint < model.map->joints.size(); ++joint) {
      const arthroscopy::OpenedSpace space = joint_space_at(model, joint, tip);
      const double deep = space.is_near ? kKeptOutMm - space.distance_mm : 0.0;
      if (deep > deepest.depth_mm) deepest = {deep, space.outwards};
    }
    return deepest;
  }
  const arthroscopy::OpenedSpace space = joint_space_at(model, joint_of(model, portal), tip);
  const auto sheet = sheet_at(model, hand, tip, space.outwards);
  const arthroscopy::InInterval interval = interval_at(model, hand, tip);
  if (interval.depth_mm > 0.0) return {interval.depth_mm, interval.out};
  const bool is_clear =
      sheet ? sheet->depth_mm <= 0.0
            : interval.is_between || (space.is_near && space.distance_mm <= kWallMm);
  if (is_clear) return {};
  const double thick_mm = kind_of(model, item).shape.greatest_radius_mm();
  if (is_in_tear(model, joint_of(model, portal), tip, thick_mm)) return {};
  if (is_in_cut_disc(model, joint_of(model, portal), tip, thick_mm)) return {};
  if (sheet) return *sheet;
  const WayIn way = way_in(model, portal);
  const double deep = dot(tip - way.skin, way.inwards);
  const Vec3 aside = tip - way.skin - way.inwards * deep;
  const double off = length(aside);
  // In the way to the capsule, or the hole in it from within.
  if (deep <= way.capsule_mm && off <= kTunnelMm) return {};
  const bool is_in = scope_state.is_in_joint[hand];
  if (!is_in && deep <= way.capsule_mm) return {off - kTunnelMm, aside * (-1.0 / off)};
  const double off_mm = space.distance_mm - kWallMm;
  if (detail::leads_back(interval, off_mm, space.is_near)) return {interval.off_mm, interval.back};
  if (squared_length(space.outwards) > 0.5) return {off_mm, -space.outwards};
  return {deep > way.capsule_mm ? deep - way.capsule_mm : 0.0, -way.inwards};
}

/// What an undo put back into the hands may lie in a portal that it has left since, or in another:
/// its shaft runs through the hole of its own.
void World::State::find_portals(const Model& model) noexcept {
  if (model.map == nullptr) return;
  for (std::uint8_t h = 0; h < kHands; ++h) {
    scope_state.portal[h] = kNoPortal;
    scope_state.is_in_joint[h] = false;
    const Item* item = in_hand(h);
    if (item == nullptr || !enters_joints(model, *item)) continue;
    double nearest = kHoleMm;
    for (std::uint8_t p = 0; p < model.map->portals.size(); ++p) {
      if (!is_open(model, p)) continue;
      const WayIn way = way_in(model, p);
      const Vec3 to_hole = way.skin - item->tip;
      const double deep = -dot(to_hole, way.inwards);
      const double off = length(to_hole - item->shaft * dot(to_hole, item->shaft));
      if (!(deep >= 0.0) || !(off <= nearest)) continue;
      nearest = off;
      scope_state.portal[h] = p;
      scope_state.is_in_joint[h] = deep > way.capsule_mm;
    }
    scope_state.last_tip[h] = item->tip;
  }
}

/// Through which portal it goes, and whether it is in the joint.
void World::State::follow_portal(const Model& model, std::uint8_t hand, const Item& item) noexcept {
  detail::ScopeState& state = scope_state;
  std::uint8_t& portal = state.portal[hand];
  if (portal == kNoPortal) {
    double nearest = kHoleMm;  // of two whose holes touch
    const HandInput& wish = spent.hands[hand].wish;
    for (std::uint8_t p = 0; p < model.map->portals.size(); ++p) {
      const WayIn way = way_in(model, p);
      const double deep = dot(item.tip - way.skin, way.inwards);
      const Vec3 aside = item.tip - way.skin - way.inwards * deep;
      // What only passes over a hole on its way to another does not slip in.
      const Vec3 to_hole = way.skin - wish.tip_in_patient;
      const Vec3& along = wish.shaft_in_patient;
      const bool is_led_there = length(to_hole - along * dot(to_hole, along)) <= kHoleMm;
      const bool is_taken = state.portal[1U - hand] == p;
      if (!is_taken && is_open(model, p) && is_led_there && deep >= 0.0 && deep <= kFunnelMm &&
          length(aside) <= nearest && -dot(item.shaft, way.inwards) >= kFacingCosine) {
        portal = p;
        nearest = length(aside);
      }
    }
    return;
  }
  const WayIn way = way_in(model, portal);
  const double deep = dot(item.tip - way.skin, way.inwards);
  bool& is_in = state.is_in_joint[hand];
  const bool is_scope = kind_of(model, item).optic.has_value();
  const arthroscopy::OpenedSpace space = joint_space_at(model, joint_of(model, portal), item.tip);
  const double out_mm = space.is_near ? space.distance_mm : kFarOutMm;
  if (!is_in && out_mm < 0.0) {
    is_in = true;
    state.last_tip[hand] = item.tip;
    if (is_scope) {
      ++state.entries;
      // Back by the way that it left: it had fallen out. To go to another portal is none.
      if (state.last_entered == portal) ++state.pull_outs;
      state.last_entered = portal;
    }
    emit(EventKind::EnteredJoint, now.held[hand], portal, 0.0);
    note_way_in(model, hand, item);
  } else if (is_in && out_mm > kLeftMm && deep < way.capsule_mm) {
    is_in = false;
    emit(EventKind::LeftJoint, now.held[hand], portal, 0.0);
  }
  if (deep < 0.0) {
    portal = kNoPortal;
    is_in = false;
  }
}

/// Whether nothing stands before the point: the line of sight stays in the joint and out of bone.
bool World::State::is_in_sight(const Model& model,
                               std::uint8_t joint,
                               const Vec3& eye,
                               const Vec3& point) const noexcept {
  const Vec3 way = point - eye;
  const double far = length(way);
  for (double s = kSightStepMm; s < far - kSightShortMm; s += kSightStepMm) {
    const Vec3 at = eye + way * (s / far);
    const arthroscopy::OpenedSpace space = joint_space_at(model, joint, at);
    if (!space.is_near || space.distance_mm > kBehindWallMm) return false;
    const Touched bone = surface_at(at);
    if (bone.body != kNoBody && bone.distance_mm < -kHiddenMm) return false;
  }
  return !is_behind_tuft(model, joint, eye, point);
}

/// One of the points a tick: all of them many times a second. Those of another joint are not seen.
void World::State::look_at_points(const Model& model,
                                  std::uint8_t joint,
                                  const arthroscopy::Sight& sight) noexcept {
  const auto& points = model.map->points;
  if (points.empty()) return;
  const auto count = static_cast<std::uint32_t>(points.size());
  const auto turn = static_cast<std::size_t>(static_cast<std::uint64_t>(spent.tick) % count);
  const cases::TourPoint& point = points[turn];
  const bool is_seen = point.joint == joint && sees(model, joint, sight, place_now(model, turn));
  detail::ScopeState& state = scope_state;
  const std::uint32_t bit = 1U << point.number;
  state.in_view_ticks[turn] = is_seen ? state.in_view_ticks[turn] + count : 0;
  state.points_in_view = is_seen ? state.points_in_view | bit : state.points_in_view & ~bit;
  if (state.in_view_ticks[turn] >= detail::kSeenTicks &&
      !has_bit(state.points_seen, point.number)) {
    state.points_seen |= bit;
    emit(EventKind::PointSeen, kNoItem, point.number, 0.0);
  }
}

/// As look_at_points.
void World::State::look_at_lesions(const Model& model,
                                   std::uint8_t joint,
                                   const arthroscopy::Sight& sight) noexcept {
  if (!model.lesions || model.lesions->lesions.empty()) return;
  const auto& lesions = model.lesions->lesions;
  const auto count = static_cast<std::uint32_t>(lesions.size());
  const auto turn = static_cast<std::size_t>(static_cast<std::uint64_t>(spent.tick) % count);
  const cases::Lesion& lesion = lesions[turn];
  const Vec3 at = lesion_middle(model, turn);
  const bool is_seen = lesion.joint == joint && arthroscopy::is_in_field(sight, at) &&
                       distance(sight.eye, at) <= arthroscopy::kUsefulMm &&
                       is_clear_to(model, distance(sight.eye, at)) &&
                       is_in_sight(model, joint, sight.eye, at);
  std::uint32_t& ticks = scope_state.lesion_ticks[turn];
  ticks = is_seen ? ticks + count : 0;
  if (ticks >= detail::kSeenTicks) scope_state.lesions_seen |= 1U << turn;
}

std::uint8_t World::State::unanswered(const Model& model) const noexcept {
  const arthroscopy::PathologyTable* asked = questions_of(model.procedure);
  if (asked == nullptr || !model.lesions) return 0;
  std::uint8_t count = 0;
  for (std::size_t f = 0; f < asked->findings.size(); ++f) {
    if (scope_state.answers[f] == cases::kNotJudged) ++count;
  }
  return count;
}

void World::State::note_scope_look(std::uint8_t joint, const arthroscopy::Sight& sight) noexcept {
  detail::ScopeState& state = scope_state;
  if (state.look_count >= detail::kMaxLooks) return;
  if (state.look_count > 0) {
    const procedure::ScopeLook& last = looks[state.look_count - 1];
    const double moved = distance(last.eye, sight.eye);
    if (moved < kNewLookMm && dot(last.axis, sight.axis) > kNewLookCosine && last.joint == joint) {
      return;
    }
  }
  looks[state.look_count++] = {sight.eye,
                               sight.axis,
                               spent.wrist.traction_n,
                               spent.wrist.flexion_rad,
                               spent.wrist.radial_deviation_rad,
                               spent.wrist.pronation_rad,
                               joint};
}

bool World::State::is_level(const Model& model, const arthroscopy::Sight& sight) const noexcept {
  const Vec3 level = (poses[model.map->forearm] * Direction<frame::Bone>{model.map->distal}).v;
  return arthroscopy::horizon_cosine(sight, level) >= kLevelCosine;
}

/// By bone or by the joint's wall.
bool World::State::is_held_back(std::uint8_t hand, const Item& item) const noexcept {
  return spent.hands[hand].touched_body != kNoBody ||
         distance(item.tip, spent.hands[hand].plan.tip) > kWallMm;
}

void World::State::note_probing(const Model& model, std::uint8_t hand, const Item& item) noexcept {
  if (!is_held_back(hand, item)) return;
  const std::uint8_t joint = joint_of(model, scope_state.portal[hand]);
  for (const cases::TourPoint& point : model.map->points) {
    if (!point.is_probed || point.joint != joint ||
        has_bit(scope_state.points_probed, point.number))
      continue;
    const Vec3 at = (poses[point.body] * Point<frame::Bone>{point.at}).v;
    if (distance(at, item.tip) > kProbedMm) continue;
    scope_state.points_probed |= 1U << point.number;
    emit(EventKind::PointProbed, now.held[hand], point.number, 0.0);
  }
}

/// The lens lies in the middle of the rounded tip: where that touches, it still sees.
std::optional<arthroscopy::Sight> World::State::sight_of(const Model& model,
                                                         const Item& item) const noexcept {
  const instruments::Instrument& kind = kind_of(model, item);
  if (!kind.optic || model.map == nullptr) return std::nullopt;
  const Vec3 level = (poses[model.map->forearm] * Direction<frame::Bone>{model.map->distal}).v;
  return arthroscopy::sight_of({kind.optic->view_angle_deg, kind.optic->field_deg},
                               {item.tip + item.shaft * kind.shape.front_z_mm(), item.shaft,
                                scope_state.shaft_turn_deg, scope_state.camera_turn_deg},
                               level);
}

void World::State::watch_scopes(const Model& model) noexcept {
  if (model.map == nullptr) return;
  detail::ScopeState& state = scope_state;
  bool looks_in = false;
  for (std::uint8_t h = 0; h < kHands; ++h) {
    const Item* item = in_hand(h);
    if (item == nullptr || !enters_joints(model, *item)) {
      state.portal[h] = kNoPortal;
      state.is_in_joint[h] = false;
      conduct.motion[h] = {};
      conduct.presses[h] = {};
      conduct.is_on_capsule[h] = false;
      continue;
    }
    follow_portal(model, h, *item);
    watch_conduct(model, h, *item);
    if (!state.is_in_joint[h] || state.portal[h] == kNoPortal) continue;
    const std::uint8_t joint = joint_of(model, state.portal[h]);
    const std::size_t what = kind_of(model, *item).optic ? 0 : 1;
    state.path_mm[what] += distance(state.last_tip[h], item->tip);
    state.last_tip[h] = item->tip;
    const double force = length(state.felt[h]);
    if (force > kWarnN) ++state.warn_ticks;
    if (force > kInjuryN) ++state.injury_ticks;
    state.most_force_n = std::max(state.most_force_n, force);
    if (const auto sight = sight_of(model, *item)) {
      looks_in = true;
      ++state.looking_ticks;
      if (!is_level(model, *sight)) ++state.tilted_ticks;
      look_at_points(model, joint, *sight);
      look_at_lesions(model, joint, *sight);
      if (is_clear_enough(model)) {
        note_scope_look(joint, *sight);
      }
    } else {
      note_probing(model, h, *item);
      probe_screw(model, h, *item);
    }
  }
  if (!looks_in && state.points_in_view != 0) {  // what nobody looks at is not in view
    state.points_in_view = 0;
    state.in_view_ticks = {};
  }
  watch_drill(model);
}

procedure::ScopeFacts World::State::scope_facts(const Model& model) const noexcept {
  procedure::ScopeFacts facts;
  facts.portal = scope_state.portal;
  for (std::size_t h = 0; h < kHands && model.map != nullptr; ++h) {
    const std::uint8_t portal = scope_state.portal[h];
    if (portal == kNoPortal) continue;
    facts.joint[h] = joint_of(model, portal);
    facts.portal_number[h] = model.map->portals[portal].number;
  }
  facts.is_in_joint = scope_state.is_in_joint;
  facts.points_seen = scope_state.points_seen;
  facts.points_probed = scope_state.points_probed;
  facts.unanswered = unanswered(model);
  facts.drill = drill_state.done;
  facts.loose = loose_facts(model);
  facts.shaving = shaving_state.done;
  facts.punch = punch_state.done;
  facts.screw = screw_facts(model);
  return facts;
}

procedure::ScopeRecord World::State::scope_record(const Model& model) const {
  const detail::ScopeState& state = scope_state;
  procedure::ScopeRecord record;
  record.facts = scope_facts(model);
  record.path_mm = state.path_mm;
  record.entries = state.entries;
  record.pull_outs = state.pull_outs;
  record.looking_ticks = state.looking_ticks;
  record.tilted_ticks = state.tilted_ticks;
  record.warn_ticks = state.warn_ticks;
  record.injury_ticks = state.injury_ticks;
  record.most_force_n = state.most_force_n;
  for (const InstrumentIndex index : model.procedure.tray) {
    const auto& optic = model.catalogue[index].optic;
    if (!optic) continue;
    record.least_cosine = arthroscopy::cos_sin_deg(optic->field_deg / 2)[0];
    break;
  }
  record.answers = state.answers;
  record.fluid = fluid.facts;
  if (model.lesions) {
    record.truth = model.lesions->grades;
    record.lesions = static_cast<std::uint32_t>(model.lesions->lesions.size());
    record.lesions_seen = static_cast<std::uint32_t>(std::popcount(state.lesions_seen));
  }
  record.looks.assign(looks.begin(), looks.begin() + state.look_count);
  record.smoothness = conduct.smoothness;
  record.scuffs = conduct.scuffs;
  record.capsule_pushes = conduct.capsule_pushes;
  const std::size_t kept = std::min<std::size_t>(conduct.scuffs, conduct.places.size());
  record.scuff_places.assign(conduct.places.begin(), conduct.places.begin() + kept);
  return record;
}

void World::State::publish_scope(const Model& model) noexcept {
  ScopeView& view = snapshot.scope;
  view = ScopeView{};
  if (model.map == nullptr) return;
  view.shaft_turn_deg = scope_state.shaft_turn_deg;
  view.camera_turn_deg = scope_state.camera_turn_deg;
  view.facts = scope_facts(model);
  view.points_in_view = scope_state.points_in_view;
  view.pull_outs = scope_state.pull_outs;
  view.lesions_seen = scope_state.lesions_seen;
  view.answers = scope_state.answers;
  view.hold_ticks = drill_state.hold_ticks;
  view.line_share = drill_state.line_share;
  view.is_probe_seen = drill_state.is_probe_seen;
  publish_loose(model);
  publish_pieces(model);
  publish_shaving(model);
  publish_punches();
  publish_fluid(model);
  for (std::uint8_t h = 0; h < kHands; ++h) {
    const Item* item = in_hand(h);
    if (item == nullptr) continue;
    if (const auto sight = sight_of(model, *item)) {
      view.hand = h;
      view.axis_in_patient = sight->axis;
      view.up_in_patient = sight->up;
      view.is_level = is_level(model, *sight);
    }
  }
}

}  // namespace carpus::simulation
