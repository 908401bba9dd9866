// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Rows are exact quotients N / D rounded once: N the cross product of two edges of a facet, D the
// height N . (v - origin), both in exact numbers. So a row's error is a few units in the last place
// however thin its facet is, and the radii and reach() below are proven.
#include "convex/polar_graph.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>

#include "core/error.hpp"
#include "geometry/exact_number.hpp"
#include "geometry/tolerance.hpp"

namespace carpus::convex {
namespace {

/// Bodies within these lengths, in doubles, neither overflow nor underflow in a product of four.
constexpr double kLargestLength = 0x1p100;
constexpr double kSmallestLength = 0x1p-100;
/// Outer over inner radius; beyond it the rows' rounding is as large as the gauge.
constexpr double kMostSlender = 0x1p40;

/// Interleaves the low 16 bits of both.
std::uint32_t morton(std::uint32_t a, std::uint32_t b) {
  std::uint32_t code = 0;
  for (std::uint32_t bit = 0; bit < 16; ++bit) {
    code |= (a >> bit & 1U) << (2 * bit) | (b >> bit & 1U) << (2 * bit + 1);
  }
  return code;
}

/// Along a space-filling curve over directions, so that faces near each other share cache lines.
std::uint64_t direction_code(const Vec3& d) {
  std::size_t major = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::abs(d[i]) > std::abs(d[major])) major = i;
  }
  const double length = std::abs(d[major]);
  if (!(length > 0)) return 0;
  const auto place = [&](std::size_t axis) {
    return static_cast<std::uint32_t>((d[axis % 3] / length + 1) * 0.5 * 65535);
  };
  const std::uint64_t side = 2 * major + (d[major] < 0 ? 1 : 0);
  return side << 32U | morton(place(major + 1), place(major + 2));
}

/// p with p . v = 1 on the facet's plane; zero where the origin is not strictly below it.
Vec3 polar_vertex(const ConvexPolytope& p, std::uint32_t facet, const Vec3& origin) {
  const Triangle& t = p.facets[facet];
  const ExactVec3 a(p.vertices[t[0]]);
  const ExactVec3 normal = cross(ExactVec3(p.vertices[t[1]]) - a, ExactVec3(p.vertices[t[2]]) - a);
  const ExactNumber height = dot(normal, a - ExactVec3(origin));
  if (height.sign() <= 0) return {};
  const std::int32_t scale = height.scale();
  const double d = height.scaled_double(scale);
  return {normal.x.scaled_double(scale) / d, normal.y.scaled_double(scale) / d,
          normal.z.scaled_double(scale) / d};
}

}  // namespace

PolarGraph::PolarGraph(const ConvexBody& body) : origin_(body.interior_point()) {
  const std::size_t faces = body.faces().size();
  if (faces > kMostFaces) {
    throw InvalidInput("a body with " + std::to_string(faces) + " faces; at most " +
                       std::to_string(kMostFaces) + " are possible");
  }
  std::vector<std::uint64_t> codes(faces);
  for (std::size_t f = 0; f < faces; ++f) {
    codes[f] = direction_code(body.face_plane(static_cast<std::uint32_t>(f)).normal);
  }
  face_of_body_.resize(faces);
  std::iota(face_of_body_.begin(), face_of_body_.end(), 0U);
  std::stable_sort(face_of_body_.begin(), face_of_body_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return codes[a] < codes[b]; });
  face_from_body_.resize(faces);
  for (std::uint32_t i = 0; i < faces; ++i) face_from_body_[face_of_body_[i]] = i;
  set_rows(body, face_of_body_);
  set_links(body, face_of_body_);
  set_triangles(body);
  set_fans(body);

  const double far = std::max({std::abs(origin_.x), std::abs(origin_.y), std::abs(origin_.z)});
  is_usable_ = far <= kLargestLength && outer_radius_mm_ <= kLargestLength &&
               inner_radius_mm_ >= kSmallestLength &&
               outer_radius_mm_ <= kMostSlender * inner_radius_mm_;
  if (!is_usable_) return;
  const double slenderness = outer_radius_mm_ / inner_radius_mm_;
  // |p . v| <= slenderness; the row's own 5 roundings and those of a sum of 4 rows.
  reach_ = 1 + 16 * kRoundoff * slenderness;
  // A row: 5 roundings of |p|, which is at most 1 / inner radius; its product: 3 more.
  row_error_ = 16 * kRoundoff / inner_radius_mm_;
  // Rounded spokes, the combination of three and the remainder: 8 roundings of |v| each.
  gauge_slack_ = 32 * kRoundoff * (1 + slenderness);
  fill_table();
}

void PolarGraph::set_rows(const ConvexBody& body, const std::vector<std::uint32_t>& order) {
  double longest = 0;
  bool is_inside = true;
  for (const std::uint32_t f : order) {
    const Vec3 p = polar_vertex(body.polytope(), body.faces()[f].facets.front(), origin_);
    const double size = length(p);
    is_inside = is_inside && size > 0;
    longest = std::max(longest, size);
    rows_.push_back({p.x, p.y, p.z, 0});
  }
  inner_radius_mm_ = is_inside ? (1 - 16 * kRoundoff) / longest : 0;
  outer_radius_mm_ = body.radius_mm() * (1 + 16 * kRoundoff);
}

