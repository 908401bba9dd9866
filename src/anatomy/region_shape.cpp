// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/region_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "anatomy/symmetric_eigen.hpp"

namespace carpus::anatomy {
namespace {

/// A carpal bone that grazes the field of view touches it with less than this; the thinnest shaft
/// (metacarpal 5) has about 50.
constexpr double kCutFaceAreaMm2 = 20.0;
/// Enough to tell 1 mm from 4 mm between bones.
constexpr std::size_t kRimPoints = 1200;

struct CutFace {
  double area_mm2 = 0;
  Vec3 weighted_sum;
};

Vec3 centre_of(const GridGeometry& g, const VoxelIndex& v) {
  return g.patient_from_voxel(
      {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
}

/// Area of the volume's faces that the voxel touches [mm^2].
double face_area_at(const GridGeometry& g, const VoxelIndex& v) {
  const auto faces = [](int i, int n) { return (i == 0 ? 1 : 0) + (i + 1 == n ? 1 : 0); };
  return faces(v.x, g.size[0]) * g.spacing.y * g.spacing.z +
         faces(v.y, g.size[1]) * g.spacing.x * g.spacing.z +
         faces(v.z, g.size[2]) * g.spacing.x * g.spacing.y;
}

/// Calls visit(label, voxel, centre) for each voxel of a region.
template <typename Visit>
void for_region_voxels(const GridView<const std::uint16_t>& labels, const Visit& visit) {
  const GridGeometry& g = labels.geometry();
  std::size_t i = 0;
  for (int z = 0; z < g.size[2]; ++z) {
    for (int y = 0; y < g.size[1]; ++y) {
      for (int x = 0; x < g.size[0]; ++x, ++i) {
        if (labels[i] == 0) continue;
        const VoxelIndex v{x, y, z};
        visit(labels[i], v, centre_of(g, v));
      }
    }
  }
}

bool is_on_rim(const GridView<const std::uint16_t>& labels, const VoxelIndex& v) {
  const GridGeometry& g = labels.geometry();
  const std::uint16_t label = labels[v];
  const auto differs = [&](const VoxelIndex& n) { return g.contains(n) && labels[n] != label; };
  return differs({v.x - 1, v.y, v.z}) || differs({v.x + 1, v.y, v.z}) ||
         differs({v.x, v.y - 1, v.z}) || differs({v.x, v.y + 1, v.z}) ||
         differs({v.x, v.y, v.z - 1}) || differs({v.x, v.y, v.z + 1});
}

void thin_out(std::vector<Vec3>& points) {
  if (points.size() <= kRimPoints) return;
  std::vector<Vec3> kept;
  kept.reserve(kRimPoints);
  for (std::size_t k = 0; k < kRimPoints; ++k)
    kept.push_back(points[k * points.size() / kRimPoints]);
  points = std::move(kept);
}

/// A whole metacarpal or phalanx: at least this long (as a standard deviation) and this slender.
/// The longest carpal bone of the largest wrist has 9 mm and 1.8.
constexpr double kLongExtentMm = 9.0;
constexpr double kSlenderness = 2.2;

bool is_whole_long_bone(const BodyShape& shape) {
  return !shape.is_cut && shape.extents.x > kLongExtentMm &&
         shape.extents.x > kSlenderness * shape.extents.y;
}

SquareMatrix<3> covariance_of(const Moments& m) {
  const Vec3 c = m.sum / m.count;
  const auto entry = [&](std::size_t k, double a, double b) {
    return m.products[k] / m.count - a * b;
  };
  return {{{entry(0, c.x, c.x), entry(3, c.x, c.y), entry(4, c.x, c.z)},
           {0, entry(1, c.y, c.y), entry(5, c.y, c.z)},
           {0, 0, entry(2, c.z, c.z)}}};
}

/// Where the voxels of each long bone lie in memory: points would take six times as much, and those
/// of one bone at a time are enough.
std::vector<std::vector<std::uint32_t>> voxels_of_long_bones(
    const GridView<const std::uint16_t>& labels,
    const std::vector<BodyShape>& shapes) {
  CARPUS_CHECK(labels.values().size() <= std::numeric_limits<std::uint32_t>::max());
  std::vector<char> is_long;
  std::vector<std::vector<std::uint32_t>> voxels(shapes.size());
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    is_long.push_back(shapes[k].is_cut || is_whole_long_bone(shapes[k]) ? 1 : 0);
    if (is_long[k] != 0) voxels[k].reserve(static_cast<std::size_t>(shapes[k].moments.count));
  }
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    if (labels[i] == 0 || is_long[labels[i] - std::size_t{1}] == 0) continue;
    voxels[labels[i] - std::size_t{1}].push_back(static_cast<std::uint32_t>(i));
  }
  return voxels;
}

std::vector<Vec3> centres_of(const GridGeometry& g, const std::vector<std::uint32_t>& voxels) {
  std::vector<Vec3> points;
  points.reserve(voxels.size());
  for (const std::uint32_t i : voxels) points.push_back(centre_of(g, g.index_of(i)));
  return points;
}

/// A cut body's joint end: from where it is cut, which lies `available` mm behind its tip.
void measure_cut_body(const std::vector<Vec3>& points, const Vec3& face, BodyShape& shape) {
  const Vec3 centre = shape.moments.sum / shape.moments.count;
  const Vec3 towards_joint = normalized_or(centre - face, {0, 0, 1});
  double reach = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) reach = std::max(reach, dot(towards_joint, p));
  const double available = reach - dot(towards_joint, face);
  shape.ends.emplace_back(points, towards_joint, available, shape.piece_mm3);
  shape.moments = {};
  for (const Vec3& p : points) {
    if (dot(towards_joint, p) > reach - kJointEndLength) shape.moments.add(p);
  }
}

/// Either end of a whole long bone, to its middle.
void measure_both_ends(const std::vector<Vec3>& points, BodyShape& shape) {
  const auto eigen = eigen_of_symmetric<3>(covariance_of(shape.moments));
  const Vec3 axis{eigen.vectors[0][0], eigen.vectors[0][1], eigen.vectors[0][2]};
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vec3& p : points) {
    low = std::min(low, dot(axis, p));
    high = std::max(high, dot(axis, p));
  }
  for (const Vec3& towards : {axis, -axis}) {
    shape.ends.emplace_back(points, towards, (high - low) / 2, shape.piece_mm3);
  }
}

