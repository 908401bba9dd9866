// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/overlaps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/parallel.hpp"
#include "fields/exact_surface.hpp"

namespace carpus::soft_tissue {
namespace {

/// Between samples of a surface, and of a tube's middle line [mm].
constexpr double kSampleMm = 0.25;
constexpr double kTubeSampleMm = 0.2;
/// No tissue is thicker than twice this [mm].
constexpr double kFarthestMm = 4.0;

/// A closed surface, or a tube.
struct Body {
  std::string name;
  std::optional<fields::ExactSurface> surface;
  const cases::Structure* tube = nullptr;
  std::vector<Vec3> samples;
  Aabb box;
};

std::vector<Vec3> samples_of(const TriangleMesh& mesh) {
  std::vector<Vec3> samples = mesh.vertices;
  for (const Triangle& t : mesh.facets) {
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3 ab = mesh.vertices[t[1]] - a;
    const Vec3 ac = mesh.vertices[t[2]] - a;
    const double longest = std::max({length(ab), length(ac), length(ac - ab)});
    // At least the facet's middle.
    const int steps = std::max(3, static_cast<int>(std::ceil(longest / kSampleMm)));
    for (int i = 0; i < steps; ++i) {
      for (int k = i == 0 ? 1 : 0; i + k < steps; ++k) {
        samples.push_back(a + ab * (static_cast<double>(i) / steps) +
                          ac * (static_cast<double>(k) / steps));
      }
    }
  }
  return samples;
}

std::vector<Vec3> samples_of(const cases::Structure& tube) {
  std::vector<Vec3> samples;
  for (std::size_t i = 1; i < tube.course.size(); ++i) {
    const Vec3& a = tube.course[i - 1].at;
    const Vec3& b = tube.course[i].at;
    const int steps = std::max(1, static_cast<int>(std::ceil(distance(a, b) / kTubeSampleMm)));
    for (int k = 0; k <= steps; ++k) {
      samples.push_back(a + (b - a) * (static_cast<double>(k) / steps));
    }
  }
  return samples;
}

std::optional<Body> body_of(std::string name, const TriangleMesh& mesh) {
  // What is no closed surface has no inside; that is named elsewhere.
  if (check_surface(mesh) != SurfaceStatus::Ok) return std::nullopt;
  Body body{std::move(name), fields::ExactSurface(mesh), nullptr, samples_of(mesh),
            bounds_of(mesh.vertices)};
  return body;
}

Body body_of(const cases::Structure& tube) {
  Body body{tube.name, std::nullopt, &tube, samples_of(tube), {}};
  body.box = bounds_of(body.samples).grown(tube.radius_mm);
  return body;
}

/// The deepest of the samples in the surface. Which side a sample is on is told by the nearest
/// facet, which errs beside a sharp edge, and for the deepest ones by the winding number, which
/// does not.
double deepest_in(const fields::ExactSurface& surface,
                  const Aabb& box,
                  const std::vector<Vec3>& samples) {
  std::vector<std::pair<double, const Vec3*>> inside;
  const TriangleMesh& mesh = surface.surface();
  for (const Vec3& p : samples) {
    if (!box.contains(p)) continue;
    const auto hit = surface.tree().nearest(p, kFarthestMm);
    if (!hit) continue;
    const Triangle& t = mesh.facets[hit->facet];
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3 normal = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
    if (dot(p - hit->point, normal) >= 0) continue;
    inside.emplace_back(std::sqrt(hit->squared_distance), &p);
  }
  std::sort(inside.begin(), inside.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [mm, p] : inside) {
    if (surface.signed_distance(*p) < 0) return mm;
  }
  return 0;
}

/// The deepest of a tube's balls in the surface.
double deepest_of_tube(const Body& tube, const Body& other) {
  const double radius = tube.tube->radius_mm;
  double deepest = 0;
  for (const Vec3& p : tube.samples) {
    if (!other.box.grown(radius).contains(p)) continue;
    const auto hit = other.surface->tree().nearest(p, radius);
    if (hit) deepest = std::max(deepest, radius - std::sqrt(hit->squared_distance));
  }
  const double middle = deepest_in(*other.surface, other.box, tube.samples);
  return middle > 0 ? std::max(deepest, radius + middle) : deepest;
}

double deepest_of_tubes(const Body& a, const Body& b) {
  double deepest = 0;
  for (const Vec3& p : a.samples) {
    if (!b.box.grown(a.tube->radius_mm).contains(p)) continue;
    deepest = std::max(deepest, a.tube->radius_mm - cases::distance_to(*b.tube, p));
  }
  return deepest;
}

double depth_between(const Body& a, const Body& b) {
  if (!a.box.grown(kDeepestMm).overlaps(b.box)) return 0;
  if (a.surface && b.surface) {
    return std::max(deepest_in(*b.surface, b.box, a.samples),
                    deepest_in(*a.surface, a.box, b.samples));
  }
  if (a.tube != nullptr && b.tube != nullptr) return deepest_of_tubes(a, b);
  return a.tube != nullptr ? deepest_of_tube(a, b) : deepest_of_tube(b, a);
}

std::string name_of_label(const cases::CaseData& data, std::uint8_t label) {
  for (const cases::Bone& b : data.bones) {
    if (b.label == label) return std::string(carpus::name_of(b.bone, b.part));
  }
  return "bone " + std::to_string(label);
}

}  // namespace

double depth_between(const TriangleMesh& a, const TriangleMesh& b) {
  const auto first = body_of("", a);
  const auto second = body_of("", b);
  return first && second ? depth_between(*first, *second) : 0;
}

std::vector<Overlap> overlaps_of(const SoftTissue& tissue,
                                 const cases::CaseData& data,
                                 double least_mm) {
  std::vector<Body> bodies;
  const auto add = [&](const std::string& name, const TriangleMesh& mesh) {
    if (auto body = body_of(name, mesh)) bodies.push_back(std::move(*body));
  };
  for (const Ligament& l : tissue.ligaments) add(l.id, l.body);
  add("disc", tissue.disc.body);
  for (const Cartilage& c : tissue.cartilage) {
    add("cartilage of the " + name_of_label(data, c.label), c.body);
  }
  for (const cases::Structure& s : data.structures) bodies.push_back(body_of(s));

  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < bodies.size(); ++a) {
    for (std::size_t b = a + 1; b < bodies.size(); ++b) pairs.emplace_back(a, b);
  }
  std::vector<double> depths(pairs.size());
  parallel_for(pairs.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      depths[i] = depth_between(bodies[pairs[i].first], bodies[pairs[i].second]);
    }
  });
  std::vector<Overlap> found;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (depths[i] <= least_mm) continue;
    found.push_back({bodies[pairs[i].first].name, bodies[pairs[i].second].name, depths[i]});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Overlap& a, const Overlap& b) { return a.mm > b.mm; });
  return found;
}

}  // namespace carpus::soft_tissue
