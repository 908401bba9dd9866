// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A punch in a joint: what its jaws close on, and what comes off or is harmed by that.
#include <array>
#include <cstdint>

#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using cases::TissuePiece;
using detail::Bitten;
using detail::Item;

namespace {

constexpr double kNowhereMm = 1e9;

}  // namespace

/// Only as they close: closed jaws bite nothing more until they were opened.
void World::State::watch_punch(const Model& model, std::uint8_t hand) noexcept {
  const Item* item = in_hand(hand);
  const bool has_bite = item != nullptr && kind_of(model, *item).bite;
  bool& is_closed = punch_state.are_closed[hand];
  const bool was_closed = is_closed;
  is_closed = detail::are_closed_after(was_closed, has_bite, spent.hands[hand].wish.driver);
  if (is_closed && !was_closed && scope_state.is_in_joint[hand]) close_punch(model, hand, *item);
}

/// The nearest piece that is left; the number of pieces where none is, and then it is nowhere.
World::State::NearPiece World::State::piece_by_jaws(const Model& model,
                                                    std::uint8_t joint,
                                                    const Vec3& middle) const noexcept {
  const std::span<const TissuePiece> pieces = model.pieces();
  NearPiece nearest{pieces.size(), kNowhereMm};
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].joint != joint || detail::is_gone(shaving_state, pieces, i)) continue;
    const PieceNow piece = piece_now(model, i);
    const double far =
        detail::from_jaws_mm(middle, piece.at, piece.inwards, piece.height_mm, pieces[i].radius_mm);
    if (far < nearest.distance_mm) nearest = {i, far};
  }
  return nearest;
}

/// That piece, and those that stand within half of the bite's width about it.
void World::State::bite_off(const Model& model,
                            std::uint8_t hand,
                            std::size_t which,
                            double width_mm) noexcept {
  const std::span<const TissuePiece> pieces = model.pieces();
  const Vec3 middle = piece_now(model, which).at;
  const double within = width_mm / 2;
  // Where they stood before any of them came off.
  std::array<bool, cases::kMaxPieces> are_bitten{};
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const bool is_there =
        pieces[i].joint == pieces[which].joint && !detail::is_gone(shaving_state, pieces, i);
    are_bitten[i] = is_there && distance(piece_now(model, i).at, middle) <= within;
  }
  bool is_sound = false;
  bool is_rim = false;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (!are_bitten[i]) continue;
    detail::take_piece(shaving_state, pieces, i);
    piece_came_off(model, i);
    is_sound = is_sound || !pieces[i].is_ill;
    is_rim = is_rim || (pieces[i].is_rim && !pieces[i].is_ill);
  }
  // A bite is told once, by its worst.
  if (is_sound) emit(EventKind::SoundTissueShaved, now.held[hand], is_rim ? 1 : 0, 0.0);
}

void World::State::close_punch(const Model& model, std::uint8_t hand, const Item& item) noexcept {
  const instruments::Bite& jaws = *kind_of(model, item).bite;
  const Vec3 middle = detail::jaws_middle(jaws, item.tip, item.shaft);
  const std::uint8_t joint = joint_of(model, scope_state.portal[hand]);
  const NearPiece piece = piece_by_jaws(model, joint, middle);
  const Touched bone = surface_at(middle);
  const double cartilage_mm =
      bone.body != kNoBody ? bone.distance_mm - model.cartilage_mm : kNowhereMm;
  // In the hole that was cut there is no lining, nothing but the bone beneath.
  const arthroscopy::OpenedSpace wall = joint_space_at(model, joint, middle);
  const bool is_in_hole = is_in_cut_disc(model, joint, middle, 0.0);
  const double lining_mm = wall.is_near && !is_in_hole ? -wall.distance_mm : kNowhereMm;
  const Bitten what = detail::bitten(jaws, piece.distance_mm, cartilage_mm, lining_mm);
  const bool is_seen = is_seen_beside(model, hand, middle) || is_seen_beside(model, hand, item.tip);
  detail::count_bite(punch_state.done, what, is_seen);
  switch (what) {
    case Bitten::Nothing:
      return;
    case Bitten::Tissue:
      return bite_off(model, hand, piece.which, jaws.width_mm);
    case Bitten::Cartilage: {
      // Cartilage is painted on the bone's surface.
      const Vec3 at = middle - bone.normal_in_patient * bone.distance_mm;
      detail::scuff(punch_state, joint, (inverses[bone.body] * Point<frame::Patient>{at}).v);
      note_scuff(hand, bone.body, at, procedure::Scuffing::Bitten);
      return emit(EventKind::TissueBitten, now.held[hand], 1, 0.0);
    }
    case Bitten::Lining:
      return emit(EventKind::TissueBitten, now.held[hand], 0, 0.0);
  }
}

void World::State::publish_punches() noexcept {
  ScopeView& view = snapshot.scope;
  for (std::uint8_t h = 0; h < kHands; ++h) {
    view.are_closed[h] = view.are_closed[h] || punch_state.are_closed[h];
  }
  view.scuffs = punch_state.scuffs;
  view.scuff_count = punch_state.scuff_count;
}

}  // namespace carpus::simulation
