// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Squared distance is separable: along each line it is the lower envelope of the parabolas
// (x - i)^2 s^2 + f(i), found in one sweep; x, then y, then z. Where f is 0 so is the distance, and
// no parabola reaches past such a place: only what lies between two of them is looked at. Lines
// beside each other are taken together, because memory is read by rows.
#include "imaging/distance_transform.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "core/parallel.hpp"

namespace carpus::imaging {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Voxels that one task of a loop takes at least.
constexpr std::size_t kGrain = 1U << 16U;
/// Lines taken together: a line of the processor's cache holds so many numbers.
constexpr std::size_t kBeside = 16;

/// Lower envelope along one line; scratch memory is kept between lines.
class LineEnvelope {
 public:
  explicit LineEnvelope(std::size_t length, double spacing)
      : apex_(length), start_(length + 1), f_(length), s2_(spacing * spacing) {}

  /// Replaces the line's values by min over i of (x - i)^2 s^2 + values[i].
  void transform(std::span<float> line) {
    std::size_t begin = 0;
    while (begin < line.size()) {
      if (line[begin] == 0 && (begin + 1 == line.size() || line[begin + 1] == 0)) {
        ++begin;
        continue;
      }
      std::size_t end = begin + 1;
      while (end < line.size() && line[end] != 0) ++end;
      // From a place of 0, or the line's begin, to the next, or its end.
      transform_between(line, begin, std::min(end + 1, line.size()));
      begin = end;
    }
  }

 private:
  void transform_between(std::span<float> line, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) f_[i] = static_cast<double>(line[i]);
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) {
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
    if (count == 0) return;
    std::size_t k = 0;
    for (std::size_t x = begin; x < end; ++x) {
      while (k + 1 < count && start_[k + 1] < static_cast<double>(x)) ++k;
      const double dx = static_cast<double>(x) - static_cast<double>(apex_[k]);
      line[x] = static_cast<float>(dx * dx * s2_ + f_[apex_[k]]);
    }
  }

  /// Where the parabola at i > j becomes the lower one.
  [[nodiscard]] double crossing(std::size_t j, std::size_t i) const {
    const auto a = static_cast<double>(j);
    const auto b = static_cast<double>(i);
    return ((f_[i] - f_[j]) / s2_ + b * b - a * a) / (2 * (b - a));
  }

  std::vector<std::size_t> apex_;
  std::vector<double> start_;
  std::vector<double> f_;
  double s2_;
};

/// Transforms all lines along `axis` of a volume of squared distances, in place.
void transform_axis(const GridGeometry& geometry, std::size_t axis, std::span<float> squared) {
  const auto nx = static_cast<std::size_t>(geometry.size[0]);
  const auto ny = static_cast<std::size_t>(geometry.size[1]);
  const auto length = static_cast<std::size_t>(geometry.size[axis]);
  const std::size_t stride = axis == 0 ? 1 : (axis == 1 ? nx : nx * ny);
  // So many lines lie beside each other before the next begin elsewhere.
  const std::size_t together = axis == 0 ? 1 : nx;
  const std::size_t sheets = squared.size() / (length * together);
  parallel_for(sheets, std::max<std::size_t>(1, 1024 / together),
               [&](std::size_t begin, std::size_t end) {
                 LineEnvelope envelope(length, geometry.spacing[axis]);
                 std::vector<float> lines(axis == 0 ? 0 : kBeside * length);
                 for (std::size_t sheet = begin; sheet < end; ++sheet) {
                   if (axis == 0) {
                     envelope.transform(squared.subspan(sheet * length, length));
                     continue;
                   }
                   const std::size_t base = axis == 1 ? sheet * nx * length : sheet * nx;
                   for (std::size_t x = 0; x < nx; x += kBeside) {
                     const std::size_t width = std::min(kBeside, nx - x);
                     float* const first = squared.data() + base + x;
                     for (std::size_t i = 0; i < length; ++i) {
                       for (std::size_t k = 0; k < width; ++k)
                         lines[k * length + i] = first[i * stride + k];
                     }
                     for (std::size_t k = 0; k < width; ++k) {
                       envelope.transform(std::span(lines).subspan(k * length, length));
                     }
                     for (std::size_t i = 0; i < length; ++i) {
                       for (std::size_t k = 0; k < width; ++k)
                         first[i * stride + k] = lines[k * length + i];
                     }
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
  parallel_for(result.values().size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      result[i] = mask[i] != target ? std::numeric_limits<float>::infinity() : 0.0F;
    }
  });
  if (result.values().empty()) return result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    transform_axis(mask.geometry(), axis, result.values());
  }
  parallel_for(result.values().size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) result[i] = std::sqrt(result[i]);
  });
  return result;
}

}  // namespace carpus::imaging
