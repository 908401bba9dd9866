// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/kinematics_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "anatomy/carpal_kinematics.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace carpus::cli {
namespace {

using anatomy::CarpalGroup;
using anatomy::HandPose;
using Json = nlohmann::ordered_json;

constexpr std::array kComparedBones{BoneId::Scaphoid,  BoneId::Lunate,   BoneId::Triquetrum,
                                    BoneId::Hamate,    BoneId::Capitate, BoneId::Trapezium,
                                    BoneId::Trapezoid, BoneId::Pisiform};

double angle_deg(const Mat3& m) {
  const double cosine = (m.rows[0].x + m.rows[1].y + m.rows[2].z - 1) / 2;
  return degrees_from_radians(std::acos(std::clamp(cosine, -1.0, 1.0)));
}

/// Rotation vector [deg]; the angle must be under 180 degrees.
Vec3 rotation_vector_deg(const Mat3& m) {
  const Vec3 skew{m.rows[2].y - m.rows[1].z, m.rows[0].z - m.rows[2].x, m.rows[1].x - m.rows[0].y};
  return normalized_or(skew, {0, 0, 0}) * angle_deg(m);
}

/// Rotation of a group from the scan, in the Wrist frame.
Mat3 turn_in_wrist(const cases::CaseData& data, CarpalGroup group, const HandPose& pose) {
  const Mat3& wrist = data.wrist_from_patient.rotation;
  return wrist * data.hand_motion.poses_at(pose)[static_cast<std::size_t>(group)].rotation *
         wrist.transposed();
}

Mat3 matrix_of(const Json& json) {
  const auto r = json.get<std::array<std::array<double, 3>, 3>>();
  return {{Vec3{r[0][0], r[0][1], r[0][2]}, Vec3{r[1][0], r[1][1], r[1][2]},
           Vec3{r[2][0], r[2][1], r[2][2]}}};
}

Pose<frame::Wrist, frame::Wrist> motion_of(const Json& json) {
  const auto t = json.at("translation_mm").get<std::array<double, 3>>();
  return {matrix_of(json.at("rotation")), {t[0], t[1], t[2]}};
}

Vec3 middle_of(const cases::Bone& bone) {
  Vec3 sum;
  for (const Vec3& v : bone.surface.vertices) sum += v;
  return sum / static_cast<double>(bone.surface.vertices.size());
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

/// The hand pose that the capitate's rotation from the scan amounts to.
HandPose hand_pose_of(const cases::CaseData& data, const Mat3& capitate_from_scan) {
  const Mat3 scan = anatomy::CarpalKinematics::published().rotation_from_neutral(
      CarpalGroup::Hand, data.hand_motion.scan, data.side);
  const Vec3 vector = rotation_vector_deg(capitate_from_scan * scan);
  return {radians_from_degrees(vector.y), radians_from_degrees(vector.z), 0, 0};
}

MeasuredComparison comparison_of(const cases::CaseData& data, const Json& json) {
  MeasuredComparison result;
  for (const BoneId bone : kComparedBones) {
    if (bone != BoneId::Scaphoid && cases::find_bone(data, bone) == nullptr) continue;
    result.bones.push_back({bone, {}, {}, 0, 0});
  }
  const auto patient_from_wrist = data.wrist_from_patient.inverse();
  for (const Json& position : json.at("poses")) {
    const Json& bones = position.at("bones");
    const HandPose hand = hand_pose_of(data, motion_of(bones.at("capitate")).rotation);
    result.positions.push_back(position.at("name").get<std::string>());
    result.hand.push_back(hand);
    const auto poses = data.hand_motion.poses_at(hand);
    for (MeasuredBone& bone : result.bones) {
      const auto measured = motion_of(bones.at(std::string(name_of(bone.bone))));
      const CarpalGroup group = anatomy::group_of(bone.bone);
      const Mat3 turn = turn_in_wrist(data, group, hand);
      bone.rotation_error_deg.push_back(angle_deg(measured.rotation * turn.transposed()));
      const cases::Bone* body = cases::find_bone(data, bone.bone);
      if (body == nullptr) body = cases::find_bone(data, bone.bone, BonePart::Proximal);
      if (body == nullptr) throw InvalidInput("the case lacks a compared bone");
      const Point<frame::Patient> middle{middle_of(*body)};
      const Vec3 here = (poses[static_cast<std::size_t>(group)] * Point<frame::Bone>{middle.v}).v;
      const Point<frame::Wrist> there = measured * (data.wrist_from_patient * middle);
      bone.position_error_mm.push_back(distance(here, (patient_from_wrist * there).v));
    }
  }
  for (MeasuredBone& bone : result.bones) {
    bone.mean_rotation_error_deg = mean_of(bone.rotation_error_deg);
    bone.mean_position_error_mm = mean_of(bone.position_error_mm);
  }
  return result;
}

template <typename... Values>
void print(std::string& text, const char* format, Values... values) {
  std::array<char, 256> line{};
  std::snprintf(line.data(), line.size(), format, values...);
  text += line.data();
}

Json interval_deg(const anatomy::Interval& interval) {
  return {degrees_from_radians(interval.low), degrees_from_radians(interval.high)};
}

}  // namespace

std::vector<Coupling> couplings_of(const cases::CaseData& data) {
  const auto from_neutral = [&](CarpalGroup group, const HandPose& pose) {
    const Mat3 turn = turn_in_wrist(data, group, pose);
    const Mat3 neutral = turn_in_wrist(data, group, {});
    return rotation_vector_deg(turn * neutral.transposed()).y;
  };
  const auto coupling_at = [&](double flexion_deg, double deviation_deg) {
    const HandPose pose{radians_from_degrees(flexion_deg), radians_from_degrees(deviation_deg), 0,
                        0};
    return Coupling{flexion_deg, deviation_deg, from_neutral(CarpalGroup::Scaphoid, pose),
                    from_neutral(CarpalGroup::Lunate, pose),
                    from_neutral(CarpalGroup::Triquetrum, pose)};
  };
  std::vector<Coupling> couplings;
  for (const double f : {-80.0, -60.0, -40.0, -20.0, 20.0, 40.0, 60.0, 80.0}) {
    couplings.push_back(coupling_at(f, 0));
  }
  for (const double r : {-40.0, -30.0, -20.0, -10.0, 10.0, 20.0, 25.0}) {
    couplings.push_back(coupling_at(0, r));
  }
  return couplings;
}

MeasuredComparison compare_with_measured(const cases::CaseData& data, std::string_view json_text) {
  if (data.side != Side::Left) {
    throw InvalidInput("a measured motion is that of a left wrist, and the case is a right one");
  }
  try {
    return comparison_of(data, Json::parse(json_text));
  } catch (const Json::exception& error) {
    throw InvalidInput(std::string("no file of measured motions: ") + error.what());
  }
}

std::string kinematics_table(const cases::CaseData& data, const std::vector<Coupling>& couplings) {
  const cases::HandMotion& motion = data.hand_motion;
  const cases::HandMotionReport& report = motion.report;
  std::string text;
  print(text, "scan: flexion %.1f, radial deviation %.1f deg; table %zu x %zu\n\n",
        degrees_from_radians(motion.scan.flexion_rad),
        degrees_from_radians(motion.scan.radial_deviation_rad), motion.flexion_rad.size(),
        motion.deviation_rad.size());
  text += "hand from neutral, deg    turn about the flexion axis, deg (share of the hand's)\n";
  text += "flexion  deviation          scaphoid          lunate      triquetrum\n";
  for (const Coupling& c : couplings) {
    const double hand = c.flexion_deg != 0 ? c.flexion_deg : c.deviation_deg;
    print(text, "%7.0f    %7.0f    %7.1f (%4.0f%%) %7.1f (%4.0f%%) %7.1f (%4.0f%%)\n",
          c.flexion_deg, c.deviation_deg, c.scaphoid_deg, 100 * c.scaphoid_deg / hand, c.lunate_deg,
          100 * c.lunate_deg / hand, c.triquetrum_deg, 100 * c.triquetrum_deg / hand);
  }
  text += "\ncorrection against overlap   mean mm   max mm  mean deg  max deg\n";
  for (const CarpalGroup group : anatomy::kMovingGroups) {
    const auto& c = report.corrections[static_cast<std::size_t>(group)];
    print(text, "%-26s %9.2f %8.2f %9.1f %8.1f\n", std::string(name_of(group)).c_str(),
          c.mean_shift_mm, c.greatest_shift_mm, c.mean_turn_deg, c.greatest_turn_deg);
  }
  print(text,
        "\ngreatest overlap, mm: scan %.2f; beyond it: model %.2f, at nodes %.2f, between %.2f, "
        "in pronation %.2f\n",
        report.scan_overlap_mm, report.overlap_of_model_mm, report.overlap_at_nodes_mm,
        report.overlap_between_nodes_mm, report.overlap_in_pronation_mm);
  print(text, "more than 0.1 mm: %.1f%% of the nodes, %.1f%% between\n",
        100 * report.nodes_over_tenth_mm, 100 * report.cells_over_tenth_mm);
  return text;
}

std::string comparison_table(const MeasuredComparison& comparison) {
  std::string text = "\nrotation error, deg (position error of the middle, mm)\n            ";
  for (const std::string& name : comparison.positions) print(text, "%11s", name.c_str());
  text += "       mean\nflexion     ";
  for (const HandPose& hand : comparison.hand) {
    print(text, "%11.0f", degrees_from_radians(hand.flexion_rad));
  }
  text += "\ndeviation   ";
  for (const HandPose& hand : comparison.hand) {
    print(text, "%11.0f", degrees_from_radians(hand.radial_deviation_rad));
  }
  text += "\n";
  for (const MeasuredBone& bone : comparison.bones) {
    print(text, "%-12s", std::string(name_of(bone.bone)).c_str());
    for (std::size_t i = 0; i < bone.rotation_error_deg.size(); ++i) {
      print(text, "%5.1f (%3.1f)", bone.rotation_error_deg[i], bone.position_error_mm[i]);
    }
    print(text, "%5.1f (%3.1f)\n", bone.mean_rotation_error_deg, bone.mean_position_error_mm);
  }
  return text;
}

std::string kinematics_json(const cases::CaseData& data,
                            const std::vector<Coupling>& couplings,
                            const MeasuredComparison* comparison) {
  const cases::HandMotion& motion = data.hand_motion;
  const cases::HandMotionReport& report = motion.report;
  Json json;
  json["case"] = data.pseudonym;
  json["case_simulated"] = data.provenance.simulated;
  json["scan"] = {{"flexion_deg", degrees_from_radians(motion.scan.flexion_rad)},
                  {"radial_deviation_deg", degrees_from_radians(motion.scan.radial_deviation_rad)}};
  json["limits"] = {{"flexion_deg", interval_deg(motion.limits.flexion_rad)},
                    {"radial_deviation_deg", interval_deg(motion.limits.radial_deviation_rad)},
                    {"pronation_deg", interval_deg(motion.limits.pronation_rad)},
                    {"traction_n", {motion.limits.traction_n.low, motion.limits.traction_n.high}}};
  json["couplings"] = Json::array();
  for (const Coupling& c : couplings) {
    json["couplings"].push_back({{"flexion_deg", c.flexion_deg},
                                 {"radial_deviation_deg", c.deviation_deg},
                                 {"scaphoid_deg", c.scaphoid_deg},
                                 {"lunate_deg", c.lunate_deg},
                                 {"triquetrum_deg", c.triquetrum_deg}});
  }
  json["corrections"] = Json::array();
  for (const CarpalGroup group : anatomy::kMovingGroups) {
    const auto& c = report.corrections[static_cast<std::size_t>(group)];
    json["corrections"].push_back({{"group", name_of(group)},
                                   {"mean_mm", c.mean_shift_mm},
                                   {"greatest_mm", c.greatest_shift_mm},
                                   {"mean_deg", c.mean_turn_deg},
                                   {"greatest_deg", c.greatest_turn_deg}});
  }
  json["scan_overlap_mm"] = report.scan_overlap_mm;
  json["overlap_of_model_mm"] = report.overlap_of_model_mm;
  json["overlap_at_nodes_mm"] = report.overlap_at_nodes_mm;
  json["overlap_between_nodes_mm"] = report.overlap_between_nodes_mm;
  json["overlap_in_pronation_mm"] = report.overlap_in_pronation_mm;
  json["nodes_over_tenth_mm"] = report.nodes_over_tenth_mm;
  json["cells_over_tenth_mm"] = report.cells_over_tenth_mm;
  json["measured"] = nullptr;
  if (comparison != nullptr) {
    Json bones = Json::array();
    for (const MeasuredBone& bone : comparison->bones) {
      bones.push_back({{"bone", name_of(bone.bone)},
                       {"rotation_error_deg", bone.rotation_error_deg},
                       {"position_error_mm", bone.position_error_mm},
                       {"mean_rotation_error_deg", bone.mean_rotation_error_deg},
                       {"mean_position_error_mm", bone.mean_position_error_mm}});
    }
    json["measured"] = {{"positions", comparison->positions}, {"bones", bones}};
  }
  return json.dump(1) + "\n";
}

}  // namespace carpus::cli
