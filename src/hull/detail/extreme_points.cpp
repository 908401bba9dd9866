// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Blocks of points, two points at a time without branches; a block is searched for the index only
// at the end, where it holds an extreme.
#include "hull/detail/extreme_points.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "geometry/tolerance.hpp"
#include "hull/detail/point_pairs.hpp"

namespace carpus::hull {
namespace {

constexpr std::size_t kLines = 7;
constexpr std::size_t kBlock = 256;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Positions along the seven lines, in doubles or pairs.
template <typename T>
std::array<T, kLines> along_lines(T x, T y, T z) {
  const T sum = x + y;
  const T difference = x - y;
  return {x, y, z, sum + z, sum - z, difference + z, difference - z};
}

struct Sweep {
  std::array<Pair, kLines> low;
  std::array<Pair, kLines> high;
  Pair least_magnitude = both(kInfinity);  ///< but zeros
  Pair nan = both(0);                      ///< or infinity times zero

  Sweep() {
    low.fill(both(kInfinity));
    high.fill(both(-kInfinity));
  }
  void take(const Vec3& p, const Vec3& q) {
    const Pair x{p.x, q.x};
    const Pair y{p.y, q.y};
    const Pair z{p.z, q.z};
    const std::array<Pair, kLines> at = along_lines(x, y, z);
    for (std::size_t line = 0; line < kLines; ++line) {
      low[line] = lesser(at[line], low[line]);
      high[line] = greater(at[line], high[line]);
    }
    check(x);
    check(y);
    check(z);
  }

 private:
  void check(Pair c) {
    const Pair zero = both(0);
    const Pair nonzero = chosen(c == zero, both(kInfinity), magnitude(c));
    least_magnitude = lesser(nonzero, least_magnitude);
    nan = nan + c * zero;
  }
};

double least(Pair p) { return std::min(p[0], p[1]); }
double greatest(Pair p) { return std::max(p[0], p[1]); }

/// The blocks that hold the extremes, and their values.
struct Found {
  std::array<double, 2 * kLines> value;  ///< [2 line]: least, [2 line + 1]: greatest
  std::array<std::size_t, 2 * kLines> block{};
};

/// Takes over what `now` has beyond what was known before the block.
void note(const Sweep& now, std::size_t block, Found& found) {
  for (std::size_t line = 0; line < kLines; ++line) {
    if (const double low = least(now.low[line]); low < found.value[2 * line]) {
      found.value[2 * line] = low;
      found.block[2 * line] = block;
    }
    if (const double high = greatest(now.high[line]); high > found.value[2 * line + 1]) {
      found.value[2 * line + 1] = high;
      found.block[2 * line + 1] = block;
    }
  }
}

std::uint32_t index_in_block(std::span<const Vec3> points, const Found& found, std::size_t which) {
  const std::size_t end = std::min(found.block[which] + kBlock, points.size());
  for (std::size_t i = found.block[which]; i < end; ++i) {
    const auto [x, y, z] = points[i];
    if (along_lines(x, y, z)[which / 2] == found.value[which]) return static_cast<std::uint32_t>(i);
  }
  return 0;
}

}  // namespace

ExtremePoints find_extremes(std::span<const Vec3> points) {
  Sweep sweep;
  Found found;
  for (std::size_t line = 0; line < kLines; ++line) {
    found.value[2 * line] = kInfinity;
    found.value[2 * line + 1] = -kInfinity;
  }
  for (std::size_t begin = 0; begin < points.size(); begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, points.size());
    for (std::size_t i = begin; i < end; i += 2)
      sweep.take(points[i], points[std::min(i + 1, end - 1)]);
    note(sweep, begin, found);
  }
  ExtremePoints result;
  result.low = {found.value[0], found.value[2], found.value[4]};
  result.high = {found.value[1], found.value[3], found.value[5]};
  const double largest = std::max(
      {-result.low.x, -result.low.y, -result.low.z, result.high.x, result.high.y, result.high.z});
  const double smallest = least(sweep.least_magnitude);
  result.are_in_range = sweep.nan[0] == 0 && sweep.nan[1] == 0 && largest <= kLargestCoordinate &&
                        smallest >= kSmallestCoordinate;
  if (!result.are_in_range) return result;
  for (std::size_t i = 0; i < result.index.size(); ++i)
    result.index[i] = index_in_block(points, found, i);
  return result;
}

}  // namespace carpus::hull
