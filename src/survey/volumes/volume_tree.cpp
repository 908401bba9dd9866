// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/volumes/volume_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "geometry/tolerance.hpp"

namespace carpus::survey {
namespace {

Vec3 centre_of(const TrianglePoints& t) { return (t[0] + t[1] + t[2]) / 3; }

/// Of the covariance of the triangles' centres; a coordinate axis, as good as any other.
std::size_t axis_of_largest_variance(std::span<const TrianglePoints> triangles, const Vec3& mean) {
  Vec3 variance;
  for (const TrianglePoints& t : triangles) {
    const Vec3 d = centre_of(t) - mean;
    variance += {d.x * d.x, d.y * d.y, d.z * d.z};
  }
  if (variance.x >= variance.y && variance.x >= variance.z) return 0;
  return variance.y >= variance.z ? 1 : 2;
}

Vec3 checked(const Vec3& v, std::size_t facet) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!is_finite(v) || largest > kLargestCoordinate) {
    throw InvalidInput("facet " + std::to_string(facet) +
                       " of a surface has a corner that is not " + "finite or beyond 1e100 mm");
  }
  return without_tiny_coordinates(v);
}

}  // namespace

template <typename Volume>
VolumeTree<Volume>::VolumeTree(const TriangleMesh& surface) {
  if (surface.facets.size() > kMaxTriangles) {
    throw InvalidInput("a surface of " + std::to_string(surface.facets.size()) +
                       " triangles: at most " + std::to_string(kMaxTriangles));
  }
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    TrianglePoints t;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = surface.facets[f][i];
      if (v >= surface.vertices.size()) {
        throw InvalidInput("facet " + std::to_string(f) + " of a surface names vertex " +
                           std::to_string(v) + " of " + std::to_string(surface.vertices.size()));
      }
      t[i] = checked(surface.vertices[v], f);
      size_mm_ = std::max(size_mm_, std::abs(t[i].x) + std::abs(t[i].y) + std::abs(t[i].z));
    }
    triangles_.push_back(t);
  }
  facets_.resize(triangles_.size());
  std::iota(facets_.begin(), facets_.end(), 0U);
  if (triangles_.empty()) return;
  nodes_.reserve(2 * triangles_.size());
  nodes_.resize(1);
  build(0, 0, static_cast<std::uint32_t>(triangles_.size()), 0);
}

template <typename Volume>
void VolumeTree<Volume>::build(std::uint32_t node,
                               std::uint32_t begin,
                               std::uint32_t end,
                               std::size_t level) {
  depth_ = std::max(depth_, level);
  nodes_[node].volume = Volume::around({triangles_.data() + begin, triangles_.data() + end});
  nodes_[node].size = nodes_[node].volume.size();
  nodes_[node].is_leaf = end - begin == 1;
  if (nodes_[node].is_leaf) {
    nodes_[node].first = begin;
    return;
  }
  const std::uint32_t middle = split(begin, end);
  const auto left = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = left;
  nodes_.resize(nodes_.size() + 2);
  build(left, begin, middle, level + 1);
  build(left + 1, middle, end, level + 1);
}

template <typename Volume>
std::uint32_t VolumeTree<Volume>::split(std::uint32_t begin, std::uint32_t end) {
  const std::uint32_t count = end - begin;
  const std::span<TrianglePoints> triangles(triangles_.data() + begin, count);
  Vec3 mean;
  for (const TrianglePoints& t : triangles) mean += centre_of(t);
  mean = mean / static_cast<double>(count);
  const std::size_t axis = axis_of_largest_variance(triangles, mean);

  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  std::vector<double> keys(count);
  for (std::uint32_t i = 0; i < count; ++i) keys[i] = centre_of(triangles[i])[axis];
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    if (keys[i] != keys[j]) return keys[i] < keys[j];
    return facets_[begin + i] < facets_[begin + j];
  });
  const std::vector<TrianglePoints> old_triangles(triangles.begin(), triangles.end());
  const std::vector<std::uint32_t> old_facets(facets_.begin() + begin, facets_.begin() + end);
  std::uint32_t below = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    triangles[i] = old_triangles[order[i]];
    facets_[begin + i] = old_facets[order[i]];
    below += keys[i] < mean[axis] ? 1 : 0;
  }
  const bool is_even =
      below >= 1 && below < count && 4 * below >= count && 4 * (count - below) >= count;
  return begin + (is_even ? below : count / 2);
}

template class VolumeTree<AxisBox>;
template class VolumeTree<OrientedBox>;
template class VolumeTree<KDop<6>>;
template class VolumeTree<KDop<14>>;
template class VolumeTree<KDop<18>>;
template class VolumeTree<KDop<26>>;

}  // namespace carpus::survey
