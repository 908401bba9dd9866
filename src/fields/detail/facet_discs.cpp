// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fields/detail/facet_discs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/widest_vectors.hpp"
#include "fields/triangle_tree.hpp"
#include "geometry/aabb.hpp"

namespace carpus::fields {
namespace {

/// Of the greatest coordinate M: four times what single precision may be off by in the distance
/// from a disc. Coordinates from its centre are off by 2^-23 M, the height by 6 * 2^-24 M; what is
/// off the axis, squared, by 8 * 2^-24 of the squared distance r from the centre, of which the
/// share that is beyond the rim counts: at most 2^-22 r far away, 2^-20 of the radius near the rim.
constexpr double kSlackShare = 1.0 / (1 << 18);
/// The same for what is left out by direction: one to what is d away is off by 2^-24 M / d; |e - u|
/// below, a square root, by up to sqrt(2^-23 / d), and d exceeds the ball's radius, by which it is
/// multiplied.
constexpr double kTurnedSlackShare = 1.0 / 2048;

/// Sine of a triangle's angle below which its normal is rounding: it may point along a side, and
/// the disc across it holds little of the triangle. A few thousand times what a product is off by,
/// so that what is left of that is far below the slack.
constexpr double kFlattest = 1e-11;

/// Discs asked at a time; lists are filled up to a whole number of them.
constexpr std::size_t kTogether = 8;
/// Where the discs lie that fill up, in x [mm]: farther than any, its square still a float.
constexpr float kNowhere = 1e15F;

struct Disc {
  Vec3 centre;
  double radius = 0;
  Vec3 normal;
};

/// Of an acute triangle the circumcircle, otherwise the one on the longest side.
Disc disc_around(const Vec3& a, const Vec3& b, const Vec3& c) {
  Disc disc;
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 across = cross(ab, ac);
  if (squared_length(across) > kFlattest * kFlattest * squared_length(ab) * squared_length(ac)) {
    disc.normal = normalized_or(across, {0, 0, 0});
  }
  const double twice_squared = 2 * squared_length(across);
  const bool is_acute = squared_length(disc.normal) > 0 && dot(ab, ac) > 0 &&
                        dot(b - a, b - c) > 0 && dot(c - a, c - b) > 0;
  if (is_acute && twice_squared > 0) {
    disc.centre =
        a + (cross(across, ab) * squared_length(ac) + cross(ac, across) * squared_length(ab)) /
                twice_squared;
  } else {
    const std::pair<Vec3, Vec3> sides[]{{a, b}, {b, c}, {c, a}};
    const auto* longest =
        std::max_element(std::begin(sides), std::end(sides), [](const auto& s, const auto& t) {
          return squared_length(s.second - s.first) < squared_length(t.second - t.first);
        });
    disc.centre = (longest->first + longest->second) * 0.5;
  }
  for (const Vec3& corner : {a, b, c}) {
    disc.radius = std::max(disc.radius, distance(disc.centre, corner));
  }
  return disc;
}

/// A point seen from a disc.
struct Seen {
  float x, y, z;                       ///< from the disc's centre
  float normal_x, normal_y, normal_z;  ///< of the disc
  float height;                        ///< over the disc's plane
  float off_axis;
  float beyond;   ///< the disc's rim, off the axis
  float squared;  ///< distance from the disc
};

float at_least_0(float x) noexcept { return x > 0.0F ? x : 0.0F; }

}  // namespace

NearestFacet nearest_on(const TriangleMesh& mesh, std::uint32_t facet, const Vec3& p) noexcept {
  const Triangle& t = mesh.facets[facet];
  const Vec3 q =
      nearest_point_on_triangle(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
  return {squared_length(p - q), facet, q};
}

FacetDiscs::FacetDiscs(const TriangleMesh& mesh, double farthest_mm) : mesh_(&mesh) {
  const Aabb box = bounds_of(mesh.vertices);
  origin_ = box.centre();
  const double greatest = 0.5 * length(box.extent()) + farthest_mm;
  slack_mm_ = kSlackShare * greatest;
  turned_slack_mm_ = kTurnedSlackShare * greatest;
  resize(mesh.facets.size());
  for (std::size_t i = 0; i < size(); ++i) {
    const Triangle& t = mesh.facets[i];
    const Disc disc = disc_around(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
    const Vec3 centre = disc.centre - origin_;
    x_[i] = static_cast<float>(centre.x);
    y_[i] = static_cast<float>(centre.y);
    z_[i] = static_cast<float>(centre.z);
    normal_x_[i] = static_cast<float>(disc.normal.x);
    normal_y_[i] = static_cast<float>(disc.normal.y);
    normal_z_[i] = static_cast<float>(disc.normal.z);
    radius_[i] = static_cast<float>(disc.radius);
    facet_[i] = static_cast<std::uint32_t>(i);
  }
}

void FacetDiscs::resize(std::size_t count) {
  const std::size_t filled_up = (count + kTogether - 1) / kTogether * kTogether;
  for (auto* values : {&x_, &y_, &z_, &normal_x_, &normal_y_, &normal_z_, &radius_, &lower_}) {
    values->resize(filled_up);
  }
  std::fill(x_.begin() + static_cast<std::ptrdiff_t>(count), x_.end(), kNowhere);
  facet_.resize(count);
}

/// With h the height of p over the disc's plane and g its distance from the axis, the nearest
/// point of the disc is sqrt(h^2 + max(0, g - radius)^2) away.
template <typename Judge>
[[gnu::always_inline]] inline void FacetDiscs::measure_from(const Vec3& p, Judge judge) noexcept {
  const Vec3 q = p - origin_;
  const auto px = static_cast<float>(q.x);
  const auto py = static_cast<float>(q.y);
  const auto pz = static_cast<float>(q.z);
  const std::size_t count = lower_.size();
  for (std::size_t first = 0; first < count; first += kTogether) {
    CARPUS_INDEPENDENT_TURNS
    for (std::size_t i = first; i < first + kTogether; ++i) {
      const float x = px - x_[i];
      const float y = py - y_[i];
      const float z = pz - z_[i];
      const float height = x * normal_x_[i] + y * normal_y_[i] + z * normal_z_[i];
      const float off_axis = std::sqrt(at_least_0(x * x + y * y + z * z - height * height));
      const float beyond = at_least_0(off_axis - radius_[i]);
      const float squared = height * height + beyond * beyond;
      lower_[i] = judge(
          {x, y, z, normal_x_[i], normal_y_[i], normal_z_[i], height, off_axis, beyond, squared});
    }
  }
}

CARPUS_WIDEST_VECTORS
NearestFacet FacetDiscs::nearest(const Vec3& p, double limit_mm, std::uint32_t hint) {
  measure_from(p, [](const Seen& seen) { return seen.squared; });
  NearestFacet best{limit_mm * limit_mm, NearestFacet::kNone, {}};
  float reach = 0;
  const auto set_reach = [&] {
    const double with_slack = std::sqrt(best.squared_distance) + slack_mm_;
    reach = static_cast<float>(with_slack * with_slack);
  };
  const auto improve = [&](std::uint32_t facet) {
    const NearestFacet found = nearest_on(*mesh_, facet, p);
    if (!(found.squared_distance < best.squared_distance)) return;
    best = found;
    set_reach();
  };
  set_reach();
  if (hint != NearestFacet::kNone) improve(hint);
  for (std::size_t i = 0; i < size(); ++i) {
    if (lower_[i] <= reach && facet_[i] != hint) improve(facet_[i]);
  }
  return best;
}

/// A ball about c with radius r, the point n of a facet at D from c.
///   No point c + w of the ball is farther from n than D + u w + r^2 / (2 (D - r)), u the unit
/// vector from n to c, if D > r. A disc at E from c, its nearest point in direction e, lies behind
/// the plane there, and so at least E + e w from c + w. It is nowhere the nearest where
/// E - D - r |e - u| - r^2 / (2 (D - r)) > 0.
CARPUS_WIDEST_VECTORS
std::uint32_t FacetDiscs::keep_nearest_in(const FacetBall& ball,
                                          double limit_mm,
                                          FacetDiscs& kept) {
  const double away = std::sqrt(ball.near.squared_distance);
  const double farthest = std::min(away + ball.radius, limit_mm) + ball.radius + slack_mm_;
  const bool bends = away > ball.radius;
  const auto radius = bends ? static_cast<float>(ball.radius) : 0.0F;
  const auto not_beyond =
      bends ? static_cast<float>(away + ball.radius * ball.radius / (2 * (away - ball.radius)) +
                                 turned_slack_mm_)
            : std::numeric_limits<float>::infinity();
  const auto farthest_squared = static_cast<float>(farthest * farthest);
  const Vec3 towards = bends ? (ball.centre - ball.near.point) / away : Vec3{};
  const auto ux = static_cast<float>(towards.x);
  const auto uy = static_cast<float>(towards.y);
  const auto uz = static_cast<float>(towards.z);
  // What is left out is put at infinity. By value: nothing has to be read again for each disc.
  measure_from(ball.centre, [=](const Seen& seen) {
    constexpr float kTiny = 1e-12F;
    const float distance = std::sqrt(seen.squared);
    const float upwards =
        seen.height * (ux * seen.normal_x + uy * seen.normal_y + uz * seen.normal_z);
    const float sideways = (seen.x * ux + seen.y * uy + seen.z * uz - upwards) *
                           (seen.beyond / (seen.off_axis + kTiny));
    const float same = (upwards + sideways) / (distance + kTiny);
    const float turned = std::sqrt(at_least_0(2.0F - 2.0F * same));
    const bool is_left_out =
        seen.squared > farthest_squared || distance - radius * turned > not_beyond;
    return is_left_out ? std::numeric_limits<float>::infinity() : seen.squared;
  });
  const std::size_t count = size();
  kept.resize(count);
  std::size_t next = 0;
  std::uint32_t best = NearestFacet::kNone;
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    if (!(lower_[i] <= farthest_squared)) continue;
    kept.x_[next] = x_[i];
    kept.y_[next] = y_[i];
    kept.z_[next] = z_[i];
    kept.normal_x_[next] = normal_x_[i];
    kept.normal_y_[next] = normal_y_[i];
    kept.normal_z_[next] = normal_z_[i];
    kept.radius_[next] = radius_[i];
    kept.facet_[next] = facet_[i];
    ++next;
    if (lower_[i] < least) {
      least = lower_[i];
      best = facet_[i];
    }
  }
  kept.resize(next);
  return best;
}

}  // namespace carpus::fields
