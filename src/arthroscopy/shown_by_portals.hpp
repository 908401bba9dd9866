// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether a place on a joint's wall can be looked at by one of its usual portals, as the wrist is
// pulled: for what is laid into a joint and is to be found there.
#pragma once

#include <cstdint>
#include <vector>

#include "cases/arthroscopic_map.hpp"
#include "cases/case_data.hpp"
#include "geometry/pose.hpp"

namespace carpus::arthroscopy {

class ShownByPortals {
 public:
  /// Both must outlive it.
  ShownByPortals(const cases::CaseData& data, const cases::ArthroscopicMap& map);

  /// @param at  as scanned, going with that body [mm]
  [[nodiscard]] bool shows(std::uint8_t joint, std::uint8_t body, const Vec3& at) const;

 private:
  [[nodiscard]] bool has_room(std::uint8_t joint, const Vec3& at, double room_mm) const;
  [[nodiscard]] bool is_in_bone(const Vec3& at, double room_mm) const;
  [[nodiscard]] bool goes_in(const Vec3& eye, const Vec3& skin) const;
  [[nodiscard]] bool is_free(std::uint8_t joint, const Vec3& eye, const Vec3& to) const;

  const cases::CaseData& data_;
  const cases::ArthroscopicMap& map_;
  std::vector<Pose<frame::Patient, frame::Bone>> poses_;  ///< by body, pulled
  std::vector<Pose<frame::Bone, frame::Patient>> inverses_;
};

}  // namespace carpus::arthroscopy
