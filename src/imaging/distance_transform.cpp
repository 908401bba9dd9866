// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Squared distance is separable: along each line it is the lower envelope of the parabolas
// (x - i)^2 s^2 + f(i), found in one sweep; x, then y, then z.
#include "imaging/distance_transform.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.hpp"

namespace carpus::imaging {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Lower envelope along one line; scratch memory is kept between lines.
class LineEnvelope {
 public:
  explicit LineEnvelope(std::size_t length, double spacing)
      : f_(length), apex_(length), start_(length + 1), s2_(spacing * spacing) {}

  std::vector<double>& values() { return f_; }

  /// Replaces values() by min over i of (x - i)^2 s^2 + values()[i]. False if all are infinite.
  bool transform(std::vector<double>& out) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < f_.size(); ++i) {
      if (!(f_[i] < kInfinite)) continue;
      double from = -kInfinite;
      while (count > 0) {
        from = crossing(apex_[count - 1], i);
        if (from > start_[count - 1]) break;
        --count;
        from = -kInfinite;
      }
      apex_[count] = i;
      start_[count] = from;
      ++count;
    }
    if (count == 0) return false;
    std::size_t k = 0;
    for (std::size_t x = 0; x < f_.size(); ++x) {
      while (k + 1 < count && start_[k + 1] < static_cast<double>(x)) ++k;
      const double dx = static_cast<double>(x) - static_cast<double>(apex_[k]);
      out[x] = dx * dx * s2_ + f_[apex_[k]];
    }
    return true;
  }

 private:
  /// Where the parabola at i > j becomes the lower one.
  [[nodiscard]] double crossing(std::size_t j, std::size_t i) const {
    const auto a = static_cast<double>(j);
    const auto b = static_cast<double>(i);
    return ((f_[i] - f_[j]) / s2_ + b * b - a * a) / (2 * (b - a));
  }

  std::vector<double> f_;
  std::vector<std::size_t> apex_;
  std::vector<double> start_;
  double s2_;
};

/// Transforms all lines along `axis` of a volume of squared distances, in place.
void transform_axis(const GridGeometry& geometry, std::size_t axis, std::span<float> squared) {
  const auto nx = static_cast<std::size_t>(geometry.size[0]);
  const auto ny = static_cast<std::size_t>(geometry.size[1]);
  const auto length = static_cast<std::size_t>(geometry.size[axis]);
  const std::size_t stride = axis == 0 ? 1 : (axis == 1 ? nx : nx * ny);
  const std::size_t lines = squared.size() / length;
  parallel_for(lines, 1024, [&](std::size_t begin, std::size_t end) {
    LineEnvelope envelope(length, geometry.spacing[axis]);
    std::vector<double> out(length);
    for (std::size_t line = begin; line < end; ++line) {
      const std::size_t base = (line / stride) * stride * length + line % stride;
      for (std::size_t i = 0; i < length; ++i) {
        envelope.values()[i] = static_cast<double>(squared[base + i * stride]);
      }
      if (!envelope.transform(out)) continue;
      for (std::size_t i = 0; i < length; ++i) {
        squared[base + i * stride] = static_cast<float>(out[i]);
      }
    }
  });
}

}  // namespace

Grid<float> distance_to_background(const GridView<const std::uint8_t>& mask) {
  return distance_to_value(mask, 0);
}

Grid<float> distance_to_value(const GridView<const std::uint8_t>& mask, std::uint8_t target) {
  Grid<float> result(mask.geometry());
  for (std::size_t i = 0; i < result.values().size(); ++i) {
    result[i] = mask[i] != target ? std::numeric_limits<float>::infinity() : 0.0F;
  }
  if (result.values().empty()) return result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    transform_axis(mask.geometry(), axis, result.values());
  }
  for (float& v : result.values()) v = std::sqrt(v);
  return result;
}

}  // namespace carpus::imaging
