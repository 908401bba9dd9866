// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A point's value for one ellipsoid with semi-axes r is e = k0 (k0 - 1) / k1 with k0 = |l / r| and
// k1 = |l / r^2| in the ellipsoid's axes: a first-order distance. The bone is the smooth minimum
// m - k ln sum exp(-(e_i - m) / k) of its ellipsoids, m = min e_i, so the value never exceeds m and
// never falls below m - k ln n.
#include "anatomy/wrist_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "core/check.hpp"
#include "core/error.hpp"

namespace carpus::data {
std::string_view wrist_model();
}  // namespace carpus::data

namespace carpus::anatomy {
namespace {

using Json = nlohmann::json;

/// Keeps k0 / k1 defined at an ellipsoid's centre, as the model's formula writes it [1].
constexpr double kCentreGuard = 1e-9;
/// Step of the grid on which bounds are found [mm]; half of the smallest semi-axis of any bone.
constexpr double kBoundsStepMm = 1.0;
/// Largest believable coordinate or semi-axis of a wrist [mm]; beyond it the text has other units.
constexpr double kLargestLengthMm = 1000.0;

constexpr std::size_t slot_of(BoneId bone) { return static_cast<std::size_t>(bone) - 1; }

double ellipsoid_value(const ModelEllipsoid& e, const Vec3& point) {
  const Vec3 l = e.wrist_from_axes.transposed() * (point - e.centre);
  const Vec3 a{l.x / e.semi_axes.x, l.y / e.semi_axes.y, l.z / e.semi_axes.z};
  const Vec3 b{a.x / e.semi_axes.x, a.y / e.semi_axes.y, a.z / e.semi_axes.z};
  const double k0 = length(a) + kCentreGuard;
  const double k1 = length(b) + kCentreGuard;
  return k0 * (k0 - 1.0) / k1;
}

double union_value(const ModelBone& bone, const Vec3& point) {
  double sum = 0.0;
  double least = std::numeric_limits<double>::infinity();
  const double k = bone.blend_radius_mm;
  for (const ModelEllipsoid& e : bone.ellipsoids) {  // running log-sum-exp: one pass, no array
    const double value = ellipsoid_value(e, point);
    if (value < least) {
      sum = sum * std::exp((value - least) / k) + 1.0;
      least = value;
    } else {
      sum += std::exp((least - value) / k);
    }
  }
  return least - k * std::log(sum);
}

double cut_value(const ModelBone& bone, const Vec3& point) {
  const double value = union_value(bone, point);
  return bone.cut_plane ? std::max(value, bone.cut_plane->signed_distance(point)) : value;
}

/// Box of all ellipsoids, grown by what the blend can add.
Aabb generous_box(const ModelBone& bone) {
  Aabb box;
  for (const ModelEllipsoid& e : bone.ellipsoids) {
    const Mat3& r = e.wrist_from_axes;
    Vec3 half;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 row = r.rows[i];
      half[i] = length({row.x * e.semi_axes.x, row.y * e.semi_axes.y, row.z * e.semi_axes.z});
    }
    box.include(e.centre - half);
    box.include(e.centre + half);
  }
  // Twice the blend's reach, since the value understates distance outside an ellipsoid.
  const double reach = bone.blend_radius_mm * std::log(static_cast<double>(bone.ellipsoids.size()));
  return box.grown(2.0 * reach);
}

/// Samples the bone; a point of the bone further than a step from every inside sample would have to
/// belong to a spike thinner than any ellipsoid here.
Aabb find_bounds(const ModelBone& bone) {
  const Aabb outer = generous_box(bone);
  Aabb box;
  for (double x = outer.low.x; x <= outer.high.x; x += kBoundsStepMm) {
    for (double y = outer.low.y; y <= outer.high.y; y += kBoundsStepMm) {
      for (double z = outer.low.z; z <= outer.high.z; z += kBoundsStepMm) {
        const Vec3 p{x, y, z};
        if (bone.cut_plane && bone.cut_plane->signed_distance(p) > 0) continue;
        if (union_value(bone, p) < 0) box.include(p);
      }
    }
  }
  return box.grown(kBoundsStepMm);
}

Vec3 vector_of(const Json& json, double largest) {
  const auto v = json.get<std::array<double, 3>>();
  for (const double c : v) {
    if (!(std::abs(c) <= largest)) throw InvalidInput("a length is not within 1000 mm");
  }
  return {v[0], v[1], v[2]};
}

ModelEllipsoid ellipsoid_of(const Json& json) {
  ModelEllipsoid e;
  e.centre = vector_of(json.at("centre_mm"), kLargestLengthMm);
  e.semi_axes = vector_of(json.at("semi_axes_mm"), kLargestLengthMm);
  if (!(e.semi_axes.x > 0 && e.semi_axes.y > 0 && e.semi_axes.z > 0)) {
    throw InvalidInput("semi_axes_mm must be positive");
  }
  const auto q = json.at("quaternion_wxyz").get<std::array<double, 4>>();
  const double norm = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  if (!(norm > 0.5 && norm < 2.0)) throw InvalidInput("quaternion_wxyz is not a unit quaternion");
  e.wrist_from_axes = rotation_from_quaternion(q[0], q[1], q[2], q[3]);
  return e;
}

ModelBone bone_from(const Json& json, BoneId id) {
  ModelBone bone;
  bone.bone = id;
  bone.blend_radius_mm = json.at("blend_radius_mm").get<double>();
  if (!(bone.blend_radius_mm > 0)) throw InvalidInput("blend_radius_mm must be positive");
  for (const Json& e : json.at("ellipsoids")) bone.ellipsoids.push_back(ellipsoid_of(e));
  if (bone.ellipsoids.empty()) throw InvalidInput("ellipsoids is empty");
  if (json.contains("cut_plane")) {
    const Json& plane = json.at("cut_plane");
    const Vec3 normal = vector_of(plane.at("normal"), 1.1);
    const double size = length(normal);
    if (!(size > 0.5)) throw InvalidInput("cut_plane.normal is not a unit vector");
    bone.cut_plane = Plane{normal / size, plane.at("offset_mm").get<double>() / size};
    bone.shaft_axis = normalized_or(vector_of(json.at("shaft_axis_towards_cut"), 1.1), normal);
  }
  bone.volume_mm3 = json.at("volume_mm3").get<double>();
  for (const Json& check : json.value("check_values", Json::array())) {
    bone.check_values.push_back(
        {vector_of(check.at("point_mm"), kLargestLengthMm), check.at("f_mm").get<double>()});
  }
  bone.bounds = find_bounds(bone);
  if (bone.bounds.is_empty()) throw InvalidInput("the ellipsoids enclose nothing within the cut");
  return bone;
}

Vec3 mirrored_point(const Vec3& p) { return {p.x, -p.y, p.z}; }

/// Conjugating with the mirror keeps a rotation a rotation: axes y -> -y on both sides.
Mat3 mirrored_rotation(const Mat3& m) {
  Mat3 r = m;
  r.rows[0].y = -r.rows[0].y;
  r.rows[1].x = -r.rows[1].x;
  r.rows[1].z = -r.rows[1].z;
  r.rows[2].y = -r.rows[2].y;
  return r;
}

ModelBone mirrored_bone(ModelBone bone) {
  for (ModelEllipsoid& e : bone.ellipsoids) {
    e.centre = mirrored_point(e.centre);
    e.wrist_from_axes = mirrored_rotation(e.wrist_from_axes);
  }
  if (bone.cut_plane) bone.cut_plane->normal = mirrored_point(bone.cut_plane->normal);
  bone.shaft_axis = mirrored_point(bone.shaft_axis);
  Aabb box;
  box.include(mirrored_point(bone.bounds.low));
  box.include(mirrored_point(bone.bounds.high));
  bone.bounds = box;
  for (ModelCheckValue& check : bone.check_values) check.point = mirrored_point(check.point);
  return bone;
}

}  // namespace

