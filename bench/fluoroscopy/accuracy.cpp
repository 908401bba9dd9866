// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/fluoroscopy/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"
#include "geometry/aabb.hpp"

namespace carpus::bench {
namespace {

/// Depths along the beam [mm from the receptor] between which anything lies.
constexpr double kFarMm = 0.0;
constexpr double kNearMm = -220.0;

}  // namespace

Difference difference_of(const fluoroscopy::AttenuationMap& map,
                         const fluoroscopy::AttenuationMap& oracle) {
  std::vector<double> differences;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    const auto a = static_cast<double>(map.values[i]);
    const auto b = static_cast<double>(oracle.values[i]);
    if (std::isnan(a) || std::isnan(b)) continue;
    differences.push_back(std::abs(a - b));
    low = std::min(low, b);
    high = std::max(high, b);
  }
  Difference result;
  result.pixels = differences.size();
  if (differences.empty() || !(high > low)) return result;
  std::sort(differences.begin(), differences.end());
  const double percent = 100.0 / (high - low);
  double sum = 0;
  for (const double d : differences) sum += d;
  const auto count = static_cast<double>(differences.size());
  result.mean_percent = percent * sum / count;
  result.p99_percent = percent * differences[static_cast<std::size_t>(0.99 * (count - 1))];
  result.worst_percent = percent * differences.back();
  const auto within = std::upper_bound(differences.begin(), differences.end(), 1.0 / percent);
  result.share_within_1_percent = 100.0 * static_cast<double>(within - differences.begin()) / count;
  return result;
}

fluoroscopy::AttenuationMap stepped_map(const fluoroscopy::ComposedProjector& projector,
                                        const fluoroscopy::CArmPose& pose,
                                        const BodyPoses& poses,
                                        double step_mm,
                                        std::size_t stride) {
  const auto side = static_cast<std::size_t>(pose.geometry.pixels);
  fluoroscopy::AttenuationMap map{
      pose.geometry.pixels,
      pose.geometry.pixels,
      std::vector<float>(side * side, std::numeric_limits<float>::quiet_NaN()),
      {}};
  const fluoroscopy::BentTissue tissue(projector.bending(), poses);
  const auto patient_from_carm = pose.carm_from_patient.inverse();
  const double distance = pose.geometry.source_to_receptor_mm;
  const std::size_t rows = (side + stride - 1) / stride;
  parallel_for(rows, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin * stride; j < std::min(side, end * stride); j += stride) {
      for (std::size_t i = 0; i < side; i += stride) {
        const double centre = 0.5 * (pose.geometry.pixels - 1);
        const double pixel = pose.geometry.pixel_mm();
        const Vec3 way{(static_cast<double>(i) - centre) * pixel,
                       (static_cast<double>(j) - centre) * pixel, distance};
        const double slant = length(way) / distance;
        const auto steps = static_cast<int>((kFarMm - kNearMm) * slant / step_mm);
        double sum = 0;
        for (int s = 0; s < steps; ++s) {
          const double z = kNearMm + (s + 0.5) * step_mm / slant;
          const Vec3 p = way * ((z + distance) / distance) - Vec3{0, 0, distance};
          sum += projector.attenuation_at(patient_from_carm * Point<frame::CArm>{p}, tissue, poses);
        }
        map.values[j * side + i] = static_cast<float>(sum * step_mm);
      }
    }
  });
  return map;
}

}  // namespace carpus::bench
