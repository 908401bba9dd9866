// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What works on closed skin: where the skin lies now, and how a fingertip, a marker and a blade go
// over it. Skin gives way by a share of what a hand presses, so that the force of the coupling
// tells what lies beneath.
#include <algorithm>

#include "haptics/virtual_coupling.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::Item;
using detail::SkinPlace;
using instruments::SkinWork;

namespace {

/// Skin goes with the forearm up to so far proximal of the first portal, with the hand from so far
/// distal of it [E].
constexpr double kWithForearmMm = -4.0;
constexpr double kWithHandMm = 12.0;
constexpr double kWaitsMm = 3.0;         // off the skin
constexpr int kBackSteps = 2;            // by which its place as scanned is found
constexpr int kBackTurns = 8;            // and by which it is mended, where the wrist is bent
constexpr double kBackMm = 1e-3;         // near enough
constexpr double kLeastStretch = 0.2;    // of skin that folds no way back is found by steps
constexpr double kFastestMm = 2.0;       // a tick: 2 m/s
constexpr double kCutsFastestMm = 0.05;  // a blade in skin, a tick
/// Of a hand under the skin [E]: from half a limb on the skin of its other side is the nearest.
constexpr double kDeepestMm = 10.0;
constexpr double kPressesMm = 0.5;  // the tip under the skin
constexpr double kLeastStepMm = 0.5;

}  // namespace

bool World::State::works_on_skin(const Model& model, const Item& item) const noexcept {
  return model.makes_portals() && !item.is_fixed() && kind_of(model, item).skin.has_value();
}

/// How far on the way from the forearm's skin to the hand's, 0 to 1.
double World::State::way_to_hand(const Model& model, const Vec3& scanned) const noexcept {
  const cases::ArthroscopicMap& map = *model.map;
  const double far = dot(scanned - map.portals[model.asked[0]].skin, map.distal);
  return std::clamp((far - kWithForearmMm) / (kWithHandMm - kWithForearmMm), 0.0, 1.0);
}

double World::State::hand_share(const Model& model, const Vec3& scanned) const noexcept {
  const double t = way_to_hand(model, scanned);
  return t * t * (3.0 - 2.0 * t);
}

Vec3 World::State::as_it_lies(const Model& model, const Vec3& scanned) const noexcept {
  const double share = hand_share(model, scanned);
  const Point<frame::Bone> at{scanned};
  return (poses[model.map->forearm] * at).v * (1.0 - share) +
         (poses[model.map->joints.back().distal] * at).v * share;
}

/// By Newton's steps: the slope of as_it_lies is the turn R of forearm and hand, by their shares,
/// and how far they lie apart (u) along the limb, where the share grows (v): of R + u v^T the
/// inverse is Sherman and Morrison's.
Vec3 World::State::as_scanned(const Model& model, const Vec3& at) const noexcept {
  const Pose<frame::Bone, frame::Patient>& from_forearm = inverses[model.map->forearm];
  const Pose<frame::Bone, frame::Patient>& from_hand = inverses[model.map->joints.back().distal];
  const Vec3 by_forearm = (from_forearm * Point<frame::Patient>{at}).v;
  const Vec3 by_hand = (from_hand * Point<frame::Patient>{at}).v;
  Vec3 scanned = by_forearm;
  for (int i = 0; i < kBackSteps; ++i) {
    const double share = hand_share(model, scanned);
    scanned = by_forearm * (1.0 - share) + by_hand * share;
  }
  for (int i = 0; i < kBackTurns; ++i) {
    const double share = hand_share(model, scanned);
    const Point<frame::Bone> there{scanned};
    const Vec3 with_forearm = (poses[model.map->forearm] * there).v;
    const Vec3 with_hand = (poses[model.map->joints.back().distal] * there).v;
    const Vec3 off = at - (with_forearm * (1.0 - share) + with_hand * share);
    if (squared_length(off) < kBackMm * kBackMm) break;
    const auto turned_back = [&](const Vec3& way) {
      const Direction<frame::Patient> turned{way};
      return (from_forearm * turned).v * (1.0 - share) + (from_hand * turned).v * share;
    };
    const double t = way_to_hand(model, scanned);
    const double grows_per_mm = 6.0 * t * (1.0 - t) / (kWithHandMm - kWithForearmMm);
    const Vec3 step = turned_back(off);
    const Vec3 apart = turned_back(with_hand - with_forearm);
    const double stretch = 1.0 + grows_per_mm * dot(model.map->distal, apart);
    const double along = grows_per_mm * dot(model.map->distal, step);
    scanned += step - apart * (along / std::max(stretch, kLeastStretch));
  }
  return scanned;
}

/// Depths as scanned: bones that part do not thin the skin.
SkinPlace World::State::skin_at(const Model& model, const Vec3& at) const noexcept {
  const Vec3 scanned = as_scanned(model, at);
  SkinPlace place = model.skin->at(scanned);
  const double share = hand_share(model, scanned);
  const Direction<frame::Bone> normal{place.normal};
  place.normal = normalized_or((poses[model.map->forearm] * normal).v * (1.0 - share) +
                                   (poses[model.map->joints.back().distal] * normal).v * share,
                               place.normal);
  place.point = as_it_lies(model, place.point);
  return place;
}

void World::State::follow_wish(Item& item, const Vec3& to, double most_mm) noexcept {
  const Vec3 way = to - item.tip;
  const double far = length(way);
  item.tip = far > most_mm ? item.tip + way * (most_mm / far) : to;
}

