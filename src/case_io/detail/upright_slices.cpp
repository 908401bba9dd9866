// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/upright_slices.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "case_io/detail/memory_room.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace {

/// A box so much longer than its slices that no gantry tilts so far [pixels].
constexpr double kMostReach = 1 << 20U;

/// One axis of the slices within the upright grid.
struct Reach {
  int before = 0;  ///< pixels of the grid before the first slice's first
  int size = 0;

  Reach(double drift, int pixels, int slices, const std::string& path) {
    const double whole = drift * (slices - 1);
    if (!(std::abs(whole) <= kMostReach)) {
      throw IoError(path + ": its slices lie beside each other farther than any gantry tilts" +
                    "; the header's positions are damaged: export the series again");
    }
    const int more = static_cast<int>(std::ceil(std::abs(whole)));
    before = whole < 0 ? more : 0;
    size = pixels + more;
  }
};

class Slice {
 public:
  Slice(const Grid<std::int16_t>& volume, int k, double air) : volume_(volume), k_(k), air_(air) {}

  [[nodiscard]] double at(double x, double y) const {
    const double i = std::floor(x);
    const double j = std::floor(y);
    const auto corner = [&](int a, int b) {
      return value(static_cast<int>(i) + a, static_cast<int>(j) + b);
    };
    const double s = x - i;
    const double t = y - j;
    return (1 - t) * ((1 - s) * corner(0, 0) + s * corner(1, 0)) +
           t * ((1 - s) * corner(0, 1) + s * corner(1, 1));
  }

 private:
  [[nodiscard]] double value(int i, int j) const {
    return volume_.geometry().contains({i, j, k_}) ? volume_[VoxelIndex{i, j, k_}] : air_;
  }

  const Grid<std::int16_t>& volume_;
  int k_;
  double air_;
};

}  // namespace

Grid<std::int16_t> set_upright(const Grid<std::int16_t>& slanted,
                               const SliceDrift& drift,
                               const std::string& path) {
  const GridGeometry& from = slanted.geometry();
  const Reach x(drift.x, from.size[0], from.size[2], path);
  const Reach y(drift.y, from.size[1], from.size[2], path);
  GridGeometry upright = from;
  upright.size = {x.size, y.size, from.size[2]};
  upright.origin = from.patient_from_voxel(
      {static_cast<double>(-x.before), static_cast<double>(-y.before), 0.0});
  require_memory(upright.voxel_count() * sizeof(std::int16_t), path);
  const double air = *std::min_element(slanted.values().begin(), slanted.values().end());
  Grid<std::int16_t> result(upright);
  std::size_t at = 0;
  for (int k = 0; k < from.size[2]; ++k) {
    const Slice slice(slanted, k, air);
    for (int j = 0; j < y.size; ++j) {
      for (int i = 0; i < x.size; ++i, ++at) {
        const double value = slice.at(i - x.before - k * drift.x, j - y.before - k * drift.y);
        result[at] = static_cast<std::int16_t>(std::lround(value));
      }
    }
  }
  return result;
}

}  // namespace carpus::case_io
