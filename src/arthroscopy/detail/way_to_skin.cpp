// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Every facet is asked: line against triangle by the rule of determinants.
#include "arthroscopy/detail/way_to_skin.hpp"

namespace carpus::arthroscopy::detail {

std::optional<double> way_to_skin(const MeshIn<frame::Patient>& skin,
                                  const Vec3& from,
                                  const Vec3& way) {
  std::optional<double> farthest;
  for (const Triangle& f : skin.facets) {
    const Vec3& a = skin.vertices[f[0]];
    const Vec3 ab = skin.vertices[f[1]] - a;
    const Vec3 ac = skin.vertices[f[2]] - a;
    const Vec3 p = cross(way, ac);
    const double det = dot(ab, p);
    if (det == 0) continue;
    const Vec3 s = from - a;
    const double u = dot(s, p) / det;
    const Vec3 q = cross(s, ab);
    const double v = dot(way, q) / det;
    const double t = dot(ac, q) / det;
    if (u < 0 || v < 0 || u + v > 1 || t < 0) continue;
    if (!farthest || t > *farthest) farthest = t;
  }
  return farthest;
}

}  // namespace carpus::arthroscopy::detail
