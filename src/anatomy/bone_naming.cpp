// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Measure the regions. 2. Name them as a left and as a right wrist; the cheaper wins. 3. Try
// each pair of near regions as one broken bone; keep the pair if that is cheaper still. 4. Lay the
// model's radius on the patient's for the coordinate system. 5. Tell the parts of a broken scaphoid
// apart.
#include "anatomy/bone_naming.hpp"

#include <algorithm>
#include <utility>

#include "anatomy/bone_fit.hpp"
#include "anatomy/detail/naming_search.hpp"
#include "anatomy/region_shape.hpp"

namespace carpus::anatomy {
namespace {

using detail::Naming;

/// Fragments of one bone lie closer than this; nonunion gaps are 1 to 3 mm.
constexpr double kFragmentGapMm = 4.0;
/// Two pieces together are no larger than this in a wrist of the model's size, whose largest carpal
/// bone, the capitate, has 2548 mm^3.
constexpr double kFragmentVolumeMm3 = 4500.0;
/// Fewer named bones that fit than this is not a wrist that anyone operates on.
constexpr std::size_t kLeastBones = 8;
/// Nothing of the wrist has its middle farther than this from the capitate, in a wrist of the
/// model's size; the nearest body beyond, a sesamoid of the thumb, lies at 65 mm.
constexpr double kFarMm = 55.0;

/// A naming of the bodies that are left when two regions count as one.
struct Account {
  Naming naming;
  std::vector<std::vector<std::size_t>> regions_of_body;
  std::vector<BodyShape> bodies;
};

Account account_of(const std::vector<BodyShape>& shapes,
                   std::optional<std::pair<std::size_t, std::size_t>> pair) {
  Account account;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (pair && i == pair->second) continue;
    const bool is_pair = pair && i == pair->first;
    account.bodies.push_back(is_pair ? joined(shapes[i], shapes[pair->second]) : shapes[i]);
    account.regions_of_body.push_back({i});
    if (is_pair) account.regions_of_body.back().push_back(pair->second);
  }
  return account;
}

bool could_be_fragments(const BodyShape& a, const BodyShape& b, double scale) {
  return !a.is_cut && !b.is_cut && a.ends.empty() && b.ends.empty() &&
         a.volume_mm3 + b.volume_mm3 < kFragmentVolumeMm3 * scale * scale * scale &&
         a.bounds.grown(kFragmentGapMm).overlaps(b.bounds) && gap_between(a, b) < kFragmentGapMm;
}

/// The cheapest account with one broken bone, or none if whole bones explain the regions better.
std::optional<Account> with_broken_bone(const std::vector<BodyShape>& shapes, const Naming& whole) {
  std::optional<Account> best;
  double best_cost = whole.cost;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (std::size_t j = i + 1; j < shapes.size(); ++j) {
      if (!could_be_fragments(shapes[i], shapes[j], whole.patient_from_model.scale)) continue;
      Account account = account_of(shapes, std::pair(i, j));
      account.naming = detail::best_naming_near(account.bodies, whole);
      if (!(account.naming.cost < best_cost)) continue;
      best_cost = account.naming.cost;
      best = std::move(account);
    }
  }
  return best;
}

void fit_frame(const Account& account, BoneNaming& result) {
  Similarity patient_from_model = account.naming.patient_from_model;
  const std::size_t radius = static_cast<std::size_t>(BoneId::Radius) - 1;
  if (const auto body = account.naming.body_of_bone[radius]) {
    const BoneFit fit = fit_bone(BoneId::Radius, account.bodies[*body].rim, account.naming.side,
                                 patient_from_model);
    patient_from_model = fit.patient_from_model;
    result.radius_misfit_mm = fit.rms_mm;
  }
  const Pose<frame::Patient, frame::Wrist> patient_from_wrist{patient_from_model.rotation,
                                                              patient_from_model.translation};
  result.wrist_from_patient = patient_from_wrist.inverse();
  result.scale = account.naming.patient_from_model.scale;
}

