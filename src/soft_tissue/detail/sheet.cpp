// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/detail/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/marching_cubes.hpp"
#include "mesh/simplify.hpp"
#include "mesh/smooth.hpp"

namespace carpus::soft_tissue::detail {
namespace {

constexpr double kVoxelMm = 0.35;
/// Values farther from the surface do not matter [mm].
constexpr double kFarMm = 1.0;
/// Between bodies and bone [mm].
constexpr double kClearanceMm = 0.02;
constexpr double kSimplifyMm = 0.03;
constexpr double kProbeMm = 0.05;
/// Not worth a push [mm].
constexpr double kEnoughMm = 0.01;

/// Weights of the corners of a triangle at a point on it.
Vec3 weights_at(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = p - a;
  const double uu = dot(u, u);
  const double uv = dot(u, v);
  const double vv = dot(v, v);
  const double bottom = uu * vv - uv * uv;
  if (!(bottom > 1e-12)) return {1, 0, 0};
  const double s = (vv * dot(w, u) - uv * dot(w, v)) / bottom;
  const double t = (uu * dot(w, v) - uv * dot(w, u)) / bottom;
  return {1 - s - t, s, t};
}

/// The facets of the largest piece, vertices renumbered.
TriangleMesh largest_piece(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> root(mesh.vertices.size());
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](std::uint32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const Triangle& t : mesh.facets) {
    root[find(t[1])] = find(t[0]);
    root[find(t[2])] = find(t[0]);
  }
  std::vector<std::size_t> count(root.size());
  for (const Triangle& t : mesh.facets) ++count[find(t[0])];
  const auto best =
      static_cast<std::uint32_t>(std::max_element(count.begin(), count.end()) - count.begin());
  TriangleMesh piece;
  std::vector<std::uint32_t> number(root.size());
  for (std::uint32_t i = 0; i < root.size(); ++i) {
    if (find(i) != best) continue;
    number[i] = static_cast<std::uint32_t>(piece.vertices.size());
    piece.vertices.push_back(mesh.vertices[i]);
  }
  for (const Triangle& t : mesh.facets) {
    if (find(t[0]) == best) piece.facets.push_back({number[t[0]], number[t[1]], number[t[2]]});
  }
  return piece;
}

/// How thick the body is across the sheet at the middle of each facet that has its room.
std::vector<double> thicknesses_of(const SheetDistance& distance, const Kept& kept) {
  const Sheet& sheet = distance.sheet();
  std::vector<double> found;
  const double farthest = 2 * *std::max_element(sheet.half_mm.begin(), sheet.half_mm.end());
  for (std::uint32_t f = 0; f < sheet.middle.facets.size(); ++f) {
    const Triangle& t = sheet.middle.facets[f];
    const Vec3 middle =
        (sheet.middle.vertices[t[0]] + sheet.middle.vertices[t[1]] + sheet.middle.vertices[t[2]]) /
        3.0;
    const bool has_room =
        std::none_of(kept.sheets.begin(), kept.sheets.end(),
                     [&](const SheetDistance* s) { return s->mm(middle, kFarMm) < kClearanceMm; });
    if (!has_room) continue;
    const Vec3 normal = facet_normal(sheet.middle, f);
    double thickness = 0;
    for (const double sign : {1.0, -1.0}) {
      double way = 0;
      while (way < farthest) {
        const Vec3 p = middle + normal * (sign * (way + kProbeMm / 2));
        if (distance.mm(p, kFarMm) > 0 || kept.near_mm(p) < kClearanceMm) break;
        way += kProbeMm;
      }
      thickness += way;
    }
    found.push_back(thickness);
  }
  return found;
}

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Sheet sheet_of(const std::vector<std::vector<Vec3>>& rows,
               const std::vector<std::vector<double>>& half_mm) {
  Sheet sheet;
  const std::size_t columns = rows.front().size();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    sheet.middle.vertices.insert(sheet.middle.vertices.end(), rows[r].begin(), rows[r].end());
    sheet.half_mm.insert(sheet.half_mm.end(), half_mm[r].begin(), half_mm[r].end());
  }
  for (std::size_t r = 0; r + 1 < rows.size(); ++r) {
    for (std::size_t c = 0; c + 1 < columns; ++c) {
      const auto a = static_cast<std::uint32_t>(r * columns + c);
      const auto b = static_cast<std::uint32_t>(a + columns);
      sheet.middle.facets.push_back({a, a + 1, b});
      sheet.middle.facets.push_back({a + 1, b + 1, b});
    }
  }
  return sheet;
}

SheetDistance::SheetDistance(const Sheet& sheet)
    : sheet_(sheet),
      tree_(sheet.middle),
      thickest_half_(*std::max_element(sheet.half_mm.begin(), sheet.half_mm.end())),
      box_(bounds_of(sheet.middle.vertices).grown(thickest_half_)) {}

