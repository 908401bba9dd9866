// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is left on the skin and what is counted as portals are made: ink, cuts, passes of the
// needle, how needle and sheath came in against the portal as the case's map has it.
#include <algorithm>
#include <cmath>

#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::kNoCut;
using detail::SkinCut;
using detail::SkinPlace;
using detail::UnderSkin;
using instruments::SkinWork;

namespace {

constexpr double kCutBeginsMm = 0.2;     // below the skin
constexpr double kOffMarkMm = 1.0;       // of the marked way: a hand so near has kept to it [E]
constexpr double kSameSideCosine = 0.5;  // of a way in to the portal's [E]
constexpr double kSameCutMm = 1.0;       // a blade so near to a cut's end goes on with it [E]

double squared_aside(const Vec3& off, const Vec3& way) noexcept {
  return squared_length(off - way * dot(off, way));
}

}  // namespace

/// The last one, once all are made.
std::size_t World::State::asked_now() const noexcept {
  const std::size_t made = making.facts.made;
  return made < procedure::kPortalsMade ? made : procedure::kPortalsMade - 1;
}

void World::State::ink(const Model& model, const Vec3& at) noexcept {
  detail::Worked& worked = making.worked;
  if (worked.ink_count >= kMaxInk) return;
  const Vec3 scanned = as_scanned(model, at);
  const double apart = model.procedure.making->ink_mm;
  for (std::size_t i = 0; i < worked.ink_count; ++i) {
    if (squared_length(worked.ink[i] - scanned) < apart * apart) return;
  }
  worked.ink[worked.ink_count++] = scanned;
}

/// A blade cuts sharply whatever it meets from below the skin down to its tip: nerves and arteries
/// run in the fat, tendons below the fascia.
void World::State::watch_blade(const Model& model,
                               std::uint8_t hand,
                               const SkinPlace& at) noexcept {
  const procedure::PortalMaking& figures = *model.procedure.making;
  if (at.depth_mm <= figures.skin_mm) return;
  note_strayed(model, asked_now(), at.point, -at.normal);
  if (structures.size() == 0) return;
  const Vec3 below_skin = at.point - at.normal * figures.skin_mm;
  const Vec3 below_fascia = at.point - at.normal * figures.fascia_mm;
  structures.follow({poses.data(), snapshot.body_count});
  const Vec3& tip = now.items[now.held[hand]].tip;
  for (std::size_t i = 0; i < structures.size(); ++i) {
    const double least = structure_state.harm[i].least_mm;
    const bool is_tendon = structures.kind(i) == anatomy::StructureKind::Tendon;
    if (is_tendon && at.depth_mm <= figures.fascia_mm) continue;
    const double gap = structures.gap_mm(i, tip, is_tendon ? below_fascia : below_skin, least);
    note_harm(hand, i, gap, gap < 0.0);
  }
}

/// A way from another side of the limb leads past what is known to lie beside the portal's.
bool World::State::is_from_its_side(const Model& model,
                                    std::size_t asked,
                                    const Vec3& towards) const noexcept {
  return dot(towards, marked_way(model, model.asked[asked]).inwards) > kSameSideCosine;
}

/// Only where it goes in from the portal's side: on the other lies what is generated for others.
void World::State::note_strayed(const Model& model,
                                std::size_t asked,
                                const Vec3& at,
                                const Vec3& towards) noexcept {
  if (!is_from_its_side(model, asked, towards)) return;
  const WayIn marked = marked_way(model, model.asked[asked]);
  double& most = making.facts.portal[asked].strayed_mm;
  most = std::max(most, std::sqrt(squared_aside(at - marked.skin, marked.inwards)));
}

void World::State::cut_skin(const Model& model, std::uint8_t hand, const SkinPlace& at) noexcept {
  detail::Worked& worked = making.worked;
  UnderSkin& under = worked.hands[hand];
  if (at.depth_mm < kCutBeginsMm) return;
  const Vec3 scanned = as_scanned(model, at.point);
  if (!under.is_in) {
    under.is_in = true;
    under.cut = kNoCut;
    for (std::uint8_t c = 0; c < worked.cut_count; ++c) {
      const SkinCut& cut = worked.cuts[c];
      if (std::min(distance(scanned, cut.from), distance(scanned, cut.to)) <= kSameCutMm) {
        under.cut = c;
      }
    }
    if (under.cut == kNoCut && worked.cut_count < kMaxCuts) {
      const std::size_t asked = asked_now();
      const bool is_elsewhere = !is_from_its_side(model, asked, -at.normal);
      procedure::PortalMade& made = making.facts.portal[asked];
      if (made.cuts < 255) ++made.cuts;
      if (!made.needle.is_in && making.facts.made <= asked && !model.is_opened_first[asked]) {
        made.out_of_order |= procedure::kCutBeforeNeedle;
      }
      under.cut = worked.cut_count;
      SkinCut& cut = worked.cuts[worked.cut_count++];
      cut = {};
      cut.from = cut.to = scanned;
      cut.portal = static_cast<std::uint8_t>(asked);
      emit(EventKind::SkinCut, now.held[hand], is_elsewhere ? 1 : 0, 0.0);
    }
  }
  watch_blade(model, hand, at);
  if (under.cut == kNoCut) return;
  SkinCut& cut = worked.cuts[under.cut];
  cut.deepest_mm = std::max(cut.deepest_mm, at.depth_mm);
  // It reaches from end to end of where the blade was.
  const double whole = distance(cut.from, cut.to);
  const double from = distance(scanned, cut.from);
  const double to = distance(scanned, cut.to);
  if (std::max(from, to) <= whole) return;
  if (from >= to) {
    cut.to = scanned;
  } else {
    cut.from = scanned;
  }
}

