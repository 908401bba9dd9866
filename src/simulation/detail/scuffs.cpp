// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/scuffs.hpp"

#include <algorithm>

#include "simulation/detail/scope_watch.hpp"

namespace carpus::simulation::detail {

bool is_possible(const ScopeConduct& conduct,
                 std::size_t bodies,
                 std::size_t instruments) noexcept {
  for (std::size_t h = 0; h < kHands; ++h) {
    const HardPress& press = conduct.presses[h];
    if (!is_possible(conduct.motion[h], conduct.smoothness[h])) return false;
    if (press.is_told && (press.place >= kMaxScuffPlaces || press.place >= conduct.scuffs)) {
      return false;
    }
  }
  for (std::size_t i = 0; i < conduct.places.size(); ++i) {
    const procedure::CartilageScuff& scuff = conduct.places[i];
    const bool is_sound = i < conduct.scuffs
                              ? scuff.body < bodies && scuff.by < instruments &&
                                    scuff.how <= procedure::Scuffing::Shaved && scuff.force_n >= 0.0
                              : scuff == procedure::CartilageScuff{};
    if (!is_sound) return false;
  }
  return true;
}

void add_scuff(ScopeConduct& conduct, const procedure::CartilageScuff& scuff) noexcept {
  if (conduct.scuffs < conduct.places.size()) conduct.places[conduct.scuffs] = scuff;
  ++conduct.scuffs;
}

bool is_elsewhere(LastPlace& last, const Vec3& at) noexcept {
  if (last.is_there && distance(last.at, at) < kScuffStepMm) return false;
  last = {true, at};
  return true;
}

bool presses_anew(HardPress& press, const Vec3& tip, double force_n) noexcept {
  if (!(force_n > kWarnN)) press = {};
  if (!(force_n > kInjuryN) || !is_elsewhere(press.last, tip)) return false;
  press.is_told = false;
  return true;
}

}  // namespace carpus::simulation::detail
