// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/lay_model.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "anatomy/model_shapes.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "fields/triangle_tree.hpp"

namespace carpus::cases {
namespace {

using anatomy::BoneFit;
using anatomy::Similarity;

/// Points of a bone that take part in its fit.
constexpr std::size_t kSamples = 220;
/// A fit to fewer points has lost its bone.
constexpr std::size_t kFewestPoints = 60;
/// Ways in which a hand may be held against the generic wrist's, to start from [deg of flexion].
constexpr std::array<double, 5> kStartsDeg{0, -25, 25, -50, 50};

/// What lies so near to the other part of a broken bone is a face of the fracture: no border of the
/// whole bone, of which the model's is.
constexpr double kFractureMm = 2.5;

/// A part's vertices, but for those on its fracture.
void add_border(const Bone& part, const Bone* other, std::vector<Vec3>& border) {
  if (other == nullptr) {
    border.insert(border.end(), part.surface.vertices.begin(), part.surface.vertices.end());
    return;
  }
  const fields::TriangleTree tree(other->surface);
  for (const Vec3& v : part.surface.vertices) {
    if (!tree.nearest(v, kFractureMm)) border.push_back(v);
  }
}

/// Every so many-th vertex of a bone, of both parts of a broken one.
std::vector<Vec3> samples_of(const CaseData& data, BoneId bone) {
  std::vector<Vec3> all;
  for (const Bone& b : data.bones) {
    if (b.bone != bone) continue;
    const auto other = std::find_if(data.bones.begin(), data.bones.end(), [&](const Bone& o) {
      return o.bone == bone && o.part != b.part;
    });
    add_border(b, other == data.bones.end() ? nullptr : &*other, all);
  }
  std::vector<Vec3> chosen;
  const std::size_t every = std::max<std::size_t>(1, all.size() / kSamples);
  for (std::size_t i = 0; i < all.size(); i += every) chosen.push_back(all[i]);
  return chosen;
}

Vec3 mean_of(const std::vector<Vec3>& points) {
  Vec3 sum;
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// A fit that lost most of its points is worth nothing.
double cost_of(const BoneFit& fit) {
  return fit.points_used < kFewestPoints ? std::numeric_limits<double>::infinity() : fit.rms_mm;
}

std::optional<BoneFit> best_fit(const CaseData& data, BoneId bone, const Similarity& wrist) {
  const std::vector<Vec3> border = samples_of(data, bone);
  if (border.size() < kFewestPoints) return std::nullopt;
  BoneFit best = anatomy::fit_bone(bone, border, data.side, wrist);
  if (!belongs_to_forearm(bone)) {
    const Vec3 middle = mean_of(border);
    const Vec3 model_middle =
        anatomy::generic_model_shapes(data.side)[static_cast<std::size_t>(bone) - 1].centroid;
    for (const double degrees : kStartsDeg) {
      Similarity start = wrist;
      start.rotation = wrist.rotation * rotation_about({0, 1, 0}, radians_from_degrees(degrees));
      start.translation = middle - start.scale * (start.rotation * model_middle);
      const BoneFit fit = anatomy::fit_bone(bone, border, data.side, start);
      if (cost_of(fit) < cost_of(best)) best = fit;
    }
  }
  if (!(cost_of(best) < std::numeric_limits<double>::infinity())) return std::nullopt;
  return best;
}

}  // namespace

LaidModel lay_model(const CaseData& data, const std::array<bool, kBoneCount>& is_needed) {
  const auto patient_from_wrist = data.wrist_from_patient.inverse();
  LaidModel laid;
  laid.wrist = {patient_from_wrist.rotation, 1, patient_from_wrist.translation};
  if (const auto radius = best_fit(data, BoneId::Radius, laid.wrist)) {
    laid.wrist = radius->patient_from_model;
  }
  parallel_for(kBoneCount, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (is_needed[i]) laid.bones[i] = best_fit(data, kAllBones[i], laid.wrist);
    }
  });
  return laid;
}

}  // namespace carpus::cases
