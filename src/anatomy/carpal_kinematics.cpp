// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/carpal_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "anatomy/symmetric_eigen.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace carpus::data {
std::string_view carpal_kinematics();
}  // namespace carpus::data

namespace carpus::anatomy {
namespace {

using Json = nlohmann::json;

/// No figure of this model is larger, in degrees, mm or N.
constexpr double kLargestFigure = 1000;

double number_of(const Json& json, const char* key) {
  const double value = json.at(key).get<double>();
  if (!(std::abs(value) <= kLargestFigure)) throw InvalidInput(std::string(key) + " is impossible");
  return value;
}

QuadraticSurface surface_of(const Json& json) {
  QuadraticSurface s;
  s.flexion = number_of(json, "F");
  s.deviation = number_of(json, "R");
  s.flexion_squared = number_of(json, "FF");
  s.deviation_squared = number_of(json, "RR");
  s.product = number_of(json, "FR");
  if (json.contains("low_deg")) s.low_deg = number_of(json, "low_deg");
  if (json.contains("high_deg")) s.high_deg = number_of(json, "high_deg");
  return s;
}

RotationSurfaces surfaces_of(const Json& json) {
  const Json& rotation = json.at("rotation");
  return {surface_of(rotation.at("x")), surface_of(rotation.at("y")), surface_of(rotation.at("z"))};
}

Interval interval_of(const Json& limits, const char* key, double unit) {
  const auto ends = limits.at(key).get<std::array<double, 2>>();
  if (!(ends[0] <= 0 && ends[1] >= 0 && std::abs(ends[0]) <= kLargestFigure &&
        std::abs(ends[1]) <= kLargestFigure)) {
    throw InvalidInput(std::string(key) + " does not hold neutral");
  }
  return {ends[0] * unit, ends[1] * unit};
}

/// The data names its bones for people; the groups are fixed in code.
void check_bones(const Json& json, CarpalGroup group) {
  for (const Json& name : json.at("bones")) {
    const auto bone = bone_of(name.get<std::string>());
    if (!bone || group_of(bone->bone) != group) {
      throw InvalidInput("'" + name.get<std::string>() + "' is no bone of the group " +
                         std::string(name_of(group)));
    }
  }
}

/// Second moments of a closed surface's volume about its centroid (not normalised).
SquareMatrix<3> second_moments(const TriangleMesh& mesh, const Vec3& centroid) {
  SquareMatrix<3> m{};
  for (const Triangle& t : mesh.facets) {
    const Vec3 a = mesh.vertices[t[0]] - centroid;
    const Vec3 b = mesh.vertices[t[1]] - centroid;
    const Vec3 c = mesh.vertices[t[2]] - centroid;
    const double six_volumes = dot(a, cross(b, c));
    const Vec3 s = a + b + c;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        m[i][j] += six_volumes * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + s[i] * s[j]) / 120.0;
      }
    }
  }
  return m;
}

Mat3 rotation_of(const Vec3& vector_deg) {
  const double angle_deg = length(vector_deg);
  if (!(angle_deg > 0)) return Mat3::identity();
  return rotation_about(vector_deg / angle_deg, radians_from_degrees(angle_deg));
}

}  // namespace

CarpalGroup group_of(BoneId bone) noexcept {
  switch (bone) {
    case BoneId::Ulna:
      return CarpalGroup::Ulna;
    case BoneId::Radius:
      return CarpalGroup::Radius;
    case BoneId::Scaphoid:
      return CarpalGroup::Scaphoid;
    case BoneId::Lunate:
      return CarpalGroup::Lunate;
    case BoneId::Triquetrum:
    case BoneId::Pisiform:
      return CarpalGroup::Triquetrum;
    default:
      return CarpalGroup::Hand;
  }
}

std::string_view name_of(CarpalGroup group) noexcept {
  constexpr std::array<std::string_view, kCarpalGroupCount> names{
      "ulna", "radius", "hand", "scaphoid", "lunate", "triquetrum"};
  return names[static_cast<std::size_t>(group)];
}

double QuadraticSurface::value_deg(double f, double r) const noexcept {
  const double value = flexion * f + deviation * r + flexion_squared * f * f +
                       deviation_squared * r * r + product * f * r;
  return std::clamp(value, low_deg, high_deg);
}

const CarpalKinematics& CarpalKinematics::published() {
  static const CarpalKinematics model = parse(data::carpal_kinematics());
  return model;
}

CarpalKinematics CarpalKinematics::parse(std::string_view json_text) {
  try {
    const Json json = Json::parse(json_text);
    CarpalKinematics model;
    const Json& neutral = json.at("neutral");
    model.neutral_capitate_flexion_deg_ = number_of(neutral, "capitate_axis_flexion_deg");
    model.neutral_capitate_deviation_deg_ =
        number_of(neutral, "capitate_axis_radial_deviation_deg");
    const Json& limits = json.at("limits");
    const double degree = radians_from_degrees(1);
    model.limits_ = {interval_of(limits, "flexion_deg", degree),
                     interval_of(limits, "radial_deviation_deg", degree),
                     interval_of(limits, "pronation_from_scan_deg", degree),
                     interval_of(limits, "traction_n", 1)};
    check_bones(json.at("hand"), CarpalGroup::Hand);
    check_bones(json.at("scaphoid"), CarpalGroup::Scaphoid);
    check_bones(json.at("lunate"), CarpalGroup::Lunate);
    check_bones(json.at("triquetrum"), CarpalGroup::Triquetrum);
    model.hand_ = surfaces_of(json.at("hand"));
    model.scaphoid_ = surfaces_of(json.at("scaphoid"));
    model.lunate_ = surfaces_of(json.at("lunate"));
    model.triquetrum_share_of_hand_ =
        number_of(json.at("triquetrum").at("between"), "share_of_second");
    model.centre_share_ = number_of(json.at("centre"), "share_of_capitate_from_proximal");
    model.axes_apart_mm_ = number_of(json.at("centre"), "flexion_to_deviation_axis_mm");
    model.radiocarpal_mm_per_n_ = number_of(json.at("traction"), "radiocarpal_mm_per_n");
    model.midcarpal_mm_per_n_ = number_of(json.at("traction"), "midcarpal_mm_per_n");
    return model;
  } catch (const Json::exception& error) {
    throw InvalidInput(std::string("carpal kinematics: ") + error.what());
  } catch (const InvalidInput& error) {
    throw InvalidInput(std::string("carpal kinematics: ") + error.what());
  }
}

