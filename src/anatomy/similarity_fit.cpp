// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/similarity_fit.hpp"

#include <algorithm>

#include "anatomy/symmetric_eigen.hpp"
#include "core/check.hpp"

namespace carpus::anatomy {

Similarity fit_similarity(std::span<const Vec3> from,
                          std::span<const Vec3> to,
                          std::span<const double> weights,
                          const ScaleRange& range) {
  CARPUS_CHECK(from.size() == to.size() && from.size() == weights.size());
  double total = 0;
  Vec3 from_centre, to_centre;
  for (std::size_t i = 0; i < from.size(); ++i) {
    total += weights[i];
    from_centre += weights[i] * from[i];
    to_centre += weights[i] * to[i];
  }
  if (!(total > 0)) return {};
  from_centre *= 1 / total;
  to_centre *= 1 / total;

  Mat3 m{{Vec3{}, Vec3{}, Vec3{}}};  // m[r][c] = sum w from_r to_c
  double from_spread = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vec3 a = from[i] - from_centre;
    const Vec3 b = to[i] - to_centre;
    for (std::size_t r = 0; r < 3; ++r) m.rows[r] += (weights[i] * a[r]) * b;
    from_spread += weights[i] * squared_length(a);
  }
  const auto& [rx, ry, rz] = m.rows;
  // [horn1987closedform] §4: the quaternion is the eigenvector of the greatest eigenvalue of N.
  const SquareMatrix<4> n{{{rx.x + ry.y + rz.z, ry.z - rz.y, rz.x - rx.z, rx.y - ry.x},
                           {0, rx.x - ry.y - rz.z, rx.y + ry.x, rz.x + rx.z},
                           {0, 0, -rx.x + ry.y - rz.z, ry.z + rz.y},
                           {0, 0, 0, -rx.x - ry.y + rz.z}}};
  const auto eigen = eigen_of_symmetric<4>(n);
  const auto& q = eigen.vectors[0];
  Similarity fit;
  fit.rotation = rotation_from_quaternion(q[0], q[1], q[2], q[3]);
  // The greatest eigenvalue is sum w b . R a, so the best scale is its ratio to the spread.
  const double scale = from_spread > 0 ? eigen.values[0] / from_spread : 1.0;
  fit.scale = std::clamp(scale, range.low, range.high);
  fit.translation = to_centre - fit.scale * (fit.rotation * from_centre);
  return fit;
}

}  // namespace carpus::anatomy
