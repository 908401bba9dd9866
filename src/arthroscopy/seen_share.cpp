// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/seen_share.hpp"

#include "cases/joint_under_block.hpp"

namespace carpus::arthroscopy {
namespace {

/// A facet does not hide itself: its own surface begins so far before it [mm].
constexpr double kBeforeMm = 0.02;

}  // namespace

SeenCartilage::SeenCartilage(const cases::CaseData& data, const cases::ArthroscopicMap& map)
    : data_(data), map_(map), disc_(map.disc), seen_(map.cartilage.size()) {
  std::vector<bool> is_near(data.bones.size());
  for (const cases::CartilageFacet& f : map.cartilage) is_near[f.body] = true;
  for (std::size_t b = 0; b < data.bones.size(); ++b) {
    const TriangleMesh nothing;
    const TriangleMesh& surface = data.bones[b].surface;
    trees_.emplace_back(is_near[b] ? surface : nothing);
  }
}

bool SeenCartilage::is_hidden(const Vec3& eye, const Vec3& at) const {
  const auto local = [&](std::size_t body, const Vec3& p) {
    return (inverses_[body] * Point<frame::Patient>{p}).v;
  };
  const std::size_t with_disc = map_.forearm;
  if (disc_.is_between(local(with_disc, eye), local(with_disc, at))) return true;
  for (std::size_t b = 0; b < trees_.size(); ++b) {
    if (trees_[b].is_between(local(b, eye), local(b, at))) return true;
  }
  return false;
}

void SeenCartilage::look(const Sight& sight, const anatomy::HandPose& wrist, std::uint8_t joint) {
  std::vector<Pose<frame::Patient, frame::Bone>> poses;
  inverses_.clear();
  for (const cases::Bone& bone : data_.bones) {
    poses.push_back(cases::pose_under_block(data_.hand_motion, bone.bone, wrist));
    inverses_.push_back(poses.back().inverse());
  }
  const std::vector<cases::CartilageFacet>& facets = map_.cartilage;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    if (seen_[i] || facets[i].joint != joint) continue;
    const Vec3 at = (poses[facets[i].body] * Point<frame::Bone>{facets[i].at}).v;
    const Vec3 to = at - sight.eye;
    const double far = length(to);
    if (!(far <= kUsefulMm && far > 0) || dot(to, sight.axis) < sight.least_cosine * far) continue;
    const Vec3 normal = (poses[facets[i].body] * Direction<frame::Bone>{facets[i].normal}).v;
    if (-dot(to, normal) < kUsefulCosine * far) continue;
    seen_[i] = !is_hidden(sight.eye, at + normal * kBeforeMm);
  }
}

double SeenCartilage::share() const noexcept {
  double seen = 0;
  double all = 0;
  const auto& facets = map_.cartilage;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    all += facets[i].area_mm2;
    if (seen_[i]) seen += facets[i].area_mm2;
  }
  return all > 0 ? seen / all : 0;
}

double SeenCartilage::share_of(std::uint8_t body) const noexcept {
  double seen = 0;
  double all = 0;
  const auto& facets = map_.cartilage;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    if (facets[i].body != body) continue;
    all += facets[i].area_mm2;
    if (seen_[i]) seen += facets[i].area_mm2;
  }
  return all > 0 ? seen / all : 0;
}

}  // namespace carpus::arthroscopy