const WristModel& WristModel::generic(Side side) {
  static const WristModel kLeft = parse(data::wrist_model());
  static const WristModel kRight = kLeft.mirrored();
  return side == Side::Left ? kLeft : kRight;
}

WristModel WristModel::parse(std::string_view json_text) {
  WristModel model;
  std::string where = "wrist model";
  try {
    const Json json = Json::parse(json_text);
    if (json.at("version").get<int>() != 1) {
      throw InvalidInput("version is not 1; use the wrist_model.json of this program's version");
    }
    for (const Json& entry : json.at("bones")) {
      const auto name = entry.at("name").get<std::string>();
      where = "wrist model, bone '" + name + "'";
      const auto named = bone_of(name);
      if (!named || named->part != BonePart::Whole) throw InvalidInput("no such bone");
      ModelBone& slot = model.bones_[slot_of(named->bone)];
      if (!slot.ellipsoids.empty()) throw InvalidInput("given twice");
      slot = bone_from(entry, named->bone);
    }
    where = "wrist model";
    for (const BoneId bone : kAllBones) {
      if (model.bone(bone).ellipsoids.empty()) {
        throw InvalidInput("bone '" + std::string(name_of(bone)) + "' is missing");
      }
    }
  } catch (const Json::exception& error) {
    throw InvalidInput(where + ": " + error.what());
  } catch (const InvalidInput& error) {
    throw InvalidInput(where + ": " + error.what());
  }
  return model;
}

WristModel WristModel::mirrored() const {
  WristModel other = *this;
  other.side_ = side_ == Side::Left ? Side::Right : Side::Left;
  std::transform(bones_.begin(), bones_.end(), other.bones_.begin(), mirrored_bone);
  return other;
}

const ModelBone& WristModel::bone(BoneId bone) const noexcept {
  CARPUS_ASSERT(slot_of(bone) < kBoneCount);
  return bones_[slot_of(bone)];
}

double WristModel::signed_value(BoneId id, const Vec3& point_in_wrist) const noexcept {
  return cut_value(bone(id), point_in_wrist);
}

double WristModel::uncut_value(BoneId id, const Vec3& point_in_wrist) const noexcept {
  return union_value(bone(id), point_in_wrist);
}

}  // namespace carpus::anatomy