procedure::WayMade World::State::way_made(const Model& model,
                                          const UnderSkin& under) const noexcept {
  const WayIn marked = marked_way(model, model.asked[under.portal]);
  const Vec3 inner = under.entry + under.towards * under.capsule_mm;
  procedure::WayMade way;
  way.is_in = true;
  way.skin_off_mm = std::sqrt(squared_aside(under.entry - marked.skin, marked.inwards));
  way.inner_off_mm = std::sqrt(squared_aside(inner - marked.skin, marked.inwards));
  // From the side: by how much it points to the forearm more or less than the slope of the joint.
  const Vec3 distal = (poses[model.map->forearm] * Direction<frame::Bone>{model.map->distal}).v;
  const Vec3 aside = normalized_or(cross(distal, marked.inwards), {1, 0, 0});
  const Vec3 seen = normalized_or(under.towards - aside * dot(under.towards, aside), aside);
  way.tilt_cosine = std::clamp(dot(seen, marked.inwards), -1.0, 1.0);
  return way;
}

detail::OwnWay World::State::way_as_made(const Model& model,
                                         const UnderSkin& under) const noexcept {
  const std::uint8_t portal = model.asked[under.portal];
  const Pose<frame::Bone, frame::Patient>& from = inverses[model.map->portals[portal].body];
  const Vec3 tip = under.entry + under.towards * under.travel_mm;
  detail::OwnWay way;
  way.skin = (from * Point<frame::Patient>{under.entry}).v;
  way.inwards = (from * Direction<frame::Patient>{under.towards}).v;
  way.capsule_mm = under.capsule_mm;
  way.joint = joint_at(model, tip).value_or(model.map->portals[portal].joint);
  return way;
}

procedure::CutMade World::State::cut_made(const Model& model,
                                          const UnderSkin& under) const noexcept {
  procedure::CutMade made;
  if (under.cut == kNoCut) return made;
  const SkinCut& cut = making.worked.cuts[under.cut];
  made.length_mm = cut_length(model, under.cut);
  made.deepest_mm = cut.deepest_mm;
  // As scanned, where the limb's axis is known, and on the skin: its slope is none of the cut's
  // doing.
  const Vec3 along = normalized_or(cut.to - cut.from, {});
  const Vec3 out = model.skin->at((cut.from + cut.to) / 2.0).normal;
  const Vec3 distal = model.map->distal;
  const double cosine = dot(along, normalized_or(distal - out * dot(distal, out), distal));
  made.along_cosine = std::min(1.0, cosine < 0.0 ? -cosine : cosine);
  const Vec3 spot = marked_way(model, model.asked[under.portal]).skin;
  made.off_mm = distance(spot, on_cut(model, under.cut, spot));
  return made;
}

/// Where a needle is, for the portal that it goes in for: what it showed is what the blade follows.
bool World::State::is_uncut(const UnderSkin& under) const noexcept {
  const detail::Worked& worked = making.worked;
  return under.cut == kNoCut && making.facts.made == under.portal &&
         std::none_of(worked.cuts.begin(), worked.cuts.begin() + worked.cut_count,
                      [&](const SkinCut& cut) { return cut.portal == under.portal; });
}

/// How long the scope in the other hand has its point in the picture, in the joint.
void World::State::watch_needle(const Model& model, std::uint8_t hand) noexcept {
  if (!model.goes_in_by_own()) return;
  UnderSkin& under = making.worked.hands[hand];
  const Vec3 point = under.entry + under.towards * under.travel_mm;
  const auto joint = joint_at(model, point);
  const bool is_seen = joint && is_seen_beside(model, hand, *joint, point);
  under.seen_ticks = is_seen ? under.seen_ticks + 1 : 0;
  if (!under.is_told || !is_uncut(under)) return;
  std::uint32_t& most = making.facts.portal[under.portal].needle_seen_ticks;
  if (under.seen_ticks <= most) return;
  most = under.seen_ticks;
  if (most == procedure::kNeedleSeenTicks) emit(EventKind::NeedleSeen, now.held[hand], 0, 0.0);
}

