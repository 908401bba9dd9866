// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a fingertip feels through the skin: how deep bone lies under it, whether a taut tendon runs
// there. It follows from the case alone; where a portal is, it does not tell.
#include <algorithm>
#include <array>

#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::SkinPlace;

namespace {

constexpr double kStepMm = 0.6;
constexpr double kOnBoneMm = 0.3;
constexpr double kPadMm = 2.0;       // from a pad's middle to where it is felt with too [E]
constexpr double kFirmShare = 0.05;  // of the way, once there is no more to sink in
constexpr double kCordIsFirm = 0.6;  // [E]

}  // namespace

double World::State::bone_below_mm(const Vec3& skin,
                                   const Vec3& normal,
                                   double deepest_mm) const noexcept {
  double deep = 0.0;
  while (deep < deepest_mm) {
    const Touched bone = surface_at(skin - normal * deep);
    if (bone.body != kNoBody && bone.distance_mm <= kOnBoneMm) return deep;
    deep += bone.body == kNoBody ? kStepMm : std::max(kStepMm, bone.distance_mm - kOnBoneMm);
  }
  return deepest_mm;
}

/// By the mean under a pad: a fingertip dips into a gap, it does not fall into one.
FeltView World::State::felt_at(const Model& model, const SkinPlace& at) noexcept {
  const procedure::PortalMaking& figures = *model.procedure.making;
  const Vec3 aside = any_perpendicular(at.normal);
  const Vec3 across = cross(at.normal, aside);
  double deep = bone_below_mm(at.point, at.normal, figures.deepest_mm);
  for (const Vec3& off : {aside, -aside, across, -across}) {
    deep += bone_below_mm(at.point + off * kPadMm, at.normal, figures.deepest_mm);
  }
  deep /= 5.0;
  FeltView felt;
  felt.firm_share = 1.0 - deep / figures.deepest_mm;
  felt.felt = deep <= figures.bone_mm ? Felt::Bone : Felt::Soft;
  structures.follow({poses.data(), snapshot.body_count});
  const Vec3 below = at.point - at.normal * std::min(figures.cord_deep_mm, deep);
  for (std::size_t i = 0; i < structures.size(); ++i) {
    if (structures.kind(i) != anatomy::StructureKind::Tendon) continue;
    if (structures.gap_mm(i, at.point, below, figures.cord_mm + 1.0) > figures.cord_mm) continue;
    felt.felt = Felt::Cord;
    felt.firm_share = std::max(felt.firm_share, kCordIsFirm);
  }
  return felt;
}

/// By the share, until what lies beneath is firm.
double World::State::sinks_in_mm(const Model& model, const SkinPlace& at, double share) noexcept {
  const double wished = at.depth_mm * share;
  const FeltView felt = felt_at(model, at);
  const procedure::PortalMaking& figures = *model.procedure.making;
  const double most = figures.firm_share * figures.deepest_mm * (1.0 - felt.firm_share);
  return wished <= most ? wished : most + (wished - most) * kFirmShare;
}

Vec3 World::State::landmark_now(const Model& model, std::size_t which) const noexcept {
  const auto& mark = model.felt_first[which];
  return (poses[mark.body] * Point<frame::Bone>{mark.at}).v;
}

/// About the landmark and the portal's own place a square of cells each: a finger that only touches
/// once feels one of them.
void World::State::note_felt(const Model& model, const SkinPlace& at) noexcept {
  const std::size_t asked = asked_now();
  procedure::PortalMade& made = making.facts.portal[asked];
  if (making.facts.made > asked || made.passes > 0) return;
  const procedure::PortalMaking& figures = *model.procedure.making;
  const std::array<Vec3, 2> places{skin_at(model, landmark_now(model, asked)).point,
                                   marked_way(model, model.asked[asked]).skin};
  const Vec3 distal = (poses[model.map->forearm] * Direction<frame::Bone>{model.map->distal}).v;
  const Vec3 along = normalized_or(distal - at.normal * dot(distal, at.normal), distal);
  const Vec3 across = cross(at.normal, along);
  constexpr double kHalf = procedure::kCellsAcross / 2.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3 off = at.point - places[i];
    const double x = dot(off, along) / figures.cell_mm + kHalf;
    const double y = dot(off, across) / figures.cell_mm + kHalf;
    detail::FeltPlace& felt = making.felt[i];
    if (!(x >= 0.0 && y >= 0.0 && x < 2 * kHalf && y < 2 * kHalf)) {
      felt = {};
      continue;
    }
    const auto cell = static_cast<std::uint8_t>(static_cast<int>(x) * procedure::kCellsAcross +
                                                static_cast<int>(y));
    felt.ticks = felt.cell == cell ? felt.ticks + 1 : 0;
    felt.cell = cell;
    if (static_cast<double>(felt.ticks) * kTickSeconds < figures.cell_s) continue;
    std::uint16_t& cells = i == 0 ? made.landmark_felt : made.place_felt;
    cells = static_cast<std::uint16_t>(cells | 1U << cell);
  }
}

}  // namespace carpus::simulation
