// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Tissue that can be taken away, whatever takes it: where its pieces are now, what they hide, how
// their patches come into view, and what follows when one comes off.
#include <cstdint>

#include "arthroscopy/disc_net.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using cases::TissueKind;
using cases::TissuePiece;
using detail::Item;
using detail::kDiscSheet;

namespace {

constexpr double kStandsMm = 0.5;    // a tuft's middle over its place, to be looked at
constexpr double kHidesNotMm = 1.5;  // what is looked at is not hidden by what is so near to it
constexpr double kThroughMm = 0.8;   // aside of a place that was cut there is a hole
constexpr double kDeepMm = 5.0;

}  // namespace

std::span<const TissuePiece> World::Model::pieces() const noexcept {
  return lesions ? std::span<const TissuePiece>(lesions->pieces) : std::span<const TissuePiece>{};
}

World::State::PieceNow World::State::piece_now(const Model& model, std::size_t i) const noexcept {
  const TissuePiece& piece = model.pieces()[i];
  const double left = detail::left_share(shaving_state, model.pieces(), i);
  const detail::BodyPose& pose = poses[piece.body];
  const Vec3 inwards = (pose * Direction<frame::Bone>{piece.inwards}).v;
  const Vec3 at = piece.kind == TissueKind::Disc && i < model.sheets[kDiscSheet].net.size()
                      ? sheets[kDiscSheet].at(i) + piece.inwards * arthroscopy::kHalfDiscMm
                      : piece.at;
  return {(pose * Point<frame::Bone>{at}).v, inwards, piece.height_mm * left};
}

/// Tufts stand before what lies behind them.
bool World::State::is_behind_tuft(const Model& model,
                                  std::uint8_t joint,
                                  const Vec3& eye,
                                  const Vec3& point) const noexcept {
  const std::span<const TissuePiece> pieces = model.pieces();
  const Vec3 way = point - eye;
  const double whole = squared_length(way);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].kind != TissueKind::Synovium || pieces[i].joint != joint) continue;
    const PieceNow tuft = piece_now(model, i);
    const Vec3 middle = tuft.at + tuft.inwards * (tuft.height_mm / 2);
    const double share = whole > 0 ? dot(middle - eye, way) / whole : 0.0;
    if (!(share > 0.0 && share < 1.0) || distance(middle, point) < kHidesNotMm) continue;
    const double thick = pieces[i].radius_mm * (tuft.height_mm > 0 ? 1.0 : 0.0);
    if (squared_length(eye + way * share - middle) < thick * thick) return true;
  }
  return false;
}

/// Where the disc was cut away a tip goes on, if what is left of it gives it room.
bool World::State::is_in_cut_disc(const Model& model,
                                  std::uint8_t joint,
                                  const Vec3& at,
                                  double radius_mm) const noexcept {
  const std::span<const TissuePiece> pieces = model.pieces();
  if (pieces.empty() || pieces.front().kind != TissueKind::Disc || pieces.front().joint != joint) {
    return false;
  }
  const Vec3 tip = (inverses[model.map->forearm] * Point<frame::Patient>{at}).v;
  bool is_over_hole = false;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Vec3 off = tip - sheets[kDiscSheet].at(i);
    const double high = dot(off, pieces[i].inwards);
    if (high > kDeepMm || high < -kDeepMm) continue;
    const double aside2 = squared_length(off) - high * high;
    if (sheets[kDiscSheet].is_cut(i)) {
      is_over_hole = is_over_hole || aside2 < kThroughMm * kThroughMm;
    } else if (aside2 < radius_mm * radius_mm) {
      return false;
    }
  }
  return is_over_hole;
}

