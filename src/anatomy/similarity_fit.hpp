// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The rotation, scale and translation that best take one set of points to another.
#pragma once

#include <span>

#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"

namespace carpus::anatomy {

/// x -> scale * rotation * x + translation; the rotation is proper.
struct Similarity {
  Mat3 rotation;
  double scale = 1;
  Vec3 translation;

  [[nodiscard]] constexpr Vec3 operator*(const Vec3& x) const noexcept {
    return scale * (rotation * x) + translation;
  }
};

struct ScaleRange {
  double low = 0;
  double high = 0;
};

/// Minimises sum weights[i] |T from[i] - to[i]|^2 over similarities with the scale in `range`;
/// never a reflection. Needs three points that do not lie on a line for a unique rotation; fewer
/// give one of the best. Source: [horn1987closedform] (unit quaternions).
[[nodiscard]] Similarity fit_similarity(std::span<const Vec3> from,
                                        std::span<const Vec3> to,
                                        std::span<const double> weights,
                                        const ScaleRange& range);

}  // namespace carpus::anatomy