std::optional<SheetDistance::Near> SheetDistance::nearest(const Vec3& point,
                                                          double limit_mm) const {
  if (!box_.grown(limit_mm).contains(point)) return std::nullopt;
  const auto hit = tree_.nearest(point, limit_mm + thickest_half_);
  if (!hit) return std::nullopt;
  const Triangle& t = sheet_.middle.facets[hit->facet];
  const auto& v = sheet_.middle.vertices;
  const Vec3 w = weights_at(hit->point, v[t[0]], v[t[1]], v[t[2]]);
  const double half =
      w.x * sheet_.half_mm[t[0]] + w.y * sheet_.half_mm[t[1]] + w.z * sheet_.half_mm[t[2]];
  const double away = std::sqrt(hit->squared_distance);
  if (away - half > limit_mm) return std::nullopt;
  return Near{hit->point, away, half, hit->facet};
}

double SheetDistance::mm(const Vec3& point, double limit_mm) const {
  const auto near = nearest(point, limit_mm);
  return near ? near->away_mm - near->half_mm : limit_mm;
}

double Kept::near_mm(const Vec3& point) const {
  double mm = bones->near(point).distance_mm;
  for (const SheetDistance* s : sheets) mm = std::min(mm, s->mm(point, kFarMm));
  return mm;
}

Vec3 Kept::out_of(Vec3 point, double room_mm) const {
  constexpr int kPushes = 6;
  for (int push = 0; push < kPushes; ++push) {
    point = bones->with_exact_room(point, room_mm);
    const SheetDistance* deepest = nullptr;
    double least = room_mm - kEnoughMm;
    for (const SheetDistance* s : sheets) {
      const double mm = s->mm(point, kFarMm);
      if (mm >= least) continue;
      least = mm;
      deepest = s;
    }
    if (deepest == nullptr) break;
    const auto near = deepest->nearest(point, kFarMm);
    // On the middle itself either side is as near.
    const Vec3 out =
        normalized_or(point - near->point, facet_normal(deepest->sheet().middle, near->facet));
    point += out * (room_mm - least);
  }
  return bones->with_exact_room(point, room_mm);
}

GridGeometry grid_about(const Aabb& box, double voxel_mm) {
  GridGeometry g;
  const Vec3 extent = box.extent();
  for (std::size_t a = 0; a < 3; ++a) {
    g.size[a] = static_cast<int>(std::ceil(extent[a] / voxel_mm)) + 1;
  }
  g.spacing = {voxel_mm, voxel_mm, voxel_mm};
  g.origin = box.low;
  return g;
}

namespace {

/// Over a sharp rim of bone a facet may cut although its corners do not: they are pushed on by what
/// its middle lacks.
void lift_facets(TriangleMesh& surface, const Kept& kept) {
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    bool was_lifted = false;
    for (const Triangle& t : surface.facets) {
      const Vec3 middle =
          (surface.vertices[t[0]] + surface.vertices[t[1]] + surface.vertices[t[2]]) / 3.0;
      const Vec3 lift = kept.out_of(middle, 0) - middle;
      if (length(lift) < kEnoughMm) continue;
      was_lifted = true;
      for (const std::uint32_t v : t) {
        surface.vertices[v] = kept.out_of(surface.vertices[v] + lift, kClearanceMm);
      }
    }
    if (!was_lifted) break;
  }
}

}  // namespace

TriangleMesh smooth_surface(const Grid<float>& values, const Kept& kept, double simplify_mm) {
  // Marching cubes takes higher values as inside.
  Grid<float> inside = values;
  for (float& v : inside.values()) v = -v;
  TriangleMesh surface = mesh::extract_isosurface(inside.view(), 0.0);
  if (surface.facets.empty()) return surface;
  mesh::SmoothOptions smoothing;
  smoothing.iterations = 6;
  smoothing.restores_volume = false;
  surface = mesh::smooth(largest_piece(surface), smoothing);
  surface = mesh::simplify(surface, {0, simplify_mm}).mesh;
  for (Vec3& v : surface.vertices) v = kept.out_of(v, kClearanceMm);
  lift_facets(surface, kept);
  return surface;
}

SheetBody body_of(const SheetDistance& distance, const Kept& kept) {
  Grid<float> values(grid_about(distance.box().grown(2 * kVoxelMm), kVoxelMm));
  const GridGeometry& g = values.geometry();
  for (std::size_t i = 0; i < g.voxel_count(); ++i) {
    const VoxelIndex v = g.index_of(i);
    const Vec3 p = g.patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    double value = distance.mm(p, kFarMm);
    if (value < kFarMm) value = std::max(value, kClearanceMm - kept.near_mm(p));
    values[i] = static_cast<float>(value);
  }
  SheetBody result;
  result.body = smooth_surface(values, kept, kSimplifyMm);
  const std::vector<double> thicknesses = thicknesses_of(distance, kept);
  result.thickness_mm = median_of(thicknesses);
  result.own_share = static_cast<double>(thicknesses.size()) /
                     static_cast<double>(distance.sheet().middle.facets.size());
  return result;
}

}  // namespace carpus::soft_tissue::detail
