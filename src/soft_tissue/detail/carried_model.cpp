// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/detail/carried_model.hpp"

#include <algorithm>

namespace carpus::soft_tissue::detail {
namespace {

/// Beyond the hand's bases nothing here attaches.
constexpr std::array<bool, kBoneCount> needed() {
  std::array<bool, kBoneCount> is_needed{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(BoneId::Hamate); ++i) is_needed[i] = true;
  return is_needed;
}

}  // namespace

CarriedModel::CarriedModel(const cases::CaseData& data)
    : laid_(cases::lay_model(data, needed())), mirror_(data.side == Side::Left ? 1 : -1) {
  std::vector<double> sizes;
  for (const auto& fit : laid_.bones) {
    if (fit) sizes.push_back(fit->patient_from_model.scale);
  }
  if (sizes.empty()) return;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  size_ = *middle;
}

Vec3 CarriedModel::point(BoneId bone, const Vec3& left) const {
  return fit(bone)->patient_from_model * Vec3{left.x, mirror_ * left.y, left.z};
}

Vec3 CarriedModel::way(BoneId bone, const Vec3& left) const {
  return fit(bone)->patient_from_model.rotation * Vec3{left.x, mirror_ * left.y, left.z};
}

Vec3 CarriedModel::way_of_wrist(const Vec3& left) const {
  return laid_.wrist.rotation * Vec3{left.x, mirror_ * left.y, left.z};
}

double CarriedModel::worst_misfit_mm() const noexcept {
  double worst = 0;
  for (const auto& fit : laid_.bones) {
    if (fit) worst = std::max(worst, fit->rms_mm);
  }
  return worst;
}

}  // namespace carpus::soft_tissue::detail
