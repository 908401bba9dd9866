// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Primary beam: exp(-attenuation) times a mild fall-off towards the rim.
// 2. Scatter: a fixed share of the primary, spread over centimetres.
// 3. Photons: normal with variance equal to the mean, plus the electronics' noise; one generator a
//    row, so that the picture does not depend on threads.
// 4. The receptor's point spread.
// 5. Display: logarithm, regional equalisation, window from quantiles that metal does not move,
// unsharp mask, grey.
#include "fluoroscopy/detector.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/check.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "core/units.hpp"
#include "fluoroscopy/detail/blur.hpp"

namespace carpus::fluoroscopy {
namespace {

constexpr double kTubeOutputMicrograyPerMas = 40.0;  ///< at 1 m and 60 kV; engineering value
constexpr double kTubeReferenceKv = 60.0;
constexpr double kOneMeterMm = 1000.0;
/// Photons per mm2 and microgray at 60 kV behind a hand, about [iec62220dqe]'s 30 174 for RQA5.
constexpr double kPhotonsPerMm2Microgray = 30000.0;
constexpr double kDetectiveEfficiency = 0.65;  ///< of a caesium iodide flat panel at low frequency
constexpr double kElectronicNoisePhotons = 6.0;
constexpr double kScatterToPrimary = 0.18;  ///< a hand without a grid, engineering value
constexpr double kScatterSpreadMm = 12.0;
constexpr double kRimFallOff = 0.12;      ///< of the beam at the field's rim, heel and distance
constexpr double kReceptorBlurMm = 0.14;  ///< deviation of the point spread
constexpr double kEdgeScaleMm = 0.7;      ///< of the console's edge enhancement
constexpr float kEdgeGain = 0.6F;
constexpr double kRegionScaleMm = 9.0;  ///< of the console's equalisation of dark and light regions
constexpr float kRegionGain = 0.35F;    ///< share of the regional mean that is taken out
constexpr std::size_t kRowGrain = 16;

/// Of the open beam at the receptor.
double air_kerma_microgray(const CArmGeometry& geometry, double tube_kv, double mas) noexcept {
  const double kv = tube_kv / kTubeReferenceKv;
  const double nearer = kOneMeterMm / geometry.source_to_receptor_mm;
  return kTubeOutputMicrograyPerMas * kv * kv * mas * nearer * nearer;
}

std::size_t pixel_count(const AttenuationMap& map) {
  return static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
}

/// The beam that reaches the receptor, relative to its centre without an object.
std::vector<float> primary_beam(const AttenuationMap& map) {
  std::vector<float> primary(pixel_count(map), 0.0F);
  const auto width = static_cast<std::size_t>(map.width);
  parallel_for(static_cast<std::size_t>(map.height), kRowGrain,
               [&](std::size_t from, std::size_t to) {
                 for (std::size_t j = from; j < to; ++j) {
                   const double y = 2.0 * (static_cast<double>(j) + 0.5) / map.height - 1.0;
                   for (std::size_t i = 0; i < width; ++i) {
                     const float attenuation = map.values[j * width + i];
                     if (std::isnan(attenuation)) continue;
                     const double x = 2.0 * (static_cast<double>(i) + 0.5) / map.width - 1.0;
                     const auto profile = static_cast<float>(1.0 - kRimFallOff * (x * x + y * y));
                     primary[j * width + i] = profile * std::exp(-attenuation);
                   }
                 }
               });
  return primary;
}

void add_quantum_noise(std::vector<float>& signal,
                       const AttenuationMap& map,
                       double photons,
                       std::uint64_t seed) {
  const auto width = static_cast<std::size_t>(map.width);
  parallel_for(
      static_cast<std::size_t>(map.height), kRowGrain, [&](std::size_t from, std::size_t to) {
        for (std::size_t j = from; j < to; ++j) {
          Rng rng(Rng(seed ^ (j * 0x9E3779B97F4A7C15ULL)).next());
          for (std::size_t i = 0; i < width; ++i) {
            const double mean = photons * static_cast<double>(signal[j * width + i]);
            if (!(mean > 0)) continue;
            const double deviation =
                std::sqrt(mean + kElectronicNoisePhotons * kElectronicNoisePhotons);
            signal[j * width + i] =
                static_cast<float>(std::max(0.0, mean + deviation * rng.normal()) / photons);
          }
        }
      });
}

/// Attenuation as the console estimates it from the signal.
std::vector<float> logarithm(std::span<const float> signal, const AttenuationMap& map) {
  constexpr float kDarkest = 1e-3F;  // a fully blocked pixel, so that the logarithm stays finite
  std::vector<float> result(signal.size(), 0.0F);
  for (std::size_t i = 0; i < signal.size(); ++i) {
    if (!std::isnan(map.values[i])) result[i] = -std::log(std::max(signal[i], kDarkest));
  }
  return result;
}

/// Takes a share of the regional mean out, so that bones that lie over each other keep their edges;
/// the collimated rim does not count.
void equalize(std::vector<float>& attenuation, const AttenuationMap& map, double sigma_px) {
  std::vector<float> seen(attenuation.size(), 0.0F);
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = std::isnan(map.values[i]) ? 0.0F : 1.0F;
  const std::vector<float> sum = detail::blur_wide(attenuation, map.width, map.height, sigma_px);
  const std::vector<float> weight = detail::blur_wide(seen, map.width, map.height, sigma_px);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i] > 0) attenuation[i] -= kRegionGain * sum[i] / std::max(weight[i], 1e-3F);
  }
}

