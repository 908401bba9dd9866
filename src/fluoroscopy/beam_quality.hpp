// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How the tube's voltage changes what is seen: at a lower one bone and metal stand out more against
// soft tissue, at a higher one less.
#pragma once

namespace carpus::fluoroscopy {

/// Attenuation of each kind of matter, of what it is at 60 kV.
struct BeamQuality {
  double soft_tissue = 1.0;
  double bone = 1.0;  ///< of what bone attenuates above the soft tissue in its place
  double metal = 1.0;
};

/// One effective energy stands for the spectrum: 40 keV at 60 kV as everywhere in this module, 35
/// at 50 and 44 at 70 [engineering values]. Water, cortical bone (1.92 g/cm3) and iron are read
/// between the rows of [hubbell2004tables], logarithm against logarithm; titanium differs from iron
/// by less than 1 %. Between the three voltages straight, beyond them as at the nearest.
[[nodiscard]] BeamQuality beam_quality(double tube_kv) noexcept;

}  // namespace carpus::fluoroscopy
