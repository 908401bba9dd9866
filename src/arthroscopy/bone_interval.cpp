// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Both distance fields, asked where each bone has the place: half their difference is how far it is
// beyond the middle of the interval, their sum how wide the interval is there, as scanned.
#include "arthroscopy/bone_interval.hpp"

#include <algorithm>
#include <array>

#include "arthroscopy/band_table.hpp"
#include "arthroscopy/detail/joint_of.hpp"
#include "fields/distance_field.hpp"

namespace carpus::arthroscopy {
namespace {

constexpr double kLeastSlope = 0.1;  // faces that are parallel have no mouth near
constexpr double kLeastFacing = 0.3;
constexpr double kBesideMm = 1.0;  // farther beside it nothing of it is known

}  // namespace

std::optional<BoneInterval> interval_of(const cases::CaseData& data,
                                        const cases::ArthroscopicMap& map,
                                        const cases::LigamentBand& band) {
  const BandTable& table = BandTable::generic();
  const TabledBand* tabled = table.band(band.id);
  if (tabled == nullptr) return std::nullopt;
  const auto joint = detail::joint_of(map, tabled->behind);
  if (!joint) return std::nullopt;
  return BoneInterval{&data.bones[band.first].distance_field,
                      &data.bones[band.second].distance_field, table.cartilage_mm, *joint};
}

BesideBone beside_bone(const Grid<float>& own,
                       const Grid<float>& other,
                       double cartilage_mm,
                       const Pose<frame::Bone, frame::Patient>& bone,
                       const Vec3& at) noexcept {
  BesideBone made;
  made.deep_mm = -2 * kBesideMm;
  const Vec3 local = (bone * Point<frame::Patient>{at}).v;
  const fields::DistanceSample a = fields::sample_distance(own, local);
  if (!a.is_inside_grid) return made;
  const fields::DistanceSample b = fields::sample_distance(other, local);
  if (!b.is_inside_grid) return made;
  const Vec3 onwards = a.gradient - b.gradient;
  // Faces that lean from each other, as at a rim, have their middle nearer than that.
  made.beyond_mm = (a.distance_mm - b.distance_mm) / std::max(length(onwards), 2 * kLeastFacing);
  const double left = cartilage_mm - a.distance_mm - b.distance_mm;
  if (left < -2 * kBesideMm) return made;
  const auto to_patient = bone.inverse();
  const Vec3 wider = a.gradient + b.gradient;
  made.is_near = left > 0;
  made.deep_mm = left / std::max(length(wider), kLeastSlope);
  made.across = normalized_or((to_patient * Direction<frame::Bone>{onwards}).v, {});
  made.to_mouth = normalized_or((to_patient * Direction<frame::Bone>{wider}).v, {});
  return made;
}

InInterval in_interval(const BoneInterval& interval,
                       const Pose<frame::Bone, frame::Patient>& first,
                       const Pose<frame::Bone, frame::Patient>& second,
                       const Vec3& at,
                       double radius_mm) noexcept {
  const std::array<BesideBone, 2> sides{
      beside_bone(*interval.first, *interval.second, interval.cartilage_mm, first, at),
      beside_bone(*interval.second, *interval.first, interval.cartilage_mm, second, at)};
  InInterval made;
  const bool is_open = sides[0].beyond_mm + sides[1].beyond_mm >= 2 * radius_mm;
  const bool is_one_gone = !sides[0].is_near || !sides[1].is_near;
  for (const BesideBone& side : sides) {
    const double aside = radius_mm - side.beyond_mm;
    if (!side.is_near || !(aside > 0)) continue;
    // Too narrow for it: out by the mouth alone, for aside lies the other one.
    const bool goes_aside = (is_open || is_one_gone) && aside < side.deep_mm;
    const double depth = goes_aside ? aside : side.deep_mm;
    if (depth <= made.depth_mm) continue;
    made.depth_mm = depth;
    made.out = goes_aside ? side.across : side.to_mouth;
  }
  if (!is_open || !(sides[0].beyond_mm >= 0) || !(sides[1].beyond_mm >= 0)) return made;
  made.is_between = sides[0].is_near || sides[1].is_near;
  const BesideBone& nearer = sides[0].deep_mm > sides[1].deep_mm ? sides[0] : sides[1];
  if (!made.is_between && nearer.deep_mm > -kBesideMm) {
    made.off_mm = -nearer.deep_mm;
    made.back = -nearer.to_mouth;
  }
  return made;
}

}  // namespace carpus::arthroscopy