void PolarGraph::set_links(const ConvexBody& body, const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> number(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) number[order[i]] = i;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    const std::vector<std::uint32_t>& around = body.faces()[order[i]].neighbours;
    std::uint64_t& links = rows_[i].links;
    if (around.size() == 3) {
      links = static_cast<std::uint64_t>(number[around[0]]) |
              static_cast<std::uint64_t>(number[around[1]]) << PolarRow::kIdBits |
              static_cast<std::uint64_t>(number[around[2]]) << 2 * PolarRow::kIdBits;
    } else {
      links = PolarRow::kHasList | static_cast<std::uint64_t>(around.size()) << 32U | lists_.size();
      for (const std::uint32_t f : around) lists_.push_back(number[f]);
    }
  }
}

void PolarGraph::set_triangles(const ConvexBody& body) {
  for (const Vec3& v : body.vertices()) spokes_.push_back(v - origin_);
  for (const std::uint32_t f : face_of_body_) {
    first_triangle_.push_back(static_cast<std::uint32_t>(triangles_.size()));
    for (const std::uint32_t facet : body.faces()[f].facets) {
      triangles_.push_back(body.polytope().facets[facet]);
    }
  }
  first_triangle_.push_back(static_cast<std::uint32_t>(triangles_.size()));
}

void PolarGraph::set_fans(const ConvexBody& body) {
  std::vector<std::uint32_t> number(size());
  for (std::uint32_t i = 0; i < size(); ++i) number[face_of_body_[i]] = i;
  for (std::uint32_t v = 0; v < body.vertices().size(); ++v) {
    first_of_fan_.push_back(static_cast<std::uint32_t>(fans_.size()));
    for (const std::uint32_t f : body.vertex_faces(v)) fans_.push_back(number[f]);
  }
  first_of_fan_.push_back(static_cast<std::uint32_t>(fans_.size()));
}

void PolarGraph::fill_table() {
  while (6 * table_side_ * table_side_ < 2 * size() && table_side_ < 128) table_side_ *= 2;
  while ((size() - 1) >> table_shift_ > 0xFFFFU) ++table_shift_;
  table_scale_ = table_side_ / 2.0;
  table_.assign(std::size_t{6} * table_side_ * table_side_, 0);
  std::uint32_t face = 0;
  for (std::size_t side = 0; side < 6; ++side) {
    for (std::uint32_t i = 0; i < table_side_; ++i) {
      for (std::uint32_t j = 0; j < table_side_; ++j) {
        const std::size_t major = side / 2;
        Vec3 d;
        d[major] = side % 2 == 0 ? 1 : -1;
        d[(major + 1) % 3] = (i + 0.5) / table_scale_ - 1;
        d[(major + 2) % 3] = (j + 0.5) / table_scale_ - 1;
        face = climb(face, d).face;
        table_[cell_of(d)] = static_cast<std::uint16_t>(face >> table_shift_);
      }
    }
  }
}

PolarTop PolarGraph::scan(const Vec3& d) const noexcept {
  PolarTop best{0, size(), rows_[0].gauge(d)};
  for (std::uint32_t f = 1; f < size(); ++f) {
    const double gauge = rows_[f].gauge(d);
    if (gauge > best.gauge) {
      best.gauge = gauge;
      best.face = f;
    }
  }
  return best;
}

double PolarGraph::bound_by_corners(std::uint32_t face, const Vec3& d) const noexcept {
  // d = sum of weight_i * spoke_i + rest, with weights cut at 0. The spokes' ends and the ball of
  // inner_radius are in the body, so the gauge is at most the sum of weights plus |rest| / radius:
  // true for any weights, however they were computed.
  double best = HUGE_VAL;
  for (std::uint32_t t = first_triangle_[face]; t < first_triangle_[face + 1]; ++t) {
    const Vec3& a = spokes_[triangles_[t][0]];
    const Vec3& b = spokes_[triangles_[t][1]];
    const Vec3& c = spokes_[triangles_[t][2]];
    const Vec3 bc = cross(b, c);
    const double scale = 1 / dot(a, bc);
    const double wa = std::max(0.0, dot(d, bc) * scale);
    const double wb = std::max(0.0, dot(d, cross(c, a)) * scale);
    const double wc = std::max(0.0, dot(d, cross(a, b)) * scale);
    const Vec3 rest = d - (a * wa + b * wb + c * wc);
    const double sum = wa + wb + wc;
    const double left = std::abs(rest.x) + std::abs(rest.y) + std::abs(rest.z);
    const double bound = sum + left / inner_radius_mm_ + gauge_slack_ * (1 + sum);
    if (bound < best) best = bound;
  }
  return best;
}

}  // namespace carpus::convex
