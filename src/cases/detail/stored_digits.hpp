// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Figures as a case's files store them: to millionths, which are printed in few digits and read
// back to the same bits.
#pragma once

#include <cmath>

#include "geometry/vec3.hpp"

namespace carpus::cases::detail {

inline double rounded(double value) {
  constexpr double kMillionths = 1e6;
  return std::round(value * kMillionths) / kMillionths;
}

inline Vec3 rounded(const Vec3& v) { return {rounded(v.x), rounded(v.y), rounded(v.z)}; }

}  // namespace carpus::cases::detail
