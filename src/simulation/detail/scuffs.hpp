// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Cartilage that instruments scuffed, and where: what presses over 8 N, bites or shaves. Beside the
// state that is hashed: it follows from it, and decides nothing of what comes after.
#pragma once

#include <array>
#include <cstdint>

#include "procedure/operation_record.hpp"
#include "simulation/detail/smoothness.hpp"

namespace carpus::simulation::detail {

inline constexpr std::size_t kMaxScuffPlaces = 32;
/// An instrument that slides on so far under the same force scuffs another place [E].
inline constexpr double kScuffStepMm = 2.0;

/// Where something was last asked what it scuffs, Patient.
struct LastPlace {
  bool is_there = false;
  Vec3 at;
  bool operator==(const LastPlace&) const = default;
};

/// What a hand presses on with more than 8 N, until it lets up to 3 N.
struct HardPress {
  LastPlace last;
  bool is_told = false;    ///< it scuffs, and that is kept ...
  std::uint8_t place = 0;  ///< ... there in ScopeConduct::places
  bool operator==(const HardPress&) const = default;
};

/// How an arthroscopy was conducted, as far as no later tick asks.
struct ScopeConduct {
  std::array<MotionMeter, kHands> motion{};                   ///< by hand
  std::array<procedure::SmoothnessFacts, kHands> smoothness;  ///< of the scope, of what works
  std::array<HardPress, kHands> presses{};
  std::array<LastPlace, kHands> shaved{};
  std::array<procedure::CartilageScuff, kMaxScuffPlaces> places{};  ///< the first of `scuffs`
  std::uint32_t scuffs = 0;
  std::array<bool, kHands> is_on_capsule{};  ///< a scope pushes into it, until it lets up
  std::uint32_t capsule_pushes = 0;
};

template <Is<procedure::CartilageScuff> SomeScuff, typename Visitor>
void visit(SomeScuff& scuff, Visitor&& v) noexcept {
  v(scuff.tick);
  v(scuff.body);
  v(scuff.at);
  v(scuff.force_n);
  v(scuff.by);
  v(scuff.how);
}

template <Is<ScopeConduct> SomeConduct, typename Visitor>
void visit(SomeConduct& conduct, Visitor&& v) noexcept {
  for (std::size_t h = 0; h < kHands; ++h) {
    visit(conduct.motion[h], v);
    visit(conduct.smoothness[h], v);
    v(conduct.presses[h].last.is_there);
    v(conduct.presses[h].last.at);
    v(conduct.presses[h].is_told);
    v(conduct.presses[h].place);
    v(conduct.shaved[h].is_there);
    v(conduct.shaved[h].at);
    v(conduct.is_on_capsule[h]);
  }
  v(conduct.capsule_pushes);
  v(conduct.scuffs);
  for (auto& place : conduct.places) visit(place, v);
}

/// Whether a tick could have left it.
[[nodiscard]] bool is_possible(const ScopeConduct& conduct,
                               std::size_t bodies,
                               std::size_t instruments) noexcept;

/// A place more; of more than are kept, they are counted.
void add_scuff(ScopeConduct& conduct, const procedure::CartilageScuff& scuff) noexcept;

/// Whether that is another place than the last, which it is from then on.
[[nodiscard]] bool is_elsewhere(LastPlace& last, const Vec3& at) noexcept;

/// Whether an instrument that presses so hard is to be asked anew what it presses on.
[[nodiscard]] bool presses_anew(HardPress& press, const Vec3& tip, double force_n) noexcept;

}  // namespace carpus::simulation::detail
