// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Line integrals of X-ray attenuation through a CT, by Joseph's method [joseph1982improved]: one
// bilinear reading for each voxel plane that a ray crosses along its steepest axis. Air is skipped
// block by block without changing the result.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/grid.hpp"

namespace carpus::fluoroscopy {

/// Attenuation of tissue at the mini C-arm's effective energy, 40 keV, from the HU that a CT gives
/// at about 70 keV. Values: [hubbell2004tables].
inline constexpr double kWaterPerMm = 0.02683;     ///< [1/mm]
inline constexpr double kCorticalPerMm = 0.12778;  ///< [1/mm] at 1.92 g/cm3
inline constexpr double kCorticalHu = 1577.0;      ///< of the same bone at 70 keV
/// At and below this attenuation is nil, so that the noise of air adds nothing and air can be
/// skipped exactly; water stays exact, fat at -100 HU is 2 % low.
inline constexpr double kAirHu = -850.0;

/// Attenuation [1/mm] of a voxel: linear from air to water, then steeper, as the calcium of bone
/// counts for more at 40 keV than at the CT's energy.
[[nodiscard]] constexpr double attenuation_per_mm(double hu) noexcept {
  if (hu <= kAirHu) return 0.0;
  const double soft = kWaterPerMm * (hu - kAirHu) / -kAirHu;
  constexpr double kBoneSlope = (kCorticalPerMm - kWaterPerMm) / kCorticalHu;
  return hu <= 0 ? soft : kWaterPerMm + hu * kBoneSlope;
}

/// Integrates along rays. Keeps a view: the CT must outlive it. Safe to use from many threads.
class CtProjector {
 public:
  /// @param ct  HU; any size from one voxel, though rays need two voxels across to meet anything.
  explicit CtProjector(const GridView<const std::int16_t>& ct);

  /// Attenuation (dimensionless: 1/mm times mm) between two points in continuous voxel coordinates.
  /// The ray counts where it is within the outermost voxel centres.
  [[nodiscard]] float line_integral(const Vec3& from_voxel, const Vec3& to_voxel) const noexcept;

  [[nodiscard]] const GridGeometry& geometry() const noexcept { return ct_.geometry(); }

 private:
  static constexpr int kBlock = 8;

  [[nodiscard]] std::size_t block_of(const std::array<int, 3>& voxel) const noexcept;
  void mark_blocks();
  void spread_blocks(std::size_t axis);

  GridView<const std::int16_t> ct_;
  std::array<int, 3> blocks_{};
  std::vector<std::uint8_t> occupied_;  ///< per block: it or a neighbour holds more than air
};

}  // namespace carpus::fluoroscopy