Vec3 CarpalKinematics::rotation_vector_deg(CarpalGroup group,
                                           double flexion_deg,
                                           double deviation_deg) const noexcept {
  const auto vector_of = [&](const RotationSurfaces& s) {
    return Vec3{s[0].value_deg(flexion_deg, deviation_deg),
                s[1].value_deg(flexion_deg, deviation_deg),
                s[2].value_deg(flexion_deg, deviation_deg)};
  };
  switch (group) {
    case CarpalGroup::Hand:
      return vector_of(hand_);
    case CarpalGroup::Scaphoid:
      return vector_of(scaphoid_);
    case CarpalGroup::Lunate:
      return vector_of(lunate_);
    case CarpalGroup::Triquetrum:
      return vector_of(lunate_) * (1 - triquetrum_share_of_hand_) +
             vector_of(hand_) * triquetrum_share_of_hand_;
    default:
      return {};
  }
}

Mat3 CarpalKinematics::rotation_from_neutral(CarpalGroup group,
                                             const HandPose& pose,
                                             Side side) const noexcept {
  Vec3 vector = rotation_vector_deg(group, degrees_from_radians(pose.flexion_rad),
                                    degrees_from_radians(pose.radial_deviation_rad));
  if (side == Side::Right) vector = {-vector.x, vector.y, -vector.z};  // mirrored by y
  return rotation_of(vector);
}

Pose<frame::Wrist, frame::Wrist> CarpalKinematics::motion_from_neutral(CarpalGroup group,
                                                                       const HandPose& pose,
                                                                       const Vec3& centre,
                                                                       Side side) const noexcept {
  const Mat3 turn = rotation_from_neutral(group, pose, side);
  // The deviation axis lies distally of the flexion axis: the more of the motion is deviation, the
  // further distal the point that stays. Weights of squares keep the motion smooth through neutral.
  const double ff = pose.flexion_rad * pose.flexion_rad;
  const double rr = pose.radial_deviation_rad * pose.radial_deviation_rad;
  const double share = ff + rr > 0 ? rr / (ff + rr) : 0.5;
  const Vec3 fixed = centre - Vec3{1, 0, 0} * (axes_apart_mm_ * (share - 0.5));
  return {turn, fixed - turn * fixed};
}

Pose<frame::Wrist, frame::Wrist> CarpalKinematics::motion_from_scan(CarpalGroup group,
                                                                    const HandPose& pose,
                                                                    const WristLandmarks& landmarks,
                                                                    Side side) const noexcept {
  const auto neutral_to_pose = motion_from_neutral(group, pose, landmarks.centre, side);
  const auto neutral_to_scan = motion_from_neutral(group, landmarks.scan, landmarks.centre, side);
  return neutral_to_pose * neutral_to_scan.inverse();
}

WristLandmarks CarpalKinematics::landmarks_of(const MeshIn<frame::Wrist>& capitate,
                                              Side side) const {
  if (capitate.facets.empty()) {
    throw InvalidInput("carpal kinematics: the wrist has no capitate to tell how the hand is held");
  }
  const Vec3 centroid = centroid_of(capitate);
  const auto eigen = eigen_of_symmetric<3>(second_moments(capitate, centroid));
  const auto& v = eigen.vectors[0];
  Vec3 distal = normalized_or({v[0], v[1], v[2]}, {0, 0, 0});
  // A tenth more than the second axis: rounder than that, "long" means nothing.
  if (!(eigen.values[0] > 1.1 * eigen.values[1]) || !(length(distal) > 0)) {
    throw InvalidInput("carpal kinematics: the capitate has no long axis; is it named rightly?");
  }
  if (distal.x > 0) distal = -distal;
  WristLandmarks landmarks;
  landmarks.hand_axis = distal;
  const double radial = side == Side::Left ? -distal.y : distal.y;
  HandPose scan;
  scan.flexion_rad =
      std::atan2(distal.z, -distal.x) - radians_from_degrees(neutral_capitate_flexion_deg_);
  scan.radial_deviation_rad = std::asin(std::clamp(radial, -1.0, 1.0)) -
                              radians_from_degrees(neutral_capitate_deviation_deg_);
  landmarks.scan = limits_.clamp(scan);
  double low = 1e30;
  double high = -1e30;
  for (const Vec3& vertex : capitate.vertices) {
    const double along = dot(vertex - centroid, distal);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  landmarks.centre = centroid + distal * (low + centre_share_ * (high - low));
  return landmarks;
}

}  // namespace carpus::anatomy
