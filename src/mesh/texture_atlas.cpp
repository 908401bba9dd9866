// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/texture_atlas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "core/error.hpp"

namespace carpus::mesh {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// A facet may go with a chart of another direction than its own down to this cosine.
constexpr double kLeastCosine = 0.2;
/// Charts of fewer facets than this share go with a neighbour where they can.
constexpr double kSmallChart = 0.01;

/// Directions 2 a and 2 a + 1: along and against axis a.
double along(const Vec3& normal, std::size_t direction) {
  const double c = normal[direction / 2];
  return direction % 2 == 0 ? c : -c;
}

struct Facets {
  std::vector<Vec3> normals;
  std::vector<std::array<std::uint32_t, 3>> neighbours;  ///< across edge i to i + 1; kNone at a rim
};

Facets facets_of(const TriangleMesh& surface) {
  Facets facets;
  facets.normals.reserve(surface.facets.size());
  facets.neighbours.assign(surface.facets.size(), {kNone, kNone, kNone});
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint32_t, std::size_t>> open;
  for (std::uint32_t f = 0; f < surface.facets.size(); ++f) {
    const Triangle& t = surface.facets[f];
    const Vec3& a = surface.vertices[t[0]];
    facets.normals.push_back(
        normalized_or(cross(surface.vertices[t[1]] - a, surface.vertices[t[2]] - a), {0, 0, 1}));
    for (std::size_t e = 0; e < 3; ++e) {
      const auto twin = open.find({t[(e + 1) % 3], t[e]});
      if (twin == open.end()) {
        open[{t[e], t[(e + 1) % 3]}] = {f, e};
      } else {
        facets.neighbours[f][e] = twin->second.first;
        facets.neighbours[twin->second.first][twin->second.second] = f;
        open.erase(twin);
      }
    }
  }
  return facets;
}

std::vector<std::uint8_t> directions_of(const Facets& facets) {
  std::vector<std::uint8_t> direction(facets.normals.size());
  for (std::size_t f = 0; f < direction.size(); ++f) {
    std::size_t best = 0;
    for (std::size_t d = 1; d < 6; ++d) {
      if (along(facets.normals[f], d) > along(facets.normals[f], best)) best = d;
    }
    direction[f] = static_cast<std::uint8_t>(best);
  }
  return direction;
}

/// Numbers the connected parts of one direction. @return how many.
std::uint32_t number_charts(const Facets& facets,
                            const std::vector<std::uint8_t>& direction,
                            std::vector<std::uint32_t>& chart) {
  std::uint32_t count = 0;
  chart.assign(direction.size(), kNone);
  std::vector<std::uint32_t> open;
  for (std::uint32_t seed = 0; seed < direction.size(); ++seed) {
    if (chart[seed] != kNone) continue;
    chart[seed] = count;
    open.assign(1, seed);
    while (!open.empty()) {
      const std::uint32_t f = open.back();
      open.pop_back();
      for (const std::uint32_t n : facets.neighbours[f]) {
        if (n == kNone || chart[n] != kNone || direction[n] != direction[f]) continue;
        chart[n] = count;
        open.push_back(n);
      }
    }
    ++count;
  }
  return count;
}

/// Lets each small chart go with the neighbouring one with which it has the longest border (in
/// edges) among those from whose direction all of it is seen. @return true where one went.
bool merge_small_charts(const Facets& facets, std::vector<std::uint8_t>& direction) {
  std::vector<std::uint32_t> chart;
  const std::uint32_t count = number_charts(facets, direction, chart);
  std::vector<std::vector<std::uint32_t>> members(count);
  for (std::uint32_t f = 0; f < chart.size(); ++f) members[chart[f]].push_back(f);
  const auto small = static_cast<std::size_t>(kSmallChart * static_cast<double>(chart.size())) + 1;
  bool has_merged = false;
  for (const auto& own : members) {
    if (own.size() > small) continue;
    std::array<int, 6> border{};
    for (const std::uint32_t f : own) {
      for (const std::uint32_t n : facets.neighbours[f]) {
        if (n != kNone && direction[n] != direction[f]) ++border[direction[n]];
      }
    }
    std::size_t best = 6;
    for (std::size_t d = 0; d < 6; ++d) {
      if (border[d] == 0 || (best < 6 && border[d] <= border[best])) continue;
      const bool is_seen = std::all_of(own.begin(), own.end(), [&](std::uint32_t f) {
        return along(facets.normals[f], d) > kLeastCosine;
      });
      if (is_seen) best = d;
    }
    if (best == 6) continue;
    for (const std::uint32_t f : own) direction[f] = static_cast<std::uint8_t>(best);
    has_merged = true;
  }
  return has_merged;
}

struct Chart {
  std::size_t direction = 0;
  std::array<double, 2> low{};    ///< mm, in its plane
  std::array<double, 2> size{};   ///< mm
  bool is_upright = false;        ///< laid with its longer side to the right
  std::array<double, 2> place{};  ///< texels of its upper left corner
};

std::array<double, 2> flat(const Vec3& p, std::size_t direction) {
  const std::size_t axis = direction / 2;
  return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
}

/// Rows from the top, charts sorted by height. @return whether all fit.
bool pack(std::vector<Chart>& charts,
          const std::vector<std::size_t>& order,
          double texels_per_mm,
          int side,
          int gap) {
  double x = gap;
  double y = gap;
  double row = 0;
  for (const std::size_t i : order) {
    Chart& chart = charts[i];
    const double width = std::max(chart.size[0], chart.size[1]) * texels_per_mm + 1;
    const double height = std::min(chart.size[0], chart.size[1]) * texels_per_mm + 1;
    if (x + width + gap > side) {
      x = gap;
      y += row + gap;
      row = 0;
    }
    if (x + width + gap > side || y + height + gap > side) return false;
    chart.place = {x, y};
    x += width + gap;
    row = std::max(row, height);
  }
  return true;
}

double pack_as_large_as_fits(std::vector<Chart>& charts, int side, int gap) {
  std::vector<std::size_t> order(charts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto height = [&](std::size_t i) { return std::min(charts[i].size[0], charts[i].size[1]); };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return height(a) > height(b); });
  double fits = 0;
  double too_large = side;  // texels in a mm: more than any surface of a mm could use
  constexpr int kHalvings = 30;
  for (int i = 0; i < kHalvings; ++i) {
    const double scale = (fits + too_large) / 2;
    (pack(charts, order, scale, side, gap) ? fits : too_large) = scale;
  }
  if (fits == 0 || !pack(charts, order, fits, side, gap)) {
    throw InvalidInput("a bitmap of " + std::to_string(side) + " texels is too small for " +
                       std::to_string(charts.size()) + " charts");
  }
  return fits;
}