/// Whether the scope in this hand sees the patch: one of three of its pieces that are left.
bool World::State::is_patch_seen(const Model& model,
                                 std::uint8_t hand,
                                 std::uint8_t patch) const noexcept {
  const Item& item = now.items[now.held[hand]];
  const auto sight = sight_of(model, item);
  if (!sight) return false;
  const std::uint8_t joint = joint_of(model, scope_state.portal[hand]);
  const std::span<const TissuePiece> pieces = model.pieces();
  std::array<std::uint8_t, cases::kMaxPieces> left{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const bool is_of_it = pieces[i].is_ill && pieces[i].patch == patch && pieces[i].joint == joint;
    if (is_of_it && !detail::is_gone(shaving_state, pieces, i)) {
      left[count++] = static_cast<std::uint8_t>(i);
    }
  }
  for (const std::size_t k : {std::size_t{0}, count / 2, count - 1}) {
    if (count == 0) return false;
    const PieceNow piece = piece_now(model, left[k]);
    if (sees(model, joint, *sight, piece.at + piece.inwards * kStandsMm)) return true;
  }
  return false;
}

/// One patch a tick.
void World::State::look_at_patches(const Model& model) noexcept {
  procedure::ShavingFacts& done = shaving_state.done;
  const auto patch = static_cast<std::uint8_t>(spent.tick % cases::kMaxPatches);
  if (patch >= done.patches) return;
  bool is_seen = false;
  for (std::uint8_t h = 0; h < kHands && !is_seen; ++h) {
    is_seen = scope_state.is_in_joint[h] && in_hand(h) != nullptr && is_patch_seen(model, h, patch);
  }
  std::uint32_t& ticks = shaving_state.patch_ticks[patch];
  ticks = is_seen ? ticks + static_cast<std::uint32_t>(cases::kMaxPatches) : 0;
  if (ticks >= detail::kSeenTicks) {
    done.patches_seen = static_cast<std::uint8_t>(done.patches_seen | 1U << patch);
  }
}

/// What follows: the sheet is without it, or it bleeds.
void World::State::piece_came_off(const Model& model, std::size_t which) noexcept {
  const TissuePiece& piece = model.pieces()[which];
  if (piece.kind == TissueKind::Disc) {
    sheets[kDiscSheet].cut(model.sheets[kDiscSheet].net, which);
  } else if (model.procedure.fluid && piece.joint == fluid.joint) {  // the disc has no vessels
    bleed_into_joint(model, detail::FluidTable::generic().bleeding.tuft_ml_per_s);
  }
}

void World::State::take_tissue_away(const Model& model) noexcept {
  if (model.map == nullptr || model.pieces().empty()) return;
  look_at_patches(model);
  procedure::ShavingFacts& done = shaving_state.done;
  if (done.ill_removed + done.sound_removed > 0) ++done.ticks_since_cut;
  for (std::uint8_t h = 0; h < kHands; ++h) {
    const Item* item = in_hand(h);
    if (item != nullptr && is_running(model, h)) run_shaver(model, h, *item);
    if (model.has_punch) watch_punch(model, h);
  }
  if (done.ticks_since_cut < detail::kSeenTicks) return;
  for (std::size_t i = 0; i < model.map->points.size(); ++i) {
    // Both have lasted a second: it was seen since.
    if (scope_state.in_view_ticks[i] < detail::kSeenTicks) continue;
    done.seen_since |= 1U << model.map->points[i].number;
  }
}

/// Pieces that are gone leave the sheet without them; of a state that was read.
void World::State::cut_disc_as_left(const Model& model) noexcept {
  const std::span<const TissuePiece> pieces = model.pieces();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].kind == TissueKind::Disc && detail::is_gone(shaving_state, pieces, i)) {
      sheets[kDiscSheet].cut(model.sheets[kDiscSheet].net, i);
    }
  }
}

void World::State::publish_pieces(const Model& model) noexcept {
  ScopeView& view = snapshot.scope;
  const std::span<const TissuePiece> pieces = model.pieces();
  view.piece_count = static_cast<std::uint8_t>(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    // What is not gone shows: a hundredth at least.
    const double left = 100.0 * detail::left_share(shaving_state, pieces, i);
    view.pieces_left[i] = static_cast<std::uint8_t>(left > 0.0 ? left + 0.999 : 0.0);
  }
}

}  // namespace carpus::simulation
