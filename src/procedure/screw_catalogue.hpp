// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The screws on the tray: those that fit the 1.14 mm guide wire (data/screws.json, built in).
#pragma once

#include <span>
#include <string>

namespace carpus::procedure {

/// Diameter of the guide wire, 0.045 in [mm].
inline constexpr double kWireDiameterMm = 1.14;

/// One headless screw.
struct Screw {
  std::string family;  ///< "acutrak_2_mini"
  std::string name;    ///< "Acutrak 2 Mini 24 mm", for people
  double length_mm = 0.0;
  double tip_diameter_mm = 0.0;
  double tail_diameter_mm = 0.0;
  bool confirmed = false;  ///< checked against the maker's guide
};

/// All screws; a screw's index is its position here, the same in Command, Snapshot and recordings.
/// Read once, on the first call.
[[nodiscard]] std::span<const Screw> screw_catalogue();

/// Bone that is to cover the screw, 2 mm at each end [clinical: K, B3]: a screw is this much
/// shorter than the length measured along the wire between the cortices.
inline constexpr double kMeasuredMinusScrewMm = 4.0;

/// Index of the longest screw not longer than measured - 4 mm, the first of equals; -1 when even
/// the shortest is too long.
[[nodiscard]] int ideal_screw_index(std::span<const Screw> catalogue, double measured_mm) noexcept;

}  // namespace carpus::procedure