double twice_area(const std::array<double, 2>& a,
                  const std::array<double, 2>& b,
                  const std::array<double, 2>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Unpainted texels take the mean of their painted neighbours, `rounds` times; then the mean of
/// all.
void fill_the_rest(std::vector<std::uint8_t>& texels,
                   std::vector<bool>& is_painted,
                   int side,
                   int rounds) {
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
           static_cast<std::size_t>(x);
  };
  for (int round = 0; round < rounds; ++round) {
    const std::vector<bool> before = is_painted;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        if (before[at(x, y)]) continue;
        int sum = 0;
        int count = 0;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            const int nx = x + dx;
            const int ny = y + dy;
            if (nx < 0 || ny < 0 || nx >= side || ny >= side || !before[at(nx, ny)]) continue;
            sum += texels[at(nx, ny)];
            ++count;
          }
        }
        if (count == 0) continue;
        texels[at(x, y)] = static_cast<std::uint8_t>((sum + count / 2) / count);
        is_painted[at(x, y)] = true;
      }
    }
  }
  std::uint64_t sum = 0;
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    if (!is_painted[i]) continue;
    sum += texels[i];
    ++count;
  }
  const auto mean = static_cast<std::uint8_t>(count == 0 ? 0 : sum / count);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    if (!is_painted[i]) texels[i] = mean;
  }
}

}  // namespace

