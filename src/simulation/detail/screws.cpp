// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A screw that lies in the scaphoid: it stops what comes against what of it stands out; its sites
// are seen as lesions are, and probed where the scope sees the probe's tip.
#include "cases/controlled_screw.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::Item;

namespace {

/// So near to its place a site is probed: an end is a spot, a millimetre about the screw, the
/// others are stretches of a surface [E].
constexpr double kAtEndMm = 3.0;
constexpr double kAtSurfaceMm = 4.0;
constexpr double kAtMetalMm = 0.3;
constexpr std::uint8_t kAllSites = (1U << cases::kScrewSites) - 1U;

std::uint8_t with(std::uint8_t bits, std::size_t at, bool is_set) noexcept {
  const auto bit = static_cast<std::uint8_t>(1U << at);
  return static_cast<std::uint8_t>(is_set ? bits | bit : bits & ~bit);
}

}  // namespace

/// How deep the round tip of what a hand holds is in the screw.
World::State::Wall World::State::metal_at(const Model& model,
                                          std::uint8_t hand,
                                          const Vec3& tip,
                                          const Vec3& shaft) const noexcept {
  if (!model.lesions || !model.lesions->screw) return {};
  const Item& item = now.items[now.held[hand]];
  if (!enters_joints(model, item) || !scope_state.is_in_joint[hand]) return {};
  const cases::ControlledScrew& screw = *model.lesions->screw;
  const double round_mm = kind_of(model, item).shape.front_z_mm();
  const Vec3 middle = (inverses[screw.body] * Point<frame::Patient>{tip + shaft * round_mm}).v;
  const cases::InScrew in = cases::in_screw(screw, middle, round_mm);
  return {in.depth_mm, (poses[screw.body] * Direction<frame::Bone>{in.out}).v};
}

std::uint8_t World::State::sites_seen() const noexcept {
  return static_cast<std::uint8_t>(scope_state.lesions_seen & kAllSites);
}

procedure::ScrewFacts World::State::screw_facts(const Model& model) const noexcept {
  if (!model.procedure.controls_screw) return {};
  procedure::ScrewFacts facts = screw_state.done;
  facts.seen = sites_seen();
  return facts;
}

void World::State::probe_screw(const Model& model, std::uint8_t hand, const Item& item) noexcept {
  if (!model.lesions || !model.lesions->screw) return;
  const bool is_on_metal = metal_at(model, hand, item.tip, item.shaft).depth_mm > -kAtMetalMm;
  if (!is_on_metal && !is_held_back(hand, item)) return;
  const std::uint8_t joint = joint_of(model, scope_state.portal[hand]);
  for (std::size_t site = 0; site < model.lesions->lesions.size(); ++site) {
    if (model.lesions->lesions[site].joint != joint) continue;
    if ((screw_state.done.probed >> site & 1U) != 0) continue;
    const double near_mm = site == 0 ? kAtEndMm : kAtSurfaceMm;
    if (distance(lesion_middle(model, site), item.tip) > near_mm) continue;
    if (!is_seen_beside(model, hand, now.items[now.held[hand]].tip)) return;
    screw_state.done.probed = with(screw_state.done.probed, site, true);
    emit(EventKind::ScrewProbed, now.held[hand], static_cast<std::int32_t>(site), 0.0);
  }
}

/// What was known when it was said: an answer that is given again later counts by what is known
/// then.
void World::State::note_screw_answer(const Model& model, std::size_t asked) noexcept {
  if (!model.procedure.controls_screw) return;
  procedure::ScrewFacts& done = screw_state.done;
  const std::uint8_t seen = sites_seen();
  const bool is_site = asked < cases::kScrewSites;
  const bool is_seen = is_site ? (seen >> asked & 1U) != 0 : seen == kAllSites;
  const bool is_probed = is_site ? (done.probed >> asked & 1U) != 0 : done.probed == kAllSites;
  done.answered_seen = with(done.answered_seen, asked, is_seen);
  done.answered_probed = with(done.answered_probed, asked, is_probed);
  if (!is_site) done.sites_at_decision = seen;
}

}  // namespace carpus::simulation
