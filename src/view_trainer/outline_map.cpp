// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Distances by the exact transform of [felzenszwalb2012distance], half a cell less on either side,
// since the outline runs between cells; outlines by marching squares at distance 0.
#include "view_trainer/outline_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "imaging/distance_transform.hpp"

namespace carpus::view_trainer {
namespace {

double cross_of(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double signed_area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[(i + 1) % polygon.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

bool is_in_polygon(const Polygon& polygon, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) {
      inside = !inside;
    }
  }
  return inside;
}

struct Box {
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  void include(const Vec2& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
};

}  // namespace

OutlineMap::OutlineMap(const OutlineLattice& lattice) : lattice_(lattice) {
  GridGeometry geometry;
  geometry.size = {lattice.columns, lattice.rows, 1};
  const double cell_mm = lattice.mm_per_pixel / kCellsPerPixel;
  geometry.spacing = {cell_mm, cell_mm, cell_mm};
  inside_ = Grid<std::uint8_t>(geometry, 0);
}

template <typename Visit>
void OutlineMap::visit_box(Vec2 low, Vec2 high, const Visit& visit) const {
  const int x0 = std::max(0, static_cast<int>(std::floor(low.x)));
  const int y0 = std::max(0, static_cast<int>(std::floor(low.y)));
  const int x1 = std::min(lattice_.columns - 1, static_cast<int>(std::ceil(high.x)));
  const int y1 = std::min(lattice_.rows - 1, static_cast<int>(std::ceil(high.y)));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) visit(VoxelIndex{x, y, 0}, Vec2{double(x), double(y)});
  }
}

void OutlineMap::add_triangle(const Vec2& a, const Vec2& b, const Vec2& c) {
  Vec2 p = cell_of(a);
  Vec2 q = cell_of(b);
  const Vec2 r = cell_of(c);
  if (cross_of(p, q, r) < 0) std::swap(p, q);
  Box box;
  for (const Vec2& corner : {p, q, r}) box.include(corner);
  visit_box(box.low, box.high, [&](const VoxelIndex& at, const Vec2& m) {
    constexpr double kSeam = -1e-9;  // what lies on the edge of two triangles is in one of them
    if (cross_of(p, q, m) >= kSeam && cross_of(q, r, m) >= kSeam && cross_of(r, p, m) >= kSeam) {
      inside_[at] = 1;
    }
  });
}

void OutlineMap::add_disc(const Vec2& centre, double radius_pixels) {
  const Vec2 c = cell_of(centre);
  const double radius = radius_pixels * kCellsPerPixel;
  visit_box({c.x - radius, c.y - radius}, {c.x + radius, c.y + radius},
            [&](const VoxelIndex& at, const Vec2& m) {
              if (std::hypot(m.x - c.x, m.y - c.y) <= radius) inside_[at] = 1;
            });
}

void OutlineMap::add_polygon(const Polygon& polygon) {
  Polygon cells;
  Box box;
  for (const Vec2& corner : polygon) {
    cells.push_back(cell_of(corner));
    box.include(cells.back());
  }
  if (cells.size() < 3) return;
  visit_box(box.low, box.high, [&](const VoxelIndex& at, const Vec2& m) {
    if (is_in_polygon(cells, m)) inside_[at] = 1;
  });
}

void OutlineMap::finish() {
  const Grid<float> outside = imaging::distance_to_value(inside_.view(), 1);
  const Grid<float> inside = imaging::distance_to_background(inside_.view());
  const auto half = static_cast<float>(inside_.geometry().spacing.x / 2);
  distance_ = Grid<float>(inside_.geometry());
  for (std::size_t i = 0; i < distance_.values().size(); ++i) {
    distance_[i] = inside_[i] != 0 ? half - inside[i] : outside[i] - half;
  }
}

double OutlineMap::distance_at(const Vec2& pixel) const noexcept {
  const Vec2 cell = cell_of(pixel);
  const double x = std::clamp(cell.x, 0.0, lattice_.columns - 1.001);
  const double y = std::clamp(cell.y, 0.0, lattice_.rows - 1.001);
  const int i = static_cast<int>(x);
  const int j = static_cast<int>(y);
  const double u = x - i;
  const double v = y - j;
  const auto at = [&](int column, int row) {
    return static_cast<double>(distance_[VoxelIndex{column, row, 0}]);
  };
  return (at(i, j) * (1 - u) + at(i + 1, j) * u) * (1 - v) +
         (at(i, j + 1) * (1 - u) + at(i + 1, j + 1) * u) * v;
}