void measure_ends(const GridView<const std::uint16_t>& labels,
                  const std::vector<CutFace>& faces,
                  std::vector<BodyShape>& shapes) {
  const auto voxels = voxels_of_long_bones(labels, shapes);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (voxels[i].empty()) continue;
    const std::vector<Vec3> points = centres_of(labels.geometry(), voxels[i]);
    if (shapes[i].is_cut) {
      measure_cut_body(points, faces[i].weighted_sum / faces[i].area_mm2, shapes[i]);
    } else {
      measure_both_ends(points, shapes[i]);
    }
    std::erase_if(shapes[i].ends, [](const JointEnd& end) { return end.length_mm() < 1; });
  }
}

}  // namespace

void Moments::add(const Vec3& p) noexcept {
  count += 1;
  sum += p;
  const std::array<double, 6> pp{p.x * p.x, p.y * p.y, p.z * p.z, p.x * p.y, p.x * p.z, p.y * p.z};
  for (std::size_t k = 0; k < 6; ++k) products[k] += pp[k];
}

void Moments::add(const Moments& other) noexcept {
  count += other.count;
  sum += other.sum;
  for (std::size_t k = 0; k < 6; ++k) products[k] += other.products[k];
}

void summarise(BodyShape& shape) noexcept {
  const Moments& m = shape.moments;
  if (!(m.count > 0)) return;
  shape.volume_mm3 = m.count * shape.piece_mm3;
  shape.centroid = m.sum / m.count;
  const auto eigen = eigen_of_symmetric<3>(covariance_of(m));
  for (std::size_t k = 0; k < 3; ++k) shape.extents[k] = std::sqrt(std::max(eigen.values[k], 0.0));
}

std::vector<BodyShape> measure_shapes(const GridView<const std::uint16_t>& labels,
                                      std::uint16_t count) {
  const GridGeometry& g = labels.geometry();
  std::vector<BodyShape> shapes(count);
  std::vector<CutFace> faces(count);
  for (BodyShape& shape : shapes) shape.piece_mm3 = g.voxel_volume_mm3();
  for_region_voxels(labels, [&](std::uint16_t label, const VoxelIndex& v, const Vec3& p) {
    CARPUS_CHECK(label <= count);
    BodyShape& shape = shapes[label - std::size_t{1}];
    shape.moments.add(p);
    shape.bounds.include(p);
    if (is_on_rim(labels, v)) shape.rim.push_back(p);
    if (const double area = face_area_at(g, v); area > 0) {
      faces[label - std::size_t{1}].area_mm2 += area;
      faces[label - std::size_t{1}].weighted_sum += area * p;
    }
  });
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    shapes[i].is_cut = faces[i].area_mm2 > kCutFaceAreaMm2;
    thin_out(shapes[i].rim);
  }
  for (BodyShape& shape : shapes) summarise(shape);
  measure_ends(labels, faces, shapes);
  for (BodyShape& shape : shapes) summarise(shape);
  return shapes;
}

BodyShape joined(const BodyShape& a, const BodyShape& b) {
  CARPUS_CHECK(!a.is_cut && !b.is_cut);
  BodyShape both = a;
  both.moments.add(b.moments);
  both.bounds.include(b.bounds);
  both.rim.insert(both.rim.end(), b.rim.begin(), b.rim.end());
  both.ends.clear();
  summarise(both);
  return both;
}

double gap_between(const BodyShape& a, const BodyShape& b) {
  double best = std::numeric_limits<double>::infinity();
  for (const Vec3& p : a.rim) {
    for (const Vec3& q : b.rim) best = std::min(best, squared_length(p - q));
  }
  return std::sqrt(best);
}

}  // namespace carpus::anatomy
