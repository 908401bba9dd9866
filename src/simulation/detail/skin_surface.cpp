// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/skin_surface.hpp"

#include <limits>

namespace carpus::simulation::detail {
namespace {

constexpr double kFarOutMm = 1000.0;
constexpr std::uint32_t kLeftOut = std::numeric_limits<std::uint32_t>::max();

}  // namespace

SkinSurface::SkinSurface(const TriangleMesh& skin, const Vec3& about, double within_mm) {
  std::vector<std::uint32_t> kept(skin.vertices.size(), kLeftOut);
  for (const Triangle& facet : skin.facets) {
    bool is_near = false;
    for (const std::uint32_t v : facet) {
      is_near = is_near || squared_length(skin.vertices[v] - about) <= within_mm * within_mm;
    }
    if (!is_near) continue;
    Triangle taken{};
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t& at = kept[facet[i]];
      if (at == kLeftOut) {
        at = static_cast<std::uint32_t>(patch_.vertices.size());
        patch_.vertices.push_back(skin.vertices[facet[i]]);
      }
      taken[i] = at;
    }
    patch_.facets.push_back(taken);
  }
  if (patch_.facets.empty()) return;
  // Weighted by area: large facets say more.
  normals_.assign(patch_.vertices.size(), Vec3{});
  for (const Triangle& facet : patch_.facets) {
    const Vec3& a = patch_.vertices[facet[0]];
    const Vec3 normal = cross(patch_.vertices[facet[1]] - a, patch_.vertices[facet[2]] - a);
    for (const std::uint32_t v : facet) normals_[v] += normal;
  }
  for (Vec3& normal : normals_) normal = normalized_or(normal, {});
  tree_.emplace(patch_);
}

SkinPlace SkinSurface::at(const Vec3& point) const noexcept {
  SkinPlace place{point, {0, 0, 1}, -kFarOutMm};
  if (!tree_) return place;
  const auto nearest = tree_->nearest(point);
  if (!nearest) return place;
  const Triangle& facet = patch_.facets[nearest->facet];
  const Vec3& a = patch_.vertices[facet[0]];
  const Vec3 ab = patch_.vertices[facet[1]] - a;
  const Vec3 ac = patch_.vertices[facet[2]] - a;
  const Vec3 flat = cross(ab, ac);
  const double twice = squared_length(flat);
  place.point = nearest->point;
  if (twice > 0.0) {
    // Barycentric weights of the place within its facet [ericson2004realtime].
    const Vec3 ap = nearest->point - a;
    const double v = dot(cross(ap, ac), flat) / twice;
    const double w = dot(cross(ab, ap), flat) / twice;
    const Vec3 smooth =
        normals_[facet[0]] * (1.0 - v - w) + normals_[facet[1]] * v + normals_[facet[2]] * w;
    place.normal = normalized_or(smooth, normalized_or(flat, {0, 0, 1}));
  }
  const Vec3 off = point - nearest->point;
  const double far = length(off);
  place.depth_mm = dot(off, place.normal) < 0.0 ? far : -far;
  return place;
}

}  // namespace carpus::simulation::detail