void World::State::move_on_skin(const Model& model, std::uint8_t hand) noexcept {
  Item& item = *in_hand(hand);
  detail::UnderSkin& under = making.worked.hands[hand];
  if (under.waits) {
    const Vec3& wish = spent.hands[hand].plan.tip;
    const SkinPlace at = skin_at(model, wish);
    under.waits = at.depth_mm > 0.0;
    spent.hands[hand].touched_body = kNoBody;
    turn_towards(item, spent.hands[hand].plan.shaft);
    return follow_wish(item, under.waits ? at.point + at.normal * kWaitsMm : wish, kFastestMm);
  }
  switch (kind_of(model, item).skin->work) {
    case SkinWork::Palpate:
    case SkinWork::Mark:
    case SkinWork::Incise:
      move_over_skin(model, hand);
      break;
    case SkinWork::Needle:
    case SkinWork::Spread:
    case SkinWork::Sheath:
      move_under_skin(model, hand);
      break;
  }
}

/// Where a hand that presses on wishes its tip: no deeper on the way there than kDeepestMm. Depth
/// changes by no more than the way, which is what a step may be.
Vec3 World::State::wished_on_skin(const Model& model,
                                  const Vec3& tip,
                                  const Vec3& wish) const noexcept {
  double depth = skin_at(model, tip).depth_mm;
  const double far = distance(tip, wish);
  if (depth < kPressesMm || depth >= kDeepestMm)
    return wish;  // where the skin came over it: out again
  double on = 0.0;
  while (depth < kDeepestMm) {
    on += std::max(kDeepestMm - depth, kLeastStepMm);
    if (on >= far) return wish;
    depth = skin_at(model, tip + (wish - tip) * (on / far)).depth_mm;
  }
  return tip + (wish - tip) * (on / far);
}

void World::State::move_over_skin(const Model& model, std::uint8_t hand) noexcept {
  Item& item = *in_hand(hand);
  const instruments::SkinTool& tool = *kind_of(model, item).skin;
  const procedure::PortalMaking& figures = *model.procedure.making;
  detail::HandState& held = spent.hands[hand];
  detail::UnderSkin& under = making.worked.hands[hand];
  turn_towards(item, held.plan.shaft);
  held.touched_body = kNoBody;
  held.contact_normal = {};
  making.feels[hand] = {};
  const Vec3 wish = wished_on_skin(model, item.tip, held.plan.tip);
  const SkinPlace at = skin_at(model, wish);
  if (!(at.depth_mm > 0.0)) {
    follow_wish(item, wish, kFastestMm);
    if (under.is_in) leave_skin(hand);
    return;
  }
  const double pressed_n = haptics::kContactStiffnessNPerMm * distance(wish, item.tip);
  double deep = at.depth_mm * tool.gives_share;
  if (tool.work == SkinWork::Palpate) {
    deep = sinks_in_mm(model, at, tool.gives_share);
    if (pressed_n >= figures.touch_n) {
      making.feels[hand] = felt_at(model, at);
      note_felt(model, at);
    }
  } else if (tool.work == SkinWork::Mark) {
    if (pressed_n >= figures.touch_n) ink(model, at.point);
  } else {
    const double cuts_n = haptics::kContactStiffnessNPerMm * (at.depth_mm - deep);
    if (under.is_in || cuts_n >= tool.skin_n) {
      const double drag = tool.way_n / haptics::kContactStiffnessNPerMm;
      deep = at.depth_mm > drag ? at.depth_mm - drag : 0.0;
      const Touched bone = surface_at(at.point - at.normal * deep);
      if (bone.body != kNoBody && bone.distance_mm < 0.0) deep = under.travel_mm;
      under.travel_mm = deep;
      follow_wish(item, at.point - at.normal * deep, kCutsFastestMm);
      return cut_skin(model, hand, skin_at(model, item.tip));
    }
  }
  follow_wish(item, at.point - at.normal * deep, kFastestMm);
}

void World::State::publish_skin(const Model& model) noexcept {
  if (!model.makes_portals()) return;
  SkinView& view = snapshot.skin;
  view.is_there = true;
  view.facts = making_facts(model);
  view.feels = making.feels;
  for (std::size_t h = 0; h < kHands; ++h) {
    const detail::UnderSkin& under = making.worked.hands[h];
    view.under_mm[h] = under.is_in ? under.travel_mm : 0.0;
    const Item* item = in_hand(h);
    const bool works = item != nullptr && works_on_skin(model, *item);
    if (works) {
      const SkinPlace at = skin_at(model, item->tip);
      view.on_skin[h] = at.point;
      view.out_of_skin[h] = at.normal;
    } else {
      view.on_skin[h] = view.out_of_skin[h] = {};
    }
    view.is_spreading[h] = under.is_spreading;
    // Not where it was led on through the joint and out at its other side.
    view.is_wet[h] = works && under.is_told &&
                     kind_of(model, *item).skin->work == SkinWork::Needle &&
                     joint_at(model, item->tip).has_value();
  }
  view.ink_count = making.worked.ink_count;
  for (std::size_t i = 0; i < view.ink_count; ++i) {
    view.ink[i] = as_it_lies(model, making.worked.ink[i]);
  }
  view.cut_count = making.worked.cut_count;
  for (std::size_t i = 0; i < view.cut_count; ++i) {
    const detail::SkinCut& cut = making.worked.cuts[i];
    view.cuts[i] = {as_it_lies(model, cut.from), as_it_lies(model, cut.to), cut.spread_mm > 0.0};
  }
  view.way_count = 0;
  for (std::size_t i = 0; model.goes_in_by_own() && i < making.facts.made; ++i) {
    const detail::OwnWay& way = making.ways[i];
    view.ways[view.way_count++] = {model.asked[i], way.joint, way.skin, way.inwards,
                                   way.capsule_mm};
  }
  const std::size_t asked = asked_now();
  view.spot = marked_way(model, model.asked[asked]).skin;
  view.landmark = skin_at(model, landmark_now(model, asked)).point;
}

}  // namespace carpus::simulation
