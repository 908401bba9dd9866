// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A shaver that runs in a joint: what it takes away, and what it runs against that is to stay.
#include <cstdint>

#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using cases::TissuePiece;
using detail::Item;
using detail::kNoPortal;
using detail::MouthPlace;

namespace {

constexpr double kOnWallMm = 0.45;  // the mouth's middle so near to the wall lies on it [E]
constexpr double kTurnedThereCosine = 0.2;
constexpr double kCartilageMm = 1.2;  // bone so near behind it: cartilage lies between [B11]
constexpr double kScopeMm = 0.6;      // the scope's surface so near is run against [E]
constexpr double kScopeShaftMm = 40.0;
constexpr std::uint32_t kHarmTicks = 250;  // of running against what stays it is told [E]

/// Told once, when it begins to harm.
bool begins_to_harm(std::uint32_t ticks) noexcept { return ticks == kHarmTicks; }

}  // namespace

/// What is in the mouth, the nearest; the number of pieces where nothing is.
std::size_t World::State::piece_in_mouth(const Model& model,
                                         std::uint8_t joint,
                                         const MouthPlace& mouth,
                                         double reach_mm) const noexcept {
  const std::span<const TissuePiece> pieces = model.pieces();
  std::size_t nearest = pieces.size();
  double least = reach_mm;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].joint != joint || detail::is_gone(shaving_state, pieces, i)) continue;
    const PieceNow piece = piece_now(model, i);
    const double far = detail::before_mouth_mm(mouth, piece.at, piece.inwards, piece.height_mm,
                                               pieces[i].radius_mm);
    if (far >= least) continue;
    least = far;
    nearest = i;
  }
  return nearest;
}

/// Against what is to stay: cartilage where bone is near, else ligament, capsule or disc.
void World::State::note_shaver_harm(const Model& model,
                                    std::uint8_t hand,
                                    std::uint8_t joint,
                                    const MouthPlace& mouth) noexcept {
  procedure::ShavingFacts& done = shaving_state.done;
  const arthroscopy::OpenedSpace wall = joint_space_at(model, joint, mouth.at);
  const bool is_on_wall = wall.is_near && wall.distance_mm > -kOnWallMm &&
                          wall.distance_mm < kOnWallMm &&
                          dot(wall.outwards, mouth.towards) > kTurnedThereCosine;
  const Touched bone = surface_at(mouth.at);
  // In the hole that was cut there is nothing but the bone beneath.
  const bool is_in_hole = is_in_cut_disc(model, joint, mouth.at, 0.0);
  const double near_mm = is_in_hole ? kOnWallMm : kCartilageMm;
  const bool is_cartilage = bone.body != kNoBody && bone.distance_mm < near_mm;
  if (is_in_hole ? !is_cartilage : !is_on_wall) return;
  std::uint32_t& ticks = is_cartilage ? done.cartilage_ticks : done.lining_ticks;
  ++ticks;
  if (begins_to_harm(ticks)) {
    emit(EventKind::ShaverHarmed, now.held[hand], is_cartilage ? 1 : 0, 0.0);
  }
  if (!is_cartilage || ticks < kHarmTicks) return;
  if (!detail::is_elsewhere(conduct.shaved[hand], mouth.at)) return;
  note_scuff(hand, bone.body, mouth.at - bone.normal_in_patient * bone.distance_mm,
             procedure::Scuffing::Shaved);
}

void World::State::run_shaver(const Model& model, std::uint8_t hand, const Item& item) noexcept {
  procedure::ShavingFacts& done = shaving_state.done;
  if (!scope_state.is_in_joint[hand]) {
    if (scope_state.portal[hand] != kNoPortal) ++done.way_ticks;
    return;
  }
  ++done.running_ticks;
  const std::uint8_t joint = joint_of(model, scope_state.portal[hand]);
  const bool has_fluid = model.procedure.fluid.has_value() && joint == fluid.joint;
  if (has_fluid) draw_fluid(detail::FluidTable::generic().joint.shaver_ml_per_s);
  const instruments::Instrument& kind = kind_of(model, item);
  const double radius_mm = kind.shape.greatest_radius_mm();
  const Vec3 level = (poses[model.map->forearm] * Direction<frame::Bone>{model.map->distal}).v;
  const MouthPlace mouth = detail::mouth_place(*kind.mouth, radius_mm, item.tip, item.shaft,
                                               shaving_state.mouth_deg[hand], level);
  if (!is_seen_beside(model, hand, mouth.at) && !is_seen_beside(model, hand, item.tip)) {
    ++done.unseen_ticks;
  }
  const auto other = static_cast<std::uint8_t>(1U - hand);
  const Item* scope = in_hand(other);
  if (scope != nullptr && kind_of(model, *scope).optic && scope_state.is_in_joint[other]) {
    const double along = dot(mouth.at - scope->tip, scope->shaft);
    const double on = along < 0.0 ? 0.0 : (along > kScopeShaftMm ? kScopeShaftMm : along);
    const double off = distance(mouth.at, scope->tip + scope->shaft * on) -
                       kind_of(model, *scope).shape.greatest_radius_mm();
    if (off < kScopeMm && begins_to_harm(++done.scope_ticks)) {
      emit(EventKind::ShaverHarmed, now.held[hand], 2, 0.0);
    }
  }
  const std::size_t piece = piece_in_mouth(model, joint, mouth, kind.mouth->reach_mm);
  if (piece >= model.pieces().size()) return note_shaver_harm(model, hand, joint, mouth);
  if (!detail::cut_piece(shaving_state, model.pieces(), piece)) return;
  piece_came_off(model, piece);
  const TissuePiece& cut = model.pieces()[piece];
  if (!cut.is_ill) emit(EventKind::SoundTissueShaved, now.held[hand], cut.is_rim ? 1 : 0, 0.0);
}

bool World::State::is_running(const Model& model, std::uint8_t hand) const noexcept {
  const std::uint8_t held = now.held[hand];
  if (held >= kMaxItems || !kind_of(model, now.items[held]).mouth) return false;
  return spent.hands[hand].wish.driver == Driver::Forward;
}

void World::State::publish_shaving(const Model& model) noexcept {
  ScopeView& view = snapshot.scope;
  view.mouth_deg = shaving_state.mouth_deg;
  for (std::uint8_t h = 0; h < kHands; ++h) view.are_running[h] = is_running(model, h);
}

}  // namespace carpus::simulation
