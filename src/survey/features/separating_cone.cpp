// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/features/separating_cone.hpp"

#include <algorithm>

namespace carpus::survey {
namespace {

/// How far the first half space's border is drawn in.
constexpr double kBorder = 1e-12;
/// In a cone whose rays are all within this cosine of its centre, a unit vector is a sum of rays
/// with weights that add to no more than its inverse.
constexpr double kNarrow = 0.5;

Vec3 unit(const Vec3& v) noexcept { return normalized_or(v, {0, 0, 1}); }

}  // namespace

void SeparatingCone::start(const VertexDifference& first) noexcept {
  const Vec3 axis = unit(first.vector);
  const Vec3 u = any_perpendicular(axis);
  const Vec3 v = cross(axis, u);
  const std::array<Vec3, 4> around{u, v, -u, -v};
  for (std::size_t i = 0; i < 4; ++i) {
    rays_[i] = {unit(around[i] + axis * kBorder), first};
  }
  count_ = around.size();
}

SeparatingCone::Cut SeparatingCone::cut(const VertexDifference& by, double least_gap_mm) noexcept {
  if (count_ + 2 > rays_.size()) return Cut::Left;
  const Vec3 middle = centre();
  std::array<double, kMostRays> heights;
  heights[0] = 0;
  std::size_t highest = 0;
  double nearest_cosine = 1;
  bool all_stay = true;
  for (std::size_t i = 0; i < count_; ++i) {
    heights[i] = dot(by.vector, rays_[i].direction);
    if (heights[i] > heights[highest]) highest = i;
    nearest_cosine = std::min(nearest_cosine, dot(middle, rays_[i].direction));
    all_stay = all_stay && heights[i] > 0;
  }
  if (heights[highest] <= 0) return Cut::Nothing;
  if (nearest_cosine > kNarrow && heights[highest] <= least_gap_mm * kNarrow) return Cut::Nothing;
  if (all_stay) return Cut::Left;
  // Those that stay follow each other about the highest (rounding may lift others above zero):
  // rotate them to the front, close with the two new rays.
  std::size_t first_in = highest;
  const auto before = [&](std::size_t i) noexcept { return i == 0 ? count_ - 1 : i - 1; };
  while (heights[before(first_in)] > 0) first_in = before(first_in);
  std::rotate(rays_.begin(), rays_.begin() + static_cast<std::ptrdiff_t>(first_in),
              rays_.begin() + static_cast<std::ptrdiff_t>(count_));
  std::rotate(heights.begin(), heights.begin() + static_cast<std::ptrdiff_t>(first_in),
              heights.begin() + static_cast<std::ptrdiff_t>(count_));
  std::size_t stay = 0;
  while (stay < count_ && heights[stay] > 0) ++stay;
  const auto crossing = [&](std::size_t in, std::size_t out) noexcept {
    return unit(rays_[in].direction * -heights[out] + rays_[out].direction * heights[in]);
  };
  const Ray leaving{crossing(stay - 1, stay), by};
  Ray entering = rays_[count_ - 1];  // keeps its plane, from the crossing to ray 0
  entering.direction = crossing(0, count_ - 1);
  rays_[stay++] = leaving;
  if (dot(leaving.direction, entering.direction) < 0) {
    rays_[stay++] = {unit(cross(by.vector, leaving.direction)), by};
  }
  rays_[stay++] = entering;
  count_ = stay;
  return Cut::Left;
}

Vec3 SeparatingCone::centre() const noexcept {
  Vec3 sum;
  for (std::size_t i = 0; i < count_; ++i) sum += rays_[i].direction;
  return unit(sum);
}

bool SeparatingCone::contains(const Vec3& direction) const noexcept {
  return std::all_of(rays_.begin(), rays_.begin() + static_cast<std::ptrdiff_t>(count_),
                     [&](const Ray& r) { return dot(r.beyond.vector, direction) > 0; });
}

std::optional<std::array<VertexDifference, 4>> SeparatingCone::around_origin(
    const VertexDifference& last) const noexcept {
  // The bounding differences, in cyclic order, span the cone dual to this one, and -last lies in
  // it: find the triangle of the fan about the first.
  for (std::size_t i = 1; i + 1 < count_; ++i) {
    const Vec3& a = rays_[0].beyond.vector;
    const Vec3& b = rays_[i].beyond.vector;
    const Vec3& c = rays_[i + 1].beyond.vector;
    const Vec3& d = last.vector;
    const double volume = dot(a, cross(b, c));
    if (volume == 0) continue;  // one difference may bound the cone between several rays
    const bool inside = -dot(d, cross(b, c)) / volume > 0 && -dot(a, cross(d, c)) / volume > 0 &&
                        -dot(a, cross(b, d)) / volume > 0;
    if (inside) return std::array{rays_[0].beyond, rays_[i].beyond, rays_[i + 1].beyond, last};
  }
  return std::nullopt;
}

}  // namespace carpus::survey
