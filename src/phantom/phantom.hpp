// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The demo patient: a simulated CT of the parametric wrist, with the truth beside it. Whoever shows
// it says that it is simulated.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "anatomy/bone_id.hpp"
#include "core/progress.hpp"
#include "geometry/grid.hpp"
#include "geometry/pose.hpp"
#include "phantom/fracture.hpp"
#include "phantom/scan_conditions.hpp"

namespace carpus::phantom {

struct PhantomOptions {
  std::uint64_t seed = 1;  ///< of noise, texture, fracture relief and the tilt in the scanner
  FractureKind fracture = FractureKind::Waist;
  Side side = Side::Left;
  double scale = 1.0;           ///< of the whole wrist, 0.7 to 1.4
  Vec3 spacing{0.3, 0.3, 0.5};  ///< mm; 0.15 to 2
  /// Where given, the field ends 4 mm beyond the bones and is divided into so many voxels of 0.1 to
  /// 2 mm; what a scan costs at the most is measured on it.
  std::optional<std::array<int, 3>> filled_voxels;
  ScanOptions scan;  ///< what this scanner and this patient do otherwise
};

struct Phantom {
  Grid<std::int16_t> ct;  ///< HU
  Grid<std::uint8_t>
      labels;  ///< of the voxel's centre; numbers in anatomy/bone_id.hpp, with 16, 17
  Pose<frame::Wrist, frame::Patient> wrist_from_patient;
  std::optional<Fracture> fracture;  ///< frame Wrist before scaling [mm]
  LongAxis scaphoid_axis;            ///< of the unbroken scaphoid, frame Wrist before scaling [mm]
  PhantomOptions options;
};

/// Simulates the CT: cortical shells over trabecular cores, marrow in the shafts, cartilage in the
/// joints, soft tissue and air, blurred by a point spread of 0.6 mm (FWHM), with correlated noise.
/// The same options give the same bytes on any number of threads.
/// @throws InvalidInput where an option is outside its range.
[[nodiscard]] Phantom make_phantom(const PhantomOptions& options,
                                   const Progress& progress = no_progress);

}  // namespace carpus::phantom