Vec2 OutlineMap::outwards_at(const Vec2& pixel) const noexcept {
  constexpr double kReachPixels = 3.0;  // over the steps of a drawn line
  const double x = distance_at({pixel.x + kReachPixels, pixel.y}) -
                   distance_at({pixel.x - kReachPixels, pixel.y});
  const double y = distance_at({pixel.x, pixel.y + kReachPixels}) -
                   distance_at({pixel.x, pixel.y - kReachPixels});
  const double length = std::hypot(x, y);
  return length > 0 ? Vec2{x / length, y / length} : Vec2{1, 0};
}

double OutlineMap::overhang_of(const Polygon& convex) const {
  double greatest = -std::numeric_limits<double>::infinity();
  Polygon cells;
  Box box;
  for (const Vec2& corner : convex) {
    greatest = std::max(greatest, distance_at(corner));
    cells.push_back(cell_of(corner));
    box.include(cells.back());
  }
  visit_box(box.low, box.high, [&](const VoxelIndex& at, const Vec2& m) {
    const auto distance = static_cast<double>(distance_[at]);
    if (distance > greatest && is_in_polygon(cells, m)) greatest = distance;
  });
  return greatest;
}

std::vector<Polygon> OutlineMap::outlines() const {
  // Edges of the lattice by number: of a cell the one to the right is 2 n, the one below 2 n + 1.
  struct Step {
    std::size_t to;
    Vec2 from_point;
  };
  std::map<std::size_t, Step> steps;
  const auto columns = static_cast<std::size_t>(lattice_.columns);
  const auto value = [&](int x, int y) {
    return static_cast<double>(distance_[VoxelIndex{x, y, 0}]);
  };
  const auto number = [&](int x, int y, bool down) {
    return 2 * (static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x)) +
           (down ? 1U : 0U);
  };
  for (int y = 0; y + 1 < lattice_.rows; ++y) {
    for (int x = 0; x + 1 < lattice_.columns; ++x) {
      // Corners and edges in turn: top left, top right, bottom right, bottom left.
      const std::array<double, 4> v{value(x, y), value(x + 1, y), value(x + 1, y + 1),
                                    value(x, y + 1)};
      const std::array<Vec2, 4> corner{Vec2{double(x), double(y)}, Vec2{x + 1.0, double(y)},
                                       Vec2{x + 1.0, y + 1.0}, Vec2{double(x), y + 1.0}};
      const std::array<std::size_t, 4> edge{number(x, y, false), number(x + 1, y, true),
                                            number(x, y + 1, false), number(x, y, true)};
      std::vector<std::size_t> enters;  // from outside to inside, going around
      std::vector<std::size_t> leaves;
      for (std::size_t i = 0; i < 4; ++i) {
        const bool here = v[i] < 0;
        const bool next = v[(i + 1) % 4] < 0;
        if (!here && next) enters.push_back(i);
        if (here && !next) leaves.push_back(i);
      }
      for (const std::size_t from : leaves) {
        // The nearest entry going on around: of two shapes that touch at a corner, two outlines.
        std::size_t to = from;
        for (std::size_t turn = 1; turn < 4; ++turn) {
          const std::size_t i = (from + turn) % 4;
          if (std::find(enters.begin(), enters.end(), i) == enters.end()) continue;
          to = i;
          break;
        }
        const double t = v[from] / (v[from] - v[(from + 1) % 4]);
        const Vec2& a = corner[from];
        const Vec2& b = corner[(from + 1) % 4];
        steps[edge[from]] = {edge[to], pixel_of({a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t})};
      }
    }
  }
  constexpr double kSpeckPixels2 = 60.0;
  std::vector<Polygon> found;
  while (!steps.empty()) {
    Polygon polygon;
    for (auto it = steps.begin(); it != steps.end();) {
      polygon.push_back(it->second.from_point);
      const std::size_t to = it->second.to;
      steps.erase(it);
      it = steps.find(to);
    }
    // Holes run the other way around.
    if (signed_area(polygon) < -kSpeckPixels2 || polygon.size() < 3) continue;
    if (signed_area(polygon) > kSpeckPixels2) found.push_back(std::move(polygon));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Polygon& a, const Polygon& b) { return a.size() > b.size(); });
  return found;
}

}  // namespace carpus::view_trainer
