// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/support.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/tolerance.hpp"

namespace carpus::convex {
namespace {

constexpr int kCellsPerSide = 16;
constexpr std::size_t kCells = std::size_t{6} * kCellsPerSide * kCellsPerSide;

/// `axis` 0 to 2 and the sign choose the cube's face, u and v in [-1, 1] the cell.
std::size_t cell_of(const Vec3& d) noexcept {
  const double x = std::abs(d.x);
  const double y = std::abs(d.y);
  const double z = std::abs(d.z);
  std::size_t face = 0;
  double along = d.x;
  double u = d.y;
  double v = d.z;
  if (y > x && y >= z) {
    face = 2;
    along = d.y;
    u = d.z;
    v = d.x;
  } else if (z > x) {
    face = 4;
    along = d.z;
    u = d.x;
    v = d.y;
  }
  if (along < 0) face += 1;
  const double scale = 0.5 * kCellsPerSide / std::abs(along);
  const auto cell = [&](double w) {
    const double c = w * scale + 0.5 * kCellsPerSide;
    // Written so that what is not a number gives cell 0.
    return c > 0 ? static_cast<std::size_t>(std::min(c, kCellsPerSide - 1.0)) : std::size_t{0};
  };
  return (face * kCellsPerSide + cell(u)) * kCellsPerSide + cell(v);
}

Vec3 middle_of_cell(std::size_t cell) noexcept {
  const auto v = static_cast<double>(cell % kCellsPerSide);
  const auto u = static_cast<double>(cell / kCellsPerSide % kCellsPerSide);
  const std::size_t face = cell / (std::size_t{kCellsPerSide} * kCellsPerSide);
  Vec3 d;
  const std::size_t axis = face / 2;
  d[axis] = face % 2 == 0 ? 1 : -1;
  d[(axis + 1) % 3] = (u + 0.5) * 2 / kCellsPerSide - 1;
  d[(axis + 2) % 3] = (v + 0.5) * 2 / kCellsPerSide - 1;
  return d;
}

}  // namespace

SupportGraph::SupportGraph(const ConvexBody& body) : centre_(body.interior_point()) {
  corners_.reserve(body.vertices().size());
  for (std::uint32_t i = 0; i < body.vertices().size(); ++i) {
    const std::span<const std::uint32_t> ends = body.vertex_neighbours(i);
    corners_.push_back({body.vertices()[i] - centre_,
                        static_cast<std::uint32_t>(neighbours_.size()),
                        static_cast<std::uint32_t>(ends.size())});
    neighbours_.insert(neighbours_.end(), ends.begin(), ends.end());
    radius_mm_ = std::max(radius_mm_, length(corners_.back().at));
  }
  table_.resize(kCells);
  std::uint32_t at = 0;
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    at = climb(middle_of_cell(cell), at);
    constexpr std::uint32_t kLargest = std::numeric_limits<std::uint16_t>::max();
    table_[cell] = at <= kLargest ? static_cast<std::uint16_t>(at) : std::uint16_t{0};
  }
}

inline SupportGraph::Rise SupportGraph::steepest_from(std::uint32_t from,
                                                      const Vec3& direction) const noexcept {
  const Corner& here = corners_[from];
  Rise best{from, -std::numeric_limits<double>::infinity()};
  for (std::uint32_t k = here.first; k < here.first + here.count; ++k) {
    const double height = dot(corners_[neighbours_[k]].at - here.at, direction);
    if (height > best.height) best = {neighbours_[k], height};
  }
  return best;
}

std::uint32_t SupportGraph::climb(const Vec3& direction, std::uint32_t from) const noexcept {
  // Heights are compared as differences along edges, whose rounding is relative to the edge: a
  // slope is wrong by a few roundings however short the edge, so the answer's height is too. Among
  // slopes that are rounding the walk could go round in circles, hence the limit.
  for (std::size_t step = 0; step < corners_.size(); ++step) {
    const Rise rise = steepest_from(from, direction);
    if (!(rise.height > 0)) break;
    from = rise.corner;
  }
  return from;
}

CertainTop SupportGraph::certain_climb(const Vec3& direction, std::uint32_t from) const noexcept {
  const double size =
      (std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z)) * radius_mm_;
  Rise rise = steepest_from(from, direction);
  for (std::size_t step = 0; step < corners_.size() && rise.height > 0; ++step) {
    from = rise.corner;
    rise = steepest_from(from, direction);
  }
  // A rise: corners rounded by u of their distance from the centre, their difference, three
  // products and two sums; under 12 u of `size`. A height: under 6 u. A small number for underflow.
  CertainTop top;
  top.corner = from;
  top.is_certain = rise.height < -(16 * kRoundoff * size + kUnderflowBound);
  top.reach = dot(direction, corners_[from].at) + 8 * kRoundoff * size + kUnderflowBound;
  return top;
}

std::uint32_t SupportGraph::near(const Vec3& direction) const noexcept {
  return table_[cell_of(direction)];
}

std::uint32_t SupportGraph::climb_with_table(const Vec3& direction,
                                             std::uint32_t from) const noexcept {
  const std::uint32_t start = near(direction);
  const bool is_higher = dot(corners_[start].at - corners_[from].at, direction) > 0;
  return climb(direction, is_higher ? start : from);
}

}  // namespace carpus::convex