TextureAtlas make_texture_atlas(const TriangleMesh& surface, int side, int gap) {
  if (surface.facets.empty()) throw InvalidInput("a surface without facets has no texture");
  const Facets facets = facets_of(surface);
  std::vector<std::uint8_t> direction = directions_of(facets);
  constexpr int kMostRounds = 8;
  for (int i = 0; i < kMostRounds && merge_small_charts(facets, direction); ++i) {
  }
  std::vector<std::uint32_t> chart_of;
  const std::uint32_t count = number_charts(facets, direction, chart_of);
  std::vector<Chart> charts(count);
  constexpr double kFar = std::numeric_limits<double>::max();
  std::vector<std::array<double, 2>> high(count, {-kFar, -kFar});
  for (Chart& chart : charts) chart.low = {kFar, kFar};
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    Chart& chart = charts[chart_of[f]];
    chart.direction = direction[f];
    for (const std::uint32_t v : surface.facets[f]) {
      const auto p = flat(surface.vertices[v], chart.direction);
      for (std::size_t i = 0; i < 2; ++i) {
        chart.low[i] = std::min(chart.low[i], p[i]);
        high[chart_of[f]][i] = std::max(high[chart_of[f]][i], p[i]);
      }
    }
  }
  for (std::size_t c = 0; c < charts.size(); ++c) {
    charts[c].size = {high[c][0] - charts[c].low[0], high[c][1] - charts[c].low[1]};
    charts[c].is_upright = charts[c].size[1] > charts[c].size[0];
  }
  TextureAtlas atlas;
  atlas.side = side;
  atlas.charts = charts.size();
  atlas.texels_per_mm = pack_as_large_as_fits(charts, side, gap);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> standing;  // vertex in a chart
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    const Chart& chart = charts[chart_of[f]];
    Triangle t{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = surface.facets[f][i];
      const auto [found, is_new] =
          standing.try_emplace({v, chart_of[f]}, static_cast<std::uint32_t>(atlas.sources.size()));
      if (is_new) {
        auto p = flat(surface.vertices[v], chart.direction);
        for (std::size_t k = 0; k < 2; ++k) p[k] = (p[k] - chart.low[k]) * atlas.texels_per_mm;
        if (chart.is_upright) std::swap(p[0], p[1]);
        atlas.sources.push_back(v);
        // Half a texel in, so that the chart's rim lies on texels' middles.
        atlas.uv.push_back(
            {(chart.place[0] + 0.5 + p[0]) / side, (chart.place[1] + 0.5 + p[1]) / side});
      }
      t[i] = found->second;
    }
    atlas.facets.push_back(t);
  }
  return atlas;
}

std::vector<std::uint8_t> paint_texture(
    const TextureAtlas& atlas,
    const TriangleMesh& surface,
    const std::function<std::uint8_t(const Vec3& point, const Vec3& normal)>& value) {
  const int side = atlas.side;
  std::vector<std::uint8_t> texels(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  std::vector<bool> is_painted(texels.size(), false);
  for (std::size_t f = 0; f < atlas.facets.size(); ++f) {
    std::array<std::array<double, 2>, 3> at{};
    std::array<Vec3, 3> corner;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& uv = atlas.uv[atlas.facets[f][i]];
      at[i] = {uv[0] * side - 0.5, uv[1] * side - 0.5};
      corner[i] = surface.vertices[atlas.sources[atlas.facets[f][i]]];
    }
    const double area = twice_area(at[0], at[1], at[2]);
    if (area == 0) continue;
    const Vec3 normal =
        normalized_or(cross(corner[1] - corner[0], corner[2] - corner[0]), {0, 0, 1});
    const auto bound = [&](std::size_t k, bool upper) {
      const double least = std::min({at[0][k], at[1][k], at[2][k]});
      const double most = std::max({at[0][k], at[1][k], at[2][k]});
      return std::clamp(static_cast<int>(upper ? std::floor(most) : std::ceil(least)), 0, side - 1);
    };
    for (int y = bound(1, false); y <= bound(1, true); ++y) {
      for (int x = bound(0, false); x <= bound(0, true); ++x) {
        const std::array<double, 2> p{static_cast<double>(x), static_cast<double>(y)};
        const double a = twice_area(p, at[1], at[2]) / area;
        const double b = twice_area(at[0], p, at[2]) / area;
        const double c = 1 - a - b;
        constexpr double kWithin = -1e-9;
        if (a < kWithin || b < kWithin || c < kWithin) continue;
        const std::size_t texel = static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                                  static_cast<std::size_t>(x);
        texels[texel] = value(corner[0] * a + corner[1] * b + corner[2] * c, normal);
        is_painted[texel] = true;
      }
    }
  }
  constexpr int kRounds = 3;
  fill_the_rest(texels, is_painted, side, kRounds);
  return texels;
}

}  // namespace carpus::mesh
