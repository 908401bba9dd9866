// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/punches.hpp"

#include <algorithm>

namespace carpus::simulation::detail {
namespace {

constexpr double kGreatestMm = 10000.0;  // as far as anything is
constexpr std::uint64_t kAll = 0xFFFFFFFF;

}  // namespace

bool is_possible(const PunchState& state, std::size_t joints) noexcept {
  const procedure::PunchFacts& done = state.done;
  const std::uint64_t without_tissue =
      std::uint64_t{done.empty} + std::uint64_t{done.cartilage} + std::uint64_t{done.lining};
  if (done.unseen > done.bites || without_tissue > done.bites) return false;
  if (state.scuff_count != std::min<std::uint64_t>(done.cartilage & kAll, kMaxScuffs)) return false;
  for (std::size_t i = 0; i < state.scuffs.size(); ++i) {
    const ScuffView& each = state.scuffs[i];
    if (i >= state.scuff_count) {
      if (each != ScuffView{}) return false;
      continue;
    }
    if (each.joint >= joints) return false;
    if (!(squared_length(each.at_as_scanned) <= kGreatestMm * kGreatestMm)) return false;
  }
  return true;
}

bool are_closed_after(bool were_closed, bool has_jaws, Driver wished) noexcept {
  return has_jaws && (wished == Driver::Forward || (were_closed && wished == Driver::Off));
}

Vec3 jaws_middle(const instruments::Bite& bite, const Vec3& tip, const Vec3& shaft) noexcept {
  return tip + shaft * bite.behind_mm;
}

double from_jaws_mm(const Vec3& middle,
                    const Vec3& base,
                    const Vec3& inwards,
                    double height_mm,
                    double radius_mm) noexcept {
  const double along = std::clamp(dot(middle - base, inwards), 0.0, height_mm);
  return std::max(0.0, distance(middle, base + inwards * along) - radius_mm);
}

Bitten bitten(const instruments::Bite& bite,
              double tissue_mm,
              double cartilage_mm,
              double lining_mm) noexcept {
  const bool is_cartilage = cartilage_mm <= bite.reach_mm;
  if (tissue_mm <= bite.reach_mm && !(is_cartilage && cartilage_mm < tissue_mm)) {
    return Bitten::Tissue;
  }
  if (is_cartilage) return Bitten::Cartilage;
  return lining_mm <= bite.reach_mm ? Bitten::Lining : Bitten::Nothing;
}

void count_bite(procedure::PunchFacts& done, Bitten what, bool is_seen) noexcept {
  ++done.bites;
  if (!is_seen) ++done.unseen;
  if (what == Bitten::Nothing) ++done.empty;
  if (what == Bitten::Cartilage) ++done.cartilage;
  if (what == Bitten::Lining) ++done.lining;
}

void scuff(PunchState& state, std::uint8_t joint, const Vec3& at) noexcept {
  if (state.scuff_count >= kMaxScuffs) return;
  state.scuffs[state.scuff_count++] = {joint, at};
}

}  // namespace carpus::simulation::detail
