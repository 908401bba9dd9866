// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Every lean that the table allows, and for each every mark of a grid about the usual one: a way in
// there, what it cuts, whether it is between its structures; the best by TriedWay's order is kept.
#include "arthroscopy/detail/portal_search.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "anatomy/structure_table.hpp"
#include "arthroscopy/make_map.hpp"
#include "core/parallel.hpp"

namespace carpus::arthroscopy::detail {
namespace {

using anatomy::StructureKind;

constexpr double kRadPerDeg = 3.14159265358979323846 / 180;
/// A way is followed from so far outside its mark, which lies as deep as the bone that is felt.
constexpr double kOverMarkMm = 9.0;
constexpr double kTiltStepDeg =
    5;  // both steps twice as long for what the tour does without, where it is roomy
constexpr double kSearchStepMm = 0.5;
/// A nerve or an artery is to lie so far from a way: a tip slips into its hole 2.5 mm beside it
/// [E].
constexpr double kVitalClearMm = 2.5;
/// Twice what a scope takes up: more room is worth nothing [E].
constexpr double kEnoughRoomMm = 2.0;
/// Room for which a mark a millimetre farther off is taken [E].
constexpr double kPerMmOff = 0.03;
constexpr double kPerMmTendon = 0.6;   // and for one into a tendon, which is spread aside [E]
constexpr double kPerMmPast = 0.4;     // and for one past what the portal is to look at first [E]
constexpr double kPerDegLeant = 0.02;  // and for a degree [E]

constexpr std::array kVital{StructureKind::Nerve, StructureKind::Artery};
constexpr std::array kSpread{StructureKind::Tendon};

bool is_searched_finely(const TabledPortal& portal) { return portal.is_usual || portal.is_narrow; }

/// Every lean of a way in that is tried: towards the forearm, about it [rad].
std::vector<std::array<double, 2>> leans_of(const TabledPortal& portal) {
  std::vector<std::array<double, 2>> leans;
  const double step = is_searched_finely(portal) ? kTiltStepDeg : 2 * kTiltStepDeg;
  for (double deg = portal.proximal_deg[0]; deg <= portal.proximal_deg[1]; deg += step) {
    for (double turn = portal.ulnar_deg[0]; turn <= portal.ulnar_deg[1]; turn += step) {
      leans.push_back({deg * kRadPerDeg, turn * kRadPerDeg});
    }
  }
  return leans;
}

}  // namespace

bool TriedWay::has_room() const { return way.room_mm >= kLeastRoomMm; }

double TriedWay::value() const {
  return std::min(way.room_mm, kEnoughRoomMm) - kPerMmOff * off_mm - kPerDegLeant * leant_deg -
         kPerMmTendon * cut_mm[1] - kPerMmPast * past_mm;
}

bool TriedWay::operator<(const TriedWay& other) const {
  return std::tuple(has_room(), is_apart, is_between, -cut_mm[0], value()) <
         std::tuple(other.has_room(), other.is_apart, other.is_between, -other.cut_mm[0],
                    other.value());
}

std::optional<TriedWay> PortalSearch::best_way(const TabledPortal& portal,
                                               const cases::JointSpace& joint,
                                               const Vec3& nominal,
                                               const std::optional<Vec3>& ahead) const {
  const std::vector<Lean> leans = leans_of(portal);
  std::vector<std::optional<TriedWay>> bests(leans.size());
  parallel_for(leans.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      bests[i] = best_by(portal, joint, nominal, ahead, leans[i]);
    }
  });
  std::optional<TriedWay> best;
  for (const std::optional<TriedWay>& tried : bests) {  // of equal ones the first lean's
    if (tried && (!best || *best < *tried)) best = tried;
  }
  return best;
}

std::optional<TriedWay> PortalSearch::best_by(const TabledPortal& portal,
                                              const cases::JointSpace& joint,
                                              const Vec3& nominal,
                                              const std::optional<Vec3>& ahead,
                                              const Lean& lean) const {
  std::optional<TriedWay> best;
  const auto& [tilt, turn] = lean;
  const double middle_rad = (portal.ulnar_deg[0] + portal.ulnar_deg[1]) / 2 * kRadPerDeg;
  const Vec3 across{0, std::cos(middle_rad), -std::sin(middle_rad)};
  const Vec3 before = Vec3{0, std::sin(middle_rad), std::cos(middle_rad)} * -kOverMarkMm;
  const double step_mm = is_searched_finely(portal) ? kSearchStepMm : 2 * kSearchStepMm;
  const Vec3 inwards =
      axes_.way({std::sin(tilt), std::cos(tilt) * std::sin(turn), std::cos(tilt) * std::cos(turn)});
  for (double x = -portal.search_mm[0]; x <= portal.search_mm[0]; x += step_mm) {
    for (double y = -portal.search_mm[1]; y <= portal.search_mm[1]; y += step_mm) {
      const Vec3 mark = nominal + Vec3{x, 0, 0} + across * y;
      const auto way = way_in(joint, bones_, axes_.point(mark + before), inwards,
                              best && best->has_room() ? kLeastRoomMm : 0.0);
      if (!way) continue;
      const bool is_apart = !shares_hole(*way);
      if (!is_apart && !portal.is_usual) continue;
      TriedWay tried{*way,
                     mark,
                     std::hypot(x, y),
                     std::abs(turn - middle_rad) / kRadPerDeg,
                     ahead ? past_mm(*way, *ahead) : 0.0,
                     is_apart};
      look_beside(portal, axes_.way(across), tried);
      if (!best || *best < tried) best = tried;
    }
  }
  return best;
}

void PortalSearch::look_beside(const TabledPortal& portal,
                               const Vec3& along,
                               TriedWay& tried) const {
  if (!tried.has_room()) return;
  const Vec3& capsule = tried.way.capsule;
  const Vec3& inwards = tried.way.inwards;
  tried.is_between =
      bones_.is_beyond(portal.between[0], along, capsule, inwards) &&
      (portal.between[1].empty() || bones_.is_beyond(portal.between[1], -along, capsule, inwards));
  tried.cut_mm = {bones_.cut_mm(kVital, kVitalClearMm, capsule, inwards),
                  bones_.cut_mm(kSpread, kLeastRoomMm, capsule, inwards)};
}

bool PortalSearch::shares_hole(const WayIn& way) const {
  return std::any_of(taken_.begin(), taken_.end(),
                     [&](const WayIn& other) { return share_hole(way, other); });
}

}  // namespace carpus::arthroscopy::detail
