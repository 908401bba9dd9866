// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "haptics/local_planes.hpp"

#include <algorithm>
#include <cmath>

namespace carpus::haptics {
namespace {

/// Nearer than this the direction from hand to proxy is rounding [mm].
constexpr double kTooNearMm = 1e-3;

template <typename Whole>
Whole whole(double value, double low, double high) noexcept {
  return static_cast<Whole>(std::lround(std::clamp(value, low, high)));
}

bool is_sound(const SurfacePlane& plane) noexcept {
  return is_finite(plane.normal) && std::isfinite(plane.offset_mm) &&
         std::isfinite(plane.feel.stiffness_n_per_mm) && std::isfinite(plane.feel.damping_s) &&
         std::isfinite(plane.feel.friction) && std::abs(squared_length(plane.normal) - 1) < 1e-3;
}

}  // namespace

std::optional<SurfacePlane> plane_at(const Vec3& proxy,
                                     const Vec3& hand,
                                     const Vec3& surface_normal,
                                     const SurfaceFeel& feel) noexcept {
  const Vec3 out = proxy - hand;
  const double depth = length(out);
  SurfacePlane plane;
  plane.feel = feel;
  if (depth > kTooNearMm && std::isfinite(depth)) {
    plane.normal = out / depth;
  } else if (std::abs(squared_length(surface_normal) - 1) < 1e-3) {
    plane.normal = surface_normal;
  } else {
    return std::nullopt;
  }
  plane.offset_mm = dot(plane.normal, proxy);
  return plane;
}

firmware::Contact contact_frame(const HapticWish& wish,
                                double share,
                                ForceLimiter& limiter) noexcept {
  firmware::Contact frame;
  const double whole_share = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
  for (std::size_t i = 0; i < std::min<std::size_t>(wish.plane_count, 2); ++i) {
    const SurfacePlane& plane = wish.planes[i];
    if (!is_sound(plane)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      frame.normals[3 * i + k] = whole<std::int16_t>(plane.normal[k] * 16384, -16384, 16384);
    }
    frame.offsets_um[i] = whole<std::int32_t>(plane.offset_mm * 1000, -500'000, 500'000);
    const double stiffness = plane.feel.stiffness_n_per_mm * whole_share;
    frame.stiffness_n_per_m[i] = whole<std::uint16_t>(stiffness * 1000, 0, 10'000);
    frame.damping_mns_per_m[i] =
        whole<std::uint16_t>(stiffness * plane.feel.damping_s * 1e6, 0, 20'000);
    frame.friction[i] = whole<std::uint8_t>(plane.feel.friction * 128, 0, 255);
  }
  const Vec3 besides = limiter.limited(wish.besides_n);
  for (std::size_t k = 0; k < 3; ++k) {
    frame.force_mn[k] = whole<std::int16_t>(besides[k] * 1000, -8000, 8000);
  }
  frame.limit_mn = whole<std::uint16_t>(limiter.limit_n(wish.limit_n) * 1000, 0, 8000);
  if (std::isfinite(wish.vibration_n) && std::isfinite(wish.vibration_hz)) {
    frame.vibration_mn = whole<std::uint16_t>(wish.vibration_n * 1000, 0, 1000);
    frame.vibration_hz = whole<std::uint16_t>(wish.vibration_hz, 0, 500);
  }
  return frame;
}

}  // namespace carpus::haptics