/// Marks the two pieces of a scaphoid: the proximal one lies farther along the wrist's +x.
void tell_parts_apart(const std::vector<BodyShape>& shapes,
                      const std::vector<std::size_t>& regions,
                      BoneNaming& result) {
  if (regions.size() != 2) return;
  std::optional<RegionName>& first = result.regions[regions[0]];
  std::optional<RegionName>& second = result.regions[regions[1]];
  if (!first || !second || first->bone != BoneId::Scaphoid) return;
  const auto along = [&](std::size_t i) {
    return (result.wrist_from_patient * Point<frame::Patient>{shapes[i].centroid}).v.x;
  };
  const bool first_is_proximal = along(regions[0]) >= along(regions[1]);
  first->part = first_is_proximal ? BonePart::Proximal : BonePart::Distal;
  second->part = first_is_proximal ? BonePart::Distal : BonePart::Proximal;
}

/// Fingers, sesamoids, a table's edge: farther from the capitate (from the middle of all bones
/// where there is none) than the shafts of a wrist of this size begin.
std::size_t count_far_bodies(const Account& account) {
  const auto& of_bone = account.naming.body_of_bone;
  std::vector<bool> is_named(account.bodies.size(), false);
  Vec3 middle;
  double count = 0;
  for (const auto& body : of_bone) {
    if (!body) continue;
    is_named[*body] = true;
    middle += account.bodies[*body].centroid;
    count += 1;
  }
  if (!(count > 0)) return 0;
  middle = middle / count;
  if (const auto capitate = of_bone[static_cast<std::size_t>(BoneId::Capitate) - 1]) {
    middle = account.bodies[*capitate].centroid;
  }
  const double far_mm = kFarMm * account.naming.patient_from_model.scale;
  std::size_t far = 0;
  for (std::size_t i = 0; i < account.bodies.size(); ++i) {
    if (!is_named[i] && distance(account.bodies[i].centroid, middle) > far_mm) ++far;
  }
  return far;
}

/// Missing bones are said by name; whether the rest fits is judged without them, and one bone that
/// fits badly does not condemn the others.
NamingStatus judge(const BoneNaming& result) {
  double fit = 0;
  double worst = 0;
  std::size_t good = 0;
  std::size_t named = 0;
  for (const auto& region : result.regions) {
    if (!region || region->part == BonePart::Distal) continue;
    fit += region->cost;
    worst = std::max(worst, region->cost);
    named += 1;
    good += region->cost < kSuspiciousBoneCost ? 1 : 0;
  }
  if (named < kLeastBones || good < kLeastBones) return NamingStatus::NotAWrist;
  if (fit >= kDoubtfulNamingCost || worst >= kSuspiciousBoneCost) return NamingStatus::Doubtful;
  return result.missing.empty() ? NamingStatus::Ok : NamingStatus::Incomplete;
}

}  // namespace

BoneNaming name_bones(const GridView<const std::uint16_t>& regions, std::uint16_t count) {
  BoneNaming result;
  const std::vector<BodyShape> shapes = measure_shapes(regions, count);
  result.regions.resize(count);
  if (count < 3) {  // no orientation can be found
    result.status = NamingStatus::NotAWrist;
    result.missing.assign(kAllBones.begin(), kAllBones.end());
    return result;
  }
  Account account = account_of(shapes, std::nullopt);
  Naming other = detail::best_naming(account.bodies, Side::Right);
  account.naming = detail::best_naming(account.bodies, Side::Left);
  if (other.cost < account.naming.cost) std::swap(other, account.naming);
  if (auto broken = with_broken_bone(shapes, account.naming)) {
    account = std::move(*broken);
    other = detail::best_naming(account.bodies, other.side);
  }
  result.side = account.naming.side;
  const std::size_t far = count_far_bodies(account);
  result.cost = account.naming.cost - detail::kNamelessCost * static_cast<double>(far);
  result.far_bodies = far;
  result.other_side_cost = other.cost - detail::kNamelessCost * static_cast<double>(far);
  fit_frame(account, result);
  for (std::size_t b = 0; b < kBoneCount; ++b) {
    const auto body = account.naming.body_of_bone[b];
    if (!body) {
      result.missing.push_back(kAllBones[b]);
      continue;
    }
    for (const std::size_t region : account.regions_of_body[*body]) {
      result.regions[region] =
          RegionName{kAllBones[b], BonePart::Whole, account.naming.bone_cost[b]};
    }
    tell_parts_apart(shapes, account.regions_of_body[*body], result);
  }
  result.status = judge(result);
  return result;
}

}  // namespace carpus::anatomy
