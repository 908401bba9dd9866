// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The best closed line by dynamic programming over places along the outline and offsets across it,
// twice around, of which the middle turn is kept: it then ends where it began.
#include "view_trainer/outline_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carpus::view_trainer {
namespace {

double grey_at(const fluoroscopy::Image& picture, const Vec2& pixel) {
  const double x = std::clamp(pixel.x, 0.0, picture.width - 1.001);
  const double y = std::clamp(pixel.y, 0.0, picture.height - 1.001);
  const auto i = static_cast<std::size_t>(x);
  const auto j = static_cast<std::size_t>(y);
  const double u = x - static_cast<double>(i);
  const double v = y - static_cast<double>(j);
  const auto width = static_cast<std::size_t>(picture.width);
  const auto at = [&](std::size_t column, std::size_t row) {
    return static_cast<double>(picture.grey[row * width + column]);
  };
  return (at(i, j) * (1 - u) + at(i + 1, j) * u) * (1 - v) +
         (at(i, j + 1) * (1 - u) + at(i + 1, j + 1) * u) * v;
}

/// Evenly spaced places on a closed line.
Polygon resampled(const Polygon& line, double every_pixels) {
  Polygon places;
  double carried = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec2& a = line[i];
    const Vec2& b = line[(i + 1) % line.size()];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    double t = carried;
    for (; t < length; t += every_pixels) {
      places.push_back({a.x + (b.x - a.x) * t / length, a.y + (b.y - a.y) * t / length});
    }
    carried = t - length;
  }
  return places;
}

Vec2 beside(const Vec2& place, const Vec2& outwards, double pixels) {
  return {place.x + outwards.x * pixels, place.y + outwards.y * pixels};
}

/// For each place and offset how much the picture brightens outwards.
std::vector<std::vector<double>> edges_along(const fluoroscopy::Image& picture,
                                             const Polygon& places,
                                             const std::vector<Vec2>& outwards,
                                             double mm_per_pixel) {
  const int reach = static_cast<int>(std::lround(kReadWithinMm / kReadStepMm));
  std::vector<std::vector<double>> edges(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (int o = -reach; o <= reach; ++o) {
      const double offset = o * kReadStepMm;
      const double out = (offset + kEdgeHalfWidthMm) / mm_per_pixel;
      const double in = (offset - kEdgeHalfWidthMm) / mm_per_pixel;
      edges[k].push_back(grey_at(picture, beside(places[k], outwards[k], out)) -
                         grey_at(picture, beside(places[k], outwards[k], in)));
    }
  }
  return edges;
}

/// Index of the chosen offset at each place.
std::vector<std::size_t> best_closed_line(const std::vector<std::vector<double>>& edges) {
  const std::size_t count = edges.size();
  const std::size_t width = edges.front().size();
  std::vector<double> best(width, 0.0);
  std::vector<std::vector<std::uint8_t>> came(2 * count, std::vector<std::uint8_t>(width, 1));
  for (std::size_t step = 0; step < 2 * count; ++step) {
    std::vector<double> next(width);
    for (std::size_t o = 0; o < width; ++o) {
      std::size_t from = o;
      if (o > 0 && best[o - 1] > best[from]) from = o - 1;
      if (o + 1 < width && best[o + 1] > best[from]) from = o + 1;
      came[step][o] = static_cast<std::uint8_t>(from + 1 - o);
      next[o] = best[from] + edges[step % count][o];
    }
    best = std::move(next);
  }
  std::vector<std::size_t> chosen(count);
  std::size_t o =
      static_cast<std::size_t>(std::max_element(best.begin(), best.end()) - best.begin());
  for (std::size_t step = 2 * count; step-- > 0;) {
    if (step >= count / 2 && step < count / 2 + count) chosen[step % count] = o;
    o = o + came[step][o] - 1;
  }
  return chosen;
}

}  // namespace

OutlineMap read_outline(const fluoroscopy::Image& picture, const OutlineMap& truth) {
  const double mm_per_pixel = truth.lattice().mm_per_pixel;
  OutlineMap read(truth.lattice());
  for (const Polygon& outline : truth.outlines()) {
    const Polygon places = resampled(outline, kReadEveryMm / mm_per_pixel);
    if (places.size() < 8) continue;
    std::vector<Vec2> outwards;
    for (const Vec2& place : places) outwards.push_back(truth.outwards_at(place));
    const auto chosen = best_closed_line(edges_along(picture, places, outwards, mm_per_pixel));
    Polygon line;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const double offset = static_cast<double>(chosen[k]) * kReadStepMm - kReadWithinMm;
      line.push_back(beside(places[k], outwards[k], offset / mm_per_pixel));
    }
    read.add_polygon(line);
  }
  read.finish();
  return read;
}

ReadingError reading_error(const OutlineMap& read, const OutlineMap& truth) {
  double sum = 0;
  double squares = 0;
  std::size_t count = 0;
  for (const Polygon& outline : truth.outlines()) {
    for (const Vec2& place : outline) {
      const double error = -read.distance_at(place);  // inside the read outline: it lies outside
      sum += error;
      squares += error * error;
      ++count;
    }
  }
  if (count == 0) return {};
  const double mean = sum / static_cast<double>(count);
  return {mean, std::sqrt(std::max(0.0, squares / static_cast<double>(count) - mean * mean))};
}

}  // namespace carpus::view_trainer
