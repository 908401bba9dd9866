// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a scripted arthroscopist goes on the tour: from portal to portal, to each place from where it
// is seen, the probe after the scope.
#include <algorithm>
#include <utility>

#include "arthroscopy/opened_space.hpp"
#include "trainee/arthroscopist.hpp"

namespace carpus::trainee {
namespace {

constexpr std::uint8_t kScope = 0;  // hands
constexpr std::uint8_t kProbe = 1;
constexpr double kInsideMm = 2.0;  // beyond the capsule, to begin with
constexpr double kBackMm = -2.5;   // so far from the capsule a scope has fallen out

Tick ticks_of(double s) { return static_cast<Tick>(std::max(0.0, s) / kTickSeconds); }

}  // namespace

/// Each point is looked at by the first of its portals that shows it; portals in the map's order.
std::vector<ScriptedArthroscopist::Stop> ScriptedArthroscopist::stops() const {
  std::vector<Stop> all(map_.portals.size());
  for (std::size_t i = 0; i < map_.points.size(); ++i) {
    for (const std::uint8_t portal : map_.points[i].by) {
      if (!view_of(portal, place_of(i), in_portal(portal, kInsideMm)).is_found) continue;
      all[portal].points.push_back(i);
      all[portal].is_probing = all[portal].is_probing || map_.points[i].is_probed;
      break;
    }
  }
  std::vector<Stop> used;
  for (std::uint8_t portal = 0; portal < all.size(); ++portal) {
    if (all[portal].points.empty()) continue;
    all[portal].look = portal;
    all[portal].work = work_portal(portal);
    used.push_back(std::move(all[portal]));
  }
  return used;
}

/// The tour's next portal into the same joint; its own where there is no other.
std::uint8_t ScriptedArthroscopist::work_portal(std::uint8_t look) const {
  const auto count = static_cast<std::uint8_t>(map_.portals.size());
  for (std::uint8_t by = 1; by < count; ++by) {
    const auto other = static_cast<std::uint8_t>((look + by) % count);
    const cases::Portal& portal = map_.portals[other];
    if (portal.is_usual && portal.joint == map_.portals[look].joint) return other;
  }
  return look;
}

void ScriptedArthroscopist::look_at(const Stop& stop, const Vec3& place) {
  for (int i = 0; i < skill_.wanderings; ++i) {
    look(stop.look, {planned_[kScope] + error(2.0), rng_.uniform(-180.0, 180.0), true});
    tasks_.back().dwell = ticks_of(0.4);
  }
  if (rng_.uniform(0.0, 1.0) < skill_.falls_out) {
    go(kScope, through(stop.look, in_portal(stop.look, kBackMm)), skill_.reaction_s);
    go(kScope, through(stop.look, in_portal(stop.look, kInsideMm)), skill_.reaction_s);
  }
  const View view = view_of(stop.look, place, planned_[kScope]);
  if (view.is_found) look(stop.look, view);
}

void ScriptedArthroscopist::probe(const Stop& stop, const Vec3& at) {
  const Vec3 down =
      normalized_or(space_at(map_.portals[stop.look].joint, at).outwards, map_.distal);
  go(kProbe, through(stop.work, at + down * skill_.presses_mm), skill_.dwell_s);
  go(kProbe, through(stop.work, in_portal(stop.work, kInsideMm)), skill_.reaction_s);
}

/// Once round, from two depths: what was planned for and missed may be found so.
void ScriptedArthroscopist::look_round(const Stop& stop) {
  for (const double deep : {2.0, 4.0}) {
    for (double turn = -180.0; turn < 180.0; turn += 45.0) {
      look(stop.look, {in_portal(stop.look, deep), turn, true});
    }
  }
}

void ScriptedArthroscopist::plan_tour() {
  std::uint8_t looked_round = 0;  // joints
  bool has_probe = false;
  for (const Stop& stop : stops()) {
    // The probe leaves a portal that the scope needs.
    if (in_[kProbe] != procedure::kNoBody) draw_out(kProbe);
    enter(kScope, stop.look);
    if (stop.is_probing && stop.work != stop.look) {
      if (!has_probe) {
        take_probe(stop.work);
        has_probe = true;
      }
      enter(kProbe, stop.work);
    }
    for (const std::size_t point : stop.points) {
      look_at(stop, place_of(point));
      if (map_.points[point].is_probed && in_[kProbe] == stop.work) probe(stop, place_of(point));
    }
    const auto joint_bit = static_cast<std::uint8_t>(1U << map_.portals[stop.look].joint);
    if ((looked_round & joint_bit) == 0) look_round(stop);
    looked_round = static_cast<std::uint8_t>(looked_round | joint_bit);
  }
}

}  // namespace carpus::trainee
