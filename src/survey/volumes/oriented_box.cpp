// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/volumes/oriented_box.hpp"

#include <algorithm>
#include <limits>

namespace carpus::survey {
namespace {

/// One step of Jacobi's method: turns m and the rows of axes so that m(p, q) becomes zero.
void annihilate(Mat3& m, Mat3& axes, std::size_t p, std::size_t q) {
  const double off = m.rows[p][q];
  if (off == 0) return;
  const double theta = (m.rows[q][q] - m.rows[p][p]) / (2 * off);
  const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1);
  const double s = t * c;
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = m.rows[k][p];
    const double b = m.rows[k][q];
    m.rows[k][p] = c * a - s * b;
    m.rows[k][q] = s * a + c * b;
  }
  const Vec3 mp = m.rows[p];
  const Vec3 mq = m.rows[q];
  m.rows[p] = mp * c - mq * s;
  m.rows[q] = mp * s + mq * c;
  const Vec3 ap = axes.rows[p];
  const Vec3 aq = axes.rows[q];
  axes.rows[p] = ap * c - aq * s;
  axes.rows[q] = ap * s + aq * c;
}

/// Rows: orthonormal eigenvectors of the symmetric matrix.
Mat3 eigenvectors(Mat3 m) {
  constexpr int kSweeps = 12;  // converges quadratically; 5 or 6 do
  Mat3 axes;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    annihilate(m, axes, 0, 1);
    annihilate(m, axes, 0, 2);
    annihilate(m, axes, 1, 2);
  }
  // Orthonormal up to a few roundings: boxes are tested as if their axes were.
  const Vec3 x = normalized_or(axes.rows[0], {1, 0, 0});
  const Vec3 y = normalized_or(axes.rows[1] - x * dot(x, axes.rows[1]), any_perpendicular(x));
  return {{x, y, cross(x, y)}};
}

/// Of points spread evenly over the triangles, about `centre`; corners where they have no area.
Mat3 covariance(std::span<const TrianglePoints> triangles, const Vec3& centre) {
  Mat3 sum{{Vec3{}, Vec3{}, Vec3{}}};
  const auto add = [&](const Vec3& v, double weight) {
    for (std::size_t i = 0; i < 3; ++i) sum.rows[i] += v * (v[i] * weight);
  };
  double total = 0;
  for (const TrianglePoints& t : triangles) total += length(cross(t[1] - t[0], t[2] - t[0]));
  for (const TrianglePoints& t : triangles) {
    const double area = total > 0 ? length(cross(t[1] - t[0], t[2] - t[0])) / total : 1;
    for (const Vec3& v : t) add(v - centre, area / 12);
    add((t[0] + t[1] + t[2]) / 3 - centre, area * 0.75);
  }
  return sum;
}

}  // namespace

OrientedBox OrientedBox::around(std::span<const TrianglePoints> triangles) {
  Vec3 centre;
  for (const TrianglePoints& t : triangles) centre += (t[0] + t[1] + t[2]) / 3;
  centre = centre / static_cast<double>(triangles.size());

  OrientedBox box;
  box.axes = eigenvectors(covariance(triangles, centre));
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 low{kInfinity, kInfinity, kInfinity};
  Vec3 high = -low;
  for (const TrianglePoints& t : triangles) {
    for (const Vec3& v : t) {
      const Vec3 along = box.axes * (v - centre);
      low = {std::min(low.x, along.x), std::min(low.y, along.y), std::min(low.z, along.z)};
      high = {std::max(high.x, along.x), std::max(high.y, along.y), std::max(high.z, along.z)};
    }
  }
  box.half = (high - low) * 0.5;
  box.centre = centre + box.axes.transposed() * ((low + high) * 0.5);
  return box;
}

bool OrientedBox::is_apart(const Moved& other, const Motion& motion) const noexcept {
  const double slack = motion.slack_mm;
  const Vec3 offset = other.centre - centre;
  const Vec3 d{dot(axes.rows[0], offset), dot(axes.rows[1], offset), dot(axes.rows[2], offset)};
  const Vec3& a = half;
  const Vec3& b = other.half;
  std::array<Vec3, 3> r;      // [i][j]: cosine between axis i here and axis j there
  std::array<Vec3, 3> reach;  // absolute values
  for (std::size_t i = 0; i < 3; ++i) {
    r[i] = {dot(axes.rows[i], other.axes.rows[0]), dot(axes.rows[i], other.axes.rows[1]),
            dot(axes.rows[i], other.axes.rows[2])};
    reach[i] = {std::abs(r[i].x), std::abs(r[i].y), std::abs(r[i].z)};
    if (std::abs(d[i]) > a[i] + dot(b, reach[i]) + slack) return true;
  }
  const Vec3 there = r[0] * d.x + r[1] * d.y + r[2] * d.z;
  const Vec3 mine = reach[0] * a.x + reach[1] * a.y + reach[2] * a.z;
  if (std::abs(there.x) > b.x + mine.x + slack || std::abs(there.y) > b.y + mine.y + slack ||
      std::abs(there.z) > b.z + mine.z + slack) {
    return true;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t i1 = (i + 1) % 3;
    const std::size_t i2 = (i + 2) % 3;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t j1 = (j + 1) % 3;
      const std::size_t j2 = (j + 2) % 3;
      const double of_a = a[i1] * reach[i2][j] + a[i2] * reach[i1][j];
      const double of_b = b[j1] * reach[i][j2] + b[j2] * reach[i][j1];
      if (std::abs(d[i2] * r[i1][j] - d[i1] * r[i2][j]) > of_a + of_b + slack) return true;
    }
  }
  return false;
}

}  // namespace carpus::survey
