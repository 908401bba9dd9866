// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Vertices thinned to a spacing, the rim first; torn off; neighbours within 2.2 of the spacing
// joined as they then lie.
#include "yielding/net_of_sheet.hpp"

#include <algorithm>
#include <utility>

namespace carpus::yielding {
namespace {

constexpr double kNeighbours = 2.2;  // of the spacing

/// By vertex. An edge of one facet alone is the rim.
std::vector<bool> rim_of(const TriangleMesh& sheet) {
  std::vector<bool> rim(sheet.vertices.size());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Triangle& f : sheet.facets) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges.emplace_back(std::min(f[k], f[(k + 1) % 3]), std::max(f[k], f[(k + 1) % 3]));
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool has_twin =
        (i > 0 && edges[i - 1] == edges[i]) || (i + 1 < edges.size() && edges[i + 1] == edges[i]);
    if (!has_twin) rim[edges[i].first] = rim[edges[i].second] = true;
  }
  return rim;
}

/// @return whether it is off
bool take_off(const ComeOff& tear, Net::Particle& particle) {
  const Vec3 along = tear.to - tear.from;
  const double whole = squared_length(along);
  double share = whole > 0 ? dot(particle.rest - tear.from, along) / whole : 0;
  share = std::clamp(share, 0.0, 1.0);
  // In the sheet: the tear is told where it shows, on the joint's wall, not in the sheet's middle.
  const Vec3 way = particle.rest - tear.from - along * share;
  const double off = length(way - particle.normal * dot(way, particle.normal));
  if (off > tear.radius_mm) return false;
  particle.is_held = false;
  if (particle.foundation_mm_per_n > 0) particle.foundation_mm_per_n /= tear.left_share;
  particle.rest += particle.normal * (tear.rests_off_mm * (1 - off / tear.radius_mm));
  return true;
}

}  // namespace

Net net_of_sheet(const TriangleMesh& sheet,
                 const Vec3& towards,
                 const SheetMaterial& material,
                 double spacing_mm,
                 const ComeOff* come_off) {
  std::vector<Vec3> normals(sheet.vertices.size());
  double area = 0;
  Vec3 all;
  for (const Triangle& f : sheet.facets) {
    const Vec3 twice = cross(sheet.vertices[f[1]] - sheet.vertices[f[0]],
                             sheet.vertices[f[2]] - sheet.vertices[f[0]]);
    area += length(twice) / 2;
    for (const std::uint32_t v : f) normals[v] += twice;
    all += twice;
  }
  const double sign = dot(all, towards) < 0 ? -1.0 : 1.0;
  const std::vector<bool> rim = rim_of(sheet);
  std::vector<Net::Particle> particles;
  const auto is_free = [&](const Vec3& at) {
    return std::none_of(particles.begin(), particles.end(), [&](const Net::Particle& taken) {
      return distance(taken.scanned, at) < spacing_mm;
    });
  };
  // The rim first: it is held, and stays where it is.
  for (const bool of_rim : {true, false}) {
    for (std::size_t v = 0; v < sheet.vertices.size() && particles.size() < kMaxParticles; ++v) {
      const Vec3& at = sheet.vertices[v];
      if (rim[v] != of_rim || !is_free(at)) continue;
      particles.push_back({at, at, normalized_or(normals[v] * sign, {0, 0, 1}), of_rim, 0, 0});
    }
  }
  const double each_mm2 = particles.empty() ? 0 : area / static_cast<double>(particles.size());
  const double foundation = material.foundation_n_per_mm2 * each_mm2;
  Net net(spacing_mm, material.mass_g_per_mm2 * each_mm2, material.damping_per_s);
  std::vector<bool> is_off;
  for (Net::Particle& particle : particles) {
    particle.foundation_mm_per_n = foundation > 0 ? 1 / foundation : 0;
    is_off.push_back(come_off != nullptr && take_off(*come_off, particle));
    net.add(particle);
  }
  for (std::size_t a = 0; a < net.size(); ++a) {
    for (std::size_t b = a + 1; b < net.size(); ++b) {
      if (distance(net.rest()[a], net.rest()[b]) > kNeighbours * spacing_mm) continue;
      const bool is_loose = is_off[a] || is_off[b];
      net.join(a, b, material.along_n_per_mm * (is_loose ? come_off->left_share : 1.0), 0);
    }
  }
  return net;
}

}  // namespace carpus::yielding