/// A needle and a sheath, after they went on.
void World::State::note_under(const Model& model, std::uint8_t hand) noexcept {
  const procedure::PortalMaking& figures = *model.procedure.making;
  UnderSkin& under = making.worked.hands[hand];
  procedure::PortalMade& made = making.facts.portal[under.portal];
  const SkinWork work = kind_of(model, *in_hand(hand)).skin->work;
  if (work == SkinWork::Spread) return;
  if (work == SkinWork::Needle) {
    const instruments::SkinTool& tool = *kind_of(model, *in_hand(hand)).skin;
    if (!under.is_deep && under.travel_mm > figures.pass_mm) {
      under.is_deep = true;
      if (made.passes < 0xFFFF) ++made.passes;
    } else if (under.is_deep && under.travel_mm < tool.reaim_mm) {
      under.is_deep = false;
    }
    // Into a joint or not: what it is led through it harms.
    if (under.is_deep && !under.is_through) note_line_in(model, hand);
  }
  if (!under.is_through) return;
  if (work == SkinWork::Sheath && under.is_told) {
    made.overrun_mm = std::max(made.overrun_mm, under.travel_mm - under.capsule_mm);
  }
  ++under.ticks;
  if (work == SkinWork::Needle) watch_needle(model, hand);
  if (under.is_told || static_cast<double>(under.ticks) * kTickSeconds < figures.in_joint_s) return;
  under.is_told = true;
  note_line_in(model, hand);
  const bool is_elsewhere = !is_from_its_side(model, under.portal, under.towards);
  if (work == SkinWork::Needle) {
    if (making.facts.made == under.portal) made.needle = way_made(model, under);
    if (is_uncut(under)) made.needle_seen_ticks = 0;  // what was seen of one before led to nothing
    return emit(EventKind::FluidBack, now.held[hand], is_elsewhere ? 1 : 0, 0.0);
  }
  made.overrun_mm = std::max(made.overrun_mm, under.travel_mm - under.capsule_mm);
  emit(EventKind::SheathIn, now.held[hand], is_elsewhere ? 1 : 0,
       under.travel_mm - under.capsule_mm);
  if (making.facts.made != under.portal) return;
  made.sheath = way_made(model, under);
  making.ways[under.portal] = way_as_made(model, under);
  made.cut = cut_made(model, under);
  made.is_cut = true;
  made.is_spread = under.cut != kNoCut && making.worked.cuts[under.cut].is_spread;
  if (!made.is_spread) made.out_of_order |= procedure::kSheathBeforeSpread;
  ++making.facts.made;
  making.felt = {};
}

/// Nerves and arteries are struck by a touch. Of tendons a way through the middle harms [E], where
/// nothing was spread aside for what is thick a touch.
void World::State::note_line_in(const Model& model, std::uint8_t hand) noexcept {
  const UnderSkin& under = making.worked.hands[hand];
  note_strayed(model, under.portal, under.entry, under.towards);
  if (structures.size() == 0) return;
  structures.follow({poses.data(), snapshot.body_count});
  const instruments::Instrument& kind = kind_of(model, *in_hand(hand));
  const bool is_spread = under.cut != kNoCut && making.worked.cuts[under.cut].is_spread;
  const bool is_forced = kind.skin->work == SkinWork::Sheath && !is_spread;
  const Vec3 inner =
      under.entry + under.towards * (under.is_through ? under.capsule_mm : under.travel_mm);
  const WayIn marked = marked_way(model, model.asked[under.portal]);
  const Vec3 capsule = marked.skin + marked.inwards * marked.capsule_mm;
  note_strayed(model, under.portal, inner, under.towards);
  const double radius_mm = kind.shape.greatest_radius_mm();
  for (std::size_t i = 0; i < structures.size(); ++i) {
    if (is_spread && (model.drawn_aside[under.portal] >> i & 1U) != 0) continue;
    // Nearer than ever before, or what is touched anew.
    const double known = std::max(0.0, structure_state.harm[i].least_mm) + radius_mm;
    const double gap = structures.gap_mm(i, under.entry, inner, known) - radius_mm;
    const bool is_tendon = structures.kind(i) == anatomy::StructureKind::Tendon;
    double least = 0.0;
    if (is_tendon && !is_forced && gap < 0.0) {
      // Nor where this wrist's tendons leave the marked way no room: as in note_way_in.
      const double on_mark = structures.gap_mm(i, capsule, marked.skin) - radius_mm - kOffMarkMm;
      // What is thin or blunt pushes a tendon aside unless it goes through its middle half.
      least = std::min(-structures.radius_mm(i) / 2 - radius_mm, on_mark);
    }
    note_harm(hand, i, gap, gap < least);
  }
}

procedure::MakingFacts World::State::making_facts(const Model& model) const noexcept {
  procedure::MakingFacts facts = making.facts;
  if (!model.makes_portals()) return facts;
  facts.asked = model.asked;
  for (std::size_t c = 0; c < making.worked.cut_count; ++c) {
    const SkinCut& cut = making.worked.cuts[c];
    if (cut.portal < facts.made) continue;
    facts.portal[cut.portal].is_cut = true;
    facts.portal[cut.portal].is_spread = facts.portal[cut.portal].is_spread || cut.is_spread;
  }
  return facts;
}

}  // namespace carpus::simulation
