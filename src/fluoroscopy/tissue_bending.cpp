// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Once: distance to each body on a grid of about 3 mm: voxels of the body are offered to the nodes
// around them, then nodes offer what they have to their 26 neighbours, in raster order there
// and back, twice (vector distance propagation [danielsson1980euclidean]; far exact enough for
// weights).
// A point: its distance to each body is read where the body's inverse pose takes the point. Of two
// segments the farther has the share of share_of(); within a segment, bodies likewise.
#include "fluoroscopy/tissue_bending.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "core/check.hpp"
#include "core/parallel.hpp"
#include "geometry/trilinear.hpp"

namespace carpus::fluoroscopy {
namespace {

constexpr double kNodeMm = 3.0;
/// At this distance tissue moves with a bone as if it touched it [mm]: keeps bones that lie side by
/// side from changing places within the width of their joint.
constexpr double kNearestMm = 1.0;
constexpr std::size_t kMostBodies = 64;

GridGeometry nodes_for(const GridGeometry& g) {
  GridGeometry nodes = g;
  for (std::size_t a = 0; a < 3; ++a) {
    const double extent = (g.size[a] - 1) * g.spacing[a];
    nodes.size[a] = std::max(2, static_cast<int>(std::ceil(extent / kNodeMm)) + 1);
    nodes.spacing[a] = std::max(extent, g.spacing[a]) / (nodes.size[a] - 1);
  }
  return nodes;
}

/// Nodes with the nearest voxel of a body that each has heard of.
class NearestVoxels {
 public:
  explicit NearestVoxels(const GridGeometry& nodes)
      : nodes_(nodes), nearest_(nodes.voxel_count()), squared_(nodes.voxel_count(), kFar) {}

  /// To the corners of the cell that holds the point: all that is within a cell of a node is
  /// compared with that node itself, only what is farther is heard from others.
  void offer_around(const Vec3& point) noexcept {
    const Vec3 v = nodes_.voxel_from_patient(point);
    std::array<int, 3> low{};
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::clamp(static_cast<int>(v[a]), 0, nodes_.size[a] - 2);
    }
    for (int corner = 0; corner < 8; ++corner) {
      offer({low[0] + (corner & 1), low[1] + ((corner >> 1) & 1), low[2] + (corner >> 2)}, point);
    }
  }

  void propagate() noexcept {
    for (int pass = 0; pass < 4; ++pass) {
      const auto count = static_cast<int>(nodes_.voxel_count());
      for (int i = 0; i < count; ++i) {
        hear_neighbours(
            nodes_.index_of(static_cast<std::size_t>(pass % 2 == 0 ? i : count - 1 - i)));
      }
    }
  }

  [[nodiscard]] Grid<float> distances() const {
    Grid<float> result(nodes_);
    for (std::size_t i = 0; i < squared_.size(); ++i) {
      result[i] = static_cast<float>(std::sqrt(squared_[i]));
    }
    return result;
  }

 private:
  static constexpr double kFar = 1e12;

  void offer(const VoxelIndex& node, const Vec3& point) noexcept {
    const std::size_t at = nodes_.offset_of(node);
    const Vec3 way = point - position(node);
    const double squared = dot(way, way);
    if (!(squared < squared_[at])) return;
    squared_[at] = squared;
    nearest_[at] = point;
  }

  [[nodiscard]] Vec3 position(const VoxelIndex& v) const noexcept {
    return nodes_.patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
  }
  void hear_neighbours(const VoxelIndex& v) noexcept {
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const VoxelIndex other{v.x + dx, v.y + dy, v.z + dz};
          if (!nodes_.contains(other)) continue;
          const std::size_t from = nodes_.offset_of(other);
          if (squared_[from] < kFar) offer(v, nearest_[from]);
        }
      }
    }
  }

  GridGeometry nodes_;
  std::vector<Vec3> nearest_;
  std::vector<double> squared_;
};

/// Distance at a point; beyond the grid, the border's plus the way to it.
double distance_at(const Grid<float>& field, const Vec3& p) noexcept {
  const GridGeometry& g = field.geometry();
  const Vec3 v = g.voxel_from_patient(p);
  Vec3 inside;
  double outside = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    inside[a] = std::clamp(v[a], 0.0, g.size[a] - 1.0);
    const double away = (v[a] - inside[a]) * g.spacing[a];
    outside += away * away;
  }
  return sample_trilinear(field.view(), inside, 0.0) + (outside > 0 ? std::sqrt(outside) : 0.0);
}

