// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/shaving.hpp"

#include <algorithm>

#include "arthroscopy/optics.hpp"

namespace carpus::simulation::detail {
namespace {

using cases::TissueKind;
using cases::TissuePiece;

constexpr std::array<std::uint16_t, cases::kTissueKinds> kTicksToCut{150, 450};  // [E]
constexpr double kBehindMouthMm = 0.3;  // so far behind its plane tissue is still drawn in

void count_gone(procedure::ShavingFacts& done, const TissuePiece& piece) noexcept {
  ++(piece.is_ill ? done.ill_removed : done.sound_removed);
  if (piece.is_rim && !piece.is_ill) ++done.rim_removed;
  done.ticks_since_cut = 0;
  done.seen_since = 0;
}

}  // namespace

std::uint16_t ticks_to_cut(TissueKind kind) noexcept {
  return kTicksToCut[static_cast<std::size_t>(kind)];
}

double left_share(const ShavingState& state,
                  std::span<const TissuePiece> pieces,
                  std::size_t i) noexcept {
  const double whole = ticks_to_cut(pieces[i].kind);
  return 1.0 - state.cut_ticks[i] / whole;
}

bool is_gone(const ShavingState& state,
             std::span<const TissuePiece> pieces,
             std::size_t i) noexcept {
  return state.cut_ticks[i] >= ticks_to_cut(pieces[i].kind);
}

ShavingState untouched(std::span<const TissuePiece> pieces) noexcept {
  ShavingState state;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const TissuePiece& piece = pieces[i];
    if (piece.is_gone) {
      state.cut_ticks[i] = ticks_to_cut(piece.kind);
      continue;
    }
    ++(piece.is_ill ? state.done.ill : state.done.sound);
    state.done.patches = std::max(state.done.patches, static_cast<std::uint8_t>(piece.patch + 1));
  }
  return state;
}

bool is_possible(const ShavingState& state, std::span<const TissuePiece> pieces) noexcept {
  procedure::ShavingFacts counted;
  for (std::size_t i = 0; i < state.cut_ticks.size(); ++i) {
    if (i >= pieces.size()) {
      if (state.cut_ticks[i] != 0) return false;
      continue;
    }
    const TissuePiece& piece = pieces[i];
    if (state.cut_ticks[i] > ticks_to_cut(piece.kind)) return false;
    const bool is_cut = is_gone(state, pieces, i);
    if (piece.is_gone) {
      if (!is_cut) return false;
      continue;
    }
    ++(piece.is_ill ? counted.ill : counted.sound);
    if (!is_cut) continue;
    ++(piece.is_ill ? counted.ill_removed : counted.sound_removed);
    if (piece.is_rim) ++counted.rim_removed;
  }
  for (const double deg : state.mouth_deg) {
    if (!(deg >= -180.0 && deg <= 180.0)) return false;
  }
  const procedure::ShavingFacts& done = state.done;
  return done.ill == counted.ill && done.sound == counted.sound &&
         done.ill_removed == counted.ill_removed && done.sound_removed == counted.sound_removed &&
         done.rim_removed == counted.rim_removed &&
         done.patches == untouched(pieces).done.patches && done.patches_seen >> done.patches == 0 &&
         done.unseen_ticks <= done.running_ticks &&
         (done.ticks_since_cut == 0 || counted.ill_removed + counted.sound_removed > 0) &&
         (done.seen_since == 0 || done.ticks_since_cut > 0);
}

MouthPlace mouth_place(const instruments::Mouth& mouth,
                       double radius_mm,
                       const Vec3& tip,
                       const Vec3& shaft,
                       double turn_deg,
                       const Vec3& level) noexcept {
  // As a scope looks that is turned so, straight across its shaft.
  const arthroscopy::Sight sight =
      arthroscopy::sight_of({90.0, 90.0}, {tip, shaft, turn_deg, 0.0}, level);
  return {tip + shaft * mouth.behind_mm + sight.axis * radius_mm, sight.axis};
}

double before_mouth_mm(const MouthPlace& mouth,
                       const Vec3& base,
                       const Vec3& inwards,
                       double height_mm,
                       double radius_mm) noexcept {
  const double along = std::clamp(dot(mouth.at - base, inwards), 0.0, height_mm);
  const Vec3 off = base + inwards * along - mouth.at;
  if (dot(off, mouth.towards) < -kBehindMouthMm - radius_mm) return kNotBefore;
  return std::max(0.0, length(off) - radius_mm);
}

bool cut_piece(ShavingState& state, std::span<const TissuePiece> pieces, std::size_t i) noexcept {
  if (is_gone(state, pieces, i)) return false;
  ++state.cut_ticks[i];
  if (!is_gone(state, pieces, i)) return false;
  count_gone(state.done, pieces[i]);
  return true;
}

void take_piece(ShavingState& state, std::span<const TissuePiece> pieces, std::size_t i) noexcept {
  if (is_gone(state, pieces, i)) return;
  state.cut_ticks[i] = ticks_to_cut(pieces[i].kind);
  count_gone(state.done, pieces[i]);
}

}  // namespace carpus::simulation::detail
