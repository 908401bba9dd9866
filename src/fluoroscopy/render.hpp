// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A fluoroscopy picture: true projection of a CT and of metal in it, as a mini C-arm shows it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fluoroscopy/c_arm.hpp"
#include "fluoroscopy/ct_projector.hpp"
#include "fluoroscopy/detector.hpp"
#include "fluoroscopy/metal.hpp"
#include "fluoroscopy/scan_cuts.hpp"

namespace carpus::fluoroscopy {

/// Takes shots of one CT. Keeps a view: the CT must outlive it. `render` may run on several threads
/// at once; the same arguments give the same bytes.
class FluoroscopyRenderer {
 public:
  /// @param ct  HU, frame Patient.
  explicit FluoroscopyRenderer(const GridView<const std::int16_t>& ct);

  /// One shot. The field is round, and the collimator's leaves close to where the scan ends across
  /// a limb, because beyond it nothing is known.
  [[nodiscard]] Image render(const CArmPose& pose,
                             std::span<const MetalCylinder> metal,
                             const Exposure& exposure) const;

  /// The attenuation behind the picture, for tests and measurement.
  [[nodiscard]] AttenuationMap project(const CArmPose& pose,
                                       std::span<const MetalCylinder> metal) const;

 private:
  CtProjector ct_;
  std::vector<ScanCut> cuts_;
};

}  // namespace carpus::fluoroscopy