/// Weight of what is `distance` away beside the weight 1 of what is `nearest` away. The share
/// weight / (1 + weight) falls smoothly from 1/2 at equal distances to 0 at four times the
/// distance.
double weight_beside(double nearest, double distance) noexcept {
  const double t = (nearest / (nearest + distance) - 0.2) / 0.6;
  if (!(t > 0)) return 0.0;
  const double share = t * t * (3 - 2 * t);
  return share / (1 - share);
}

}  // namespace

TissueBending::TissueBending(const GridView<const std::uint8_t>& labels,
                             std::span<const BodyLabel> bodies) {
  CARPUS_CHECK(bodies.size() <= kMostBodies);
  const GridGeometry& g = labels.geometry();
  const GridGeometry nodes = nodes_for(g);
  std::array<int, 256> body_of{};
  body_of.fill(-1);
  std::map<int, std::size_t> segments;
  for (const BodyLabel& body : bodies) segments.try_emplace(body.segment, 0);
  for (auto& [segment, number] : segments) number = segments_++;
  std::vector<NearestVoxels> nearest;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    body_of[bodies[b].label] = static_cast<int>(b);
    nearest.emplace_back(nodes);
    fields_.push_back({segments.at(bodies[b].segment), {}});
  }
  std::vector<char> has_voxels(bodies.size(), 0);
  std::size_t i = 0;
  for (int z = 0; z < g.size[2]; ++z) {
    for (int y = 0; y < g.size[1]; ++y) {
      for (int x = 0; x < g.size[0]; ++x, ++i) {
        const int body = body_of[labels[i]];
        if (body < 0) continue;
        const Vec3 p = g.patient_from_voxel(
            {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
        nearest[static_cast<std::size_t>(body)].offer_around(p);
        has_voxels[static_cast<std::size_t>(body)] = 1;
      }
    }
  }
  parallel_for(bodies.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      if (has_voxels[b] == 0) continue;
      nearest[b].propagate();
      fields_[b].to_body = nearest[b].distances();
    }
  });
}

std::optional<std::size_t> TissueBending::nearest_body(const Vec3& scanned) const noexcept {
  std::optional<std::size_t> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < fields_.size(); ++b) {
    if (fields_[b].to_body.values().empty()) continue;
    const double distance = distance_at(fields_[b].to_body, scanned);
    if (!(distance < least)) continue;
    least = distance;
    nearest = b;
  }
  return nearest;
}

BentTissue::BentTissue(const TissueBending& bending,
                       std::span<const Pose<frame::Patient, frame::Bone>> patient_from_bone)
    : bending_(bending) {
  CARPUS_CHECK(patient_from_bone.size() == bending.body_count());
  for (const Pose<frame::Patient, frame::Bone>& pose : patient_from_bone) {
    back_.push_back(pose.inverse());
    motions_.push_back(dual_quaternion(back_.back().rotation, back_.back().translation));
    if (!(pose == patient_from_bone.front())) is_rigid_ = false;
  }
}

Vec3 BentTissue::source_of(const Point<frame::Patient>& now) const noexcept {
  if (back_.empty()) return now.v;
  if (is_rigid_) return (back_.front() * now).v;
  std::array<double, kMostBodies> distances{};
  std::array<double, kMostBodies> nearest{};  // of each segment
  nearest.fill(std::numeric_limits<double>::infinity());
  double nearest_of_all = std::numeric_limits<double>::infinity();
  const std::size_t count = back_.size();
  for (std::size_t b = 0; b < count; ++b) {
    const auto& field = bending_.fields_[b];
    distances[b] = std::numeric_limits<double>::infinity();
    if (field.to_body.values().empty()) continue;
    distances[b] = std::max(kNearestMm, distance_at(field.to_body, (back_[b] * now).v));
    nearest[field.segment] = std::min(nearest[field.segment], distances[b]);
    nearest_of_all = std::min(nearest_of_all, distances[b]);
  }
  if (!(nearest_of_all < std::numeric_limits<double>::infinity())) return now.v;
  RigidBlend blend;
  for (std::size_t s = 0; s < bending_.segments_; ++s) {
    const double share = weight_beside(nearest_of_all, nearest[s]);
    if (!(share > 0)) continue;
    RigidBlend within;
    for (std::size_t b = 0; b < count; ++b) {
      if (bending_.fields_[b].segment != s) continue;
      const double weight = weight_beside(nearest[s], distances[b]);
      if (weight > 0) within.add(motions_[b], weight);
    }
    blend.add(within, share);
  }
  return blend.moved(now.v);
}

}  // namespace carpus::fluoroscopy
