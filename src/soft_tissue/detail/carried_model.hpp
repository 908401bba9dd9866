// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Places of the generic wrist on this case's bones.
#pragma once

#include "cases/lay_model.hpp"
#include "soft_tissue/detail/surroundings.hpp"

namespace carpus::soft_tissue::detail {

class CarriedModel {
 public:
  explicit CarriedModel(const cases::CaseData& data);

  /// Whether the bone is there and the generic one could be laid on it.
  [[nodiscard]] bool has(BoneId bone) const noexcept { return fit(bone).has_value(); }
  /// How badly [mm rms]; for a bone that is there.
  [[nodiscard]] double misfit_mm(BoneId bone) const { return fit(bone)->rms_mm; }
  /// A point told in the frame Wrist of a left wrist.
  [[nodiscard]] Vec3 point(BoneId bone, const Vec3& left) const;
  /// A direction, likewise.
  [[nodiscard]] Vec3 way(BoneId bone, const Vec3& left) const;
  [[nodiscard]] Vec3 way_of_wrist(const Vec3& left) const;
  /// The wrist's size against the generic one: the median of its bones'.
  [[nodiscard]] double size() const noexcept { return size_; }
  [[nodiscard]] double worst_misfit_mm() const noexcept;
  /// 1 for a left wrist, -1 for a right one: of what turns one way round.
  [[nodiscard]] double mirror() const noexcept { return mirror_; }

 private:
  [[nodiscard]] const std::optional<anatomy::BoneFit>& fit(BoneId bone) const noexcept {
    return laid_.bones[static_cast<std::size_t>(bone) - 1];
  }
  cases::LaidModel laid_;
  double mirror_ = 1;  ///< of y: the table is of a left wrist
  double size_ = 1;
};

}  // namespace carpus::soft_tissue::detail