struct Window {
  float bright;  ///< attenuation shown brightest
  float dark;    ///< attenuation shown darkest
};

/// The window that shows soft tissue bright and the densest bone nearly black. Metal is left out:
/// it saturates and must not wash out the bone.
Window choose_window(const std::vector<float>& attenuation, const AttenuationMap& map) {
  constexpr float kMetal = 0.02F;     // more than rounding
  constexpr float kLeastSpan = 0.8F;  // keeps an empty field from being stretched into noise
  std::vector<float> seen;
  seen.reserve(attenuation.size());
  for (std::size_t i = 0; i < attenuation.size(); ++i) {
    const bool is_metal = !map.metal.empty() && map.metal[i] > kMetal;
    if (!std::isnan(map.values[i]) && !is_metal) seen.push_back(attenuation[i]);
  }
  if (seen.empty()) return {0.0F, kLeastSpan};
  const auto quantile = [&](double q) {
    const auto at = static_cast<std::ptrdiff_t>(q * static_cast<double>(seen.size() - 1));
    std::nth_element(seen.begin(), seen.begin() + at, seen.end());
    return seen[static_cast<std::size_t>(at)];
  };
  const float bright = quantile(0.02);
  // Room below the densest bone, so that metal over it is still darker.
  constexpr float kRoomForMetal = 1.12F;
  const float dark = bright + kRoomForMetal * (quantile(0.98) - bright);
  return {bright, std::max(dark, bright + kLeastSpan)};
}

}  // namespace

double dose_area_product_cgy_cm2(const CArmGeometry& geometry, const Exposure& exposure) noexcept {
  const double radius_cm = geometry.field_mm / 2 / 10;
  constexpr double kCentigrayPerMicrogray = 1e-4;
  return air_kerma_microgray(geometry, exposure.tube_kv, exposure.beam_mas) *
         kCentigrayPerMicrogray * kPi * radius_cm * radius_cm;
}

double open_beam_photons(const CArmGeometry& geometry, const Exposure& exposure) noexcept {
  return air_kerma_microgray(geometry, exposure.tube_kv, exposure.held_mas) *
         kPhotonsPerMm2Microgray * geometry.pixel_mm() * geometry.pixel_mm() * kDetectiveEfficiency;
}

std::vector<float> detect(const AttenuationMap& map,
                          const CArmGeometry& geometry,
                          const Exposure& exposure) {
  CARPUS_CHECK(map.values.size() == pixel_count(map));
  std::vector<float> signal = primary_beam(map);
  const std::vector<float> scatter =
      detail::blur_wide(signal, map.width, map.height, kScatterSpreadMm / geometry.pixel_mm());
  for (std::size_t i = 0; i < signal.size(); ++i) {
    if (std::isnan(map.values[i])) continue;
    signal[i] = (signal[i] + static_cast<float>(kScatterToPrimary) * scatter[i]) /
                static_cast<float>(1.0 + kScatterToPrimary);
  }
  add_quantum_noise(signal, map, open_beam_photons(geometry, exposure), exposure.seed);
  return detail::blur_gaussian(signal, map.width, map.height,
                               kReceptorBlurMm / geometry.pixel_mm());
}

Image display(std::span<const float> signal,
              const AttenuationMap& map,
              const CArmGeometry& geometry,
              const Exposure& exposure) {
  CARPUS_CHECK(map.values.size() == pixel_count(map) && signal.size() == map.values.size());
  std::vector<float> attenuation = logarithm(signal, map);
  equalize(attenuation, map, kRegionScaleMm / geometry.pixel_mm());
  const std::vector<float> smooth =
      detail::blur_gaussian(attenuation, map.width, map.height, kEdgeScaleMm / geometry.pixel_mm());
  const Window window = choose_window(attenuation, map);
  Image image{map.width, map.height, std::vector<std::uint8_t>(signal.size(), 0),
              geometry.pixel_mm(), dose_area_product_cgy_cm2(geometry, exposure)};
  constexpr float kWhite = 245.0F;
  constexpr float kBlack = 12.0F;
  for (std::size_t i = 0; i < attenuation.size(); ++i) {
    if (std::isnan(map.values[i])) continue;
    const float sharp = attenuation[i] + kEdgeGain * (attenuation[i] - smooth[i]);
    const float t = (sharp - window.bright) / (window.dark - window.bright);
    // Slightly S-shaped: soft tissue stays light and quiet, cortex separates from spongy bone.
    const float u = std::clamp(t, 0.0F, 1.0F);
    const float darkness = 0.55F * u + 0.45F * u * u * (3.0F - 2.0F * u);
    const float grey = exposure.inverted ? kBlack + (kWhite - kBlack) * darkness
                                         : kWhite - (kWhite - kBlack) * darkness;
    image.grey[i] = static_cast<std::uint8_t>(std::lround(grey));
  }
  return image;
}

}  // namespace carpus::fluoroscopy
