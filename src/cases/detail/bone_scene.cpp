// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/detail/bone_scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fields/distance_field.hpp"

namespace carpus::cases::detail {
namespace {

using anatomy::CarpalGroup;
using Relative = Pose<frame::Bone, frame::Bone>;

/// More than a moved box may miss of a moved point.
constexpr double kRoundingMm = 1e-6;

const Pose<frame::Patient, frame::Bone>& pose_of(const GroupPoses& poses, CarpalGroup group) {
  return poses[static_cast<std::size_t>(group)];
}

/// The box about a moved box.
Aabb moved(const Aabb& box, const Relative& motion) {
  const Vec3 middle = (motion * Point<frame::Bone>{box.centre()}).v;
  const Vec3 half = box.extent() * 0.5;
  Vec3 reach;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& row = motion.rotation.rows[i];
    reach[i] = std::abs(row.x) * half.x + std::abs(row.y) * half.y + std::abs(row.z) * half.z;
  }
  Aabb result;
  result.include(middle - reach);
  result.include(middle + reach);
  return result;
}

}  // namespace

BoneScene::BoneScene(const CaseData& data) {
  std::array<double, anatomy::kCarpalGroupCount> counts{};
  for (const Bone& bone : data.bones) {
    Body body{anatomy::group_of(bone.bone), &bone, {}, {}};
    const auto g = static_cast<std::size_t>(body.group);
    for (std::size_t i = 0; i < bone.surface.vertices.size(); ++i) {
      const Vec3& v = bone.surface.vertices[i];
      if (i % kRunVertices == 0) body.runs.emplace_back();
      body.runs.back().include(v);
      body.box.include(v);
      middles_[g] += v;
      counts[g] += 1;
    }
    if (!bone.surface.vertices.empty()) bodies_.push_back(std::move(body));
  }
  for (std::size_t g = 0; g < middles_.size(); ++g) {
    if (counts[g] > 0) middles_[g] = middles_[g] / counts[g];
  }
  const std::size_t n = bodies_.size();
  scan_gaps_.assign(n * n, kFarMm);
  visit_near({}, kFarMm, [&](std::size_t a, std::size_t b, const Vec3&, double distance_mm) {
    double& gap = scan_gaps_[a * n + b];
    gap = std::min(gap, distance_mm);
    scan_gaps_[b * n + a] = std::min(scan_gaps_[b * n + a], gap);
  });
}

bool BoneScene::has(CarpalGroup group) const noexcept {
  return std::any_of(bodies_.begin(), bodies_.end(),
                     [&](const Body& body) { return body.group == group; });
}

template <typename Visit>
void BoneScene::visit_near(const GroupPoses& poses, double margin_mm, const Visit& visit) const {
  for (std::size_t a = 0; a < bodies_.size(); ++a) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const Body& on = bodies_[a];
      const Body& to = bodies_[b];
      if (on.group == to.group) continue;
      const Relative relative = pose_of(poses, to.group).inverse() * pose_of(poses, on.group);
      const Aabb reach = to.box.grown(margin_mm);
      const Aabb with_slack = reach.grown(kRoundingMm);
      if (!moved(on.box, relative).overlaps(with_slack)) continue;
      const std::vector<Vec3>& vertices = on.bone->surface.vertices;
      for (std::size_t run = 0; run < on.runs.size(); ++run) {
        if (!moved(on.runs[run], relative).overlaps(with_slack)) continue;
        const std::size_t end = std::min(vertices.size(), (run + 1) * kRunVertices);
        for (std::size_t i = run * kRunVertices; i < end; ++i) {
          const Vec3 p = (relative * Point<frame::Bone>{vertices[i]}).v;
          if (!reach.contains(p)) continue;
          const auto sample = fields::sample_distance(to.bone->distance_field, p);
          if (sample.is_inside_grid && sample.distance_mm < margin_mm) {
            visit(a, b, vertices[i], sample.distance_mm);
          }
        }
      }
    }
  }
}

std::vector<NearPoint> BoneScene::near_points(const GroupPoses& poses, double margin_mm) const {
  std::vector<NearPoint> result;
  visit_near(poses, margin_mm, [&](std::size_t a, std::size_t b, const Vec3& v, double) {
    result.push_back({a, b, v});
  });
  return result;
}

Separation BoneScene::separation_of(const NearPoint& near, const GroupPoses& poses) const noexcept {
  const Body& to = bodies_[near.to];
  const auto& patient_from_to = pose_of(poses, to.group);
  const Point<frame::Patient> p =
      pose_of(poses, bodies_[near.on].group) * Point<frame::Bone>{near.point};
  const auto sample =
      fields::sample_distance(to.bone->distance_field, (patient_from_to.inverse() * p).v);
  if (!sample.is_inside_grid) return {kFarMm, {}};
  return {sample.distance_mm, patient_from_to.rotation * normalized_or(sample.gradient, {0, 0, 0})};
}

double BoneScene::overlap_mm(const GroupPoses& poses) const {
  double overlap = 0;
  visit_near(poses, 0.0, [&](std::size_t a, std::size_t b, const Vec3&, double distance_mm) {
    const double in_scan = std::max(0.0, -scan_gap_mm(a, b));
    overlap = std::max(overlap, -distance_mm - in_scan);
  });
  return overlap;
}

double BoneScene::scan_overlap_mm() const {
  double overlap = 0;
  for (const double gap : scan_gaps_) overlap = std::max(overlap, -gap);
  return overlap;
}

}  // namespace carpus::cases::detail
