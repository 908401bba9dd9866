// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Tissue that is to be taken away with a shaver: what a procedure declares, and what was done.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carpus::procedure {

/// Inflamed synovium; how much is drawn by the exercise's seed.
struct InflamedSynovium {
  std::array<std::uint8_t, 2> patches{};  ///< least and most
  std::array<std::uint8_t, 2> tufts{};    ///< of each
  std::vector<std::uint8_t> places;       ///< of the tour, about one of which each patch stands

  [[nodiscard]] bool operator==(const InflamedSynovium&) const = default;
};

/// A torn disc, whose edges are trimmed.
struct TornDisc {
  std::vector<std::string> tears;  ///< grades of data/pathology.json, one of them by the seed
  double frayed_mm = 0.0;          ///< so far about the tear its edges are loose
  double rim_mm = 0.0;             ///< of the disc's own edge that must stay

  [[nodiscard]] bool operator==(const TornDisc&) const = default;
};

/// One of the two.
struct Shaving {
  std::optional<InflamedSynovium> synovium;
  std::optional<TornDisc> disc;

  [[nodiscard]] bool operator==(const Shaving&) const = default;
};

/// What was taken away, by whatever did; and how a shaver ran. A tick is a millisecond.
struct ShavingFacts {
  std::uint16_t ill = 0;            ///< pieces that were to be taken away
  std::uint16_t ill_removed = 0;    ///< of them
  std::uint16_t sound = 0;          ///< pieces of the disc that were to stay
  std::uint16_t sound_removed = 0;  ///< of them
  std::uint16_t rim_removed = 0;    ///< of these those of the rim
  std::uint8_t patches = 0;
  std::uint8_t patches_seen = 0;      ///< bits: for a second
  std::uint32_t running_ticks = 0;    ///< in a joint
  std::uint32_t unseen_ticks = 0;     ///< ... its mouth not seen by the scope
  std::uint32_t cartilage_ticks = 0;  ///< ... its mouth on cartilage
  std::uint32_t lining_ticks = 0;     ///< ... on ligament, capsule or disc that is to stay
  std::uint32_t scope_ticks = 0;      ///< ... against the scope
  std::uint32_t way_ticks = 0;        ///< running in the way in
  std::uint32_t ticks_since_cut = 0;  ///< since the last piece came off, 0 before any
  std::uint32_t seen_since = 0;       ///< places of the tour, by number, since then
  bool operator==(const ShavingFacts&) const = default;
};

}  // namespace carpus::procedure
