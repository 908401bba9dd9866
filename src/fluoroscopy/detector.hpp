// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From attenuation to the picture on a mini C-arm's screen: beam, scatter, quantum noise, blur, and
// the automatic window.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fluoroscopy/c_arm.hpp"

namespace carpus::fluoroscopy {

/// What the tube is set to for one shot, and how the picture is shown.
struct Exposure {
  double tube_kv = 60.0;
  double beam_mas = 0.5;   ///< tube current times time with the beam on: 0.1 mA for 5 s of looking
  double held_mas = 0.04;  ///< the part that the held picture averages: its last 0.4 s
  bool inverted = false;   ///< false: bone dark on a bright field, as fluoroscopy shows it
  std::uint64_t seed = 1;  ///< of the quantum noise
};

/// Grey values, row by row from the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> grey;
  double pixel_mm = 0.0;  ///< at the receptor
  double dose_cgy_cm2 = 0.0;
};

/// Dose-area product of a shot [cGy cm2]: tube output at 1 m (40 uGy per mAs at 60 kV, rising with
/// the square of the voltage) times `beam_mas` times the field's area projected to 1 m. It does not
/// depend on where along the beam it is taken. A shot of the default exposure is 0.50 cGy cm2 in
/// the 8 cm field. Output, current and seconds are engineering values, to be replaced by measured
/// ones.
[[nodiscard]] double dose_area_product_cgy_cm2(const CArmGeometry& geometry,
                                               const Exposure& exposure) noexcept;

/// Mean number of photons that the held picture detects in one pixel of the open beam.
[[nodiscard]] double open_beam_photons(const CArmGeometry& geometry,
                                       const Exposure& exposure) noexcept;

/// Attenuation of everything in the beam, one value a pixel; NaN where the collimator covers it.
struct AttenuationMap {
  int width = 0;
  int height = 0;
  std::vector<float> values;
  std::vector<float> metal;  ///< the share of each value that is metal's; empty for none at all
};

/// Signal of each pixel relative to the open beam: exp(-attenuation) under the beam's profile, with
/// scatter, quantum noise and the receptor's blur; 0 under the collimator.
[[nodiscard]] std::vector<float> detect(const AttenuationMap& map,
                                        const CArmGeometry& geometry,
                                        const Exposure& exposure);

/// The picture that the console makes of a signal: logarithm, window chosen from the picture
/// itself, slight edge enhancement, 8-bit grey. The collimated rim is black either way.
[[nodiscard]] Image display(std::span<const float> signal,
                            const AttenuationMap& map,
                            const CArmGeometry& geometry,
                            const Exposure& exposure);

}  // namespace carpus::fluoroscopy
