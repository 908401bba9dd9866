// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/hand_motion_json.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "cases/plausible_hand_motion.hpp"
#include "core/error.hpp"
#include "core/json_nesting.hpp"

namespace carpus::case_io {
namespace {

using anatomy::CarpalGroup;
using Json = nlohmann::ordered_json;

/// Half of it would do.
constexpr int kDeepest = 16;

constexpr int kVersion = 1;
/// A table has no more nodes than one of half a degree's step.
constexpr std::size_t kLongestAxis = 400;
/// Nothing in a wrist is farther from its scanner's origin or turned further [mm, rad, N].
constexpr double kLargest = 1e5;
/// Rounding of a stored quaternion is far less, damage is not.
constexpr double kUnitTolerance = 1e-3;

std::string name_text(CarpalGroup group) { return std::string(anatomy::name_of(group)); }

Json json_of(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }
Json json_of(const anatomy::Interval& i) { return Json::array({i.low, i.high}); }

double number_of(const Json& json) {
  const auto value = json.get<double>();
  if (!(std::abs(value) <= kLargest)) throw IoError("a number is impossible");
  return value;
}
Vec3 vec3_of(const Json& json) {
  const auto v = json.get<std::array<Json, 3>>();
  return {number_of(v[0]), number_of(v[1]), number_of(v[2])};
}
anatomy::Interval interval_of(const Json& json) {
  const auto ends = json.get<std::array<Json, 2>>();
  const anatomy::Interval interval{number_of(ends[0]), number_of(ends[1])};
  if (!(interval.low <= 0 && interval.high >= 0)) throw IoError("a limit does not hold zero");
  return interval;
}
std::vector<double> axis_of(const Json& json) {
  std::vector<double> axis;
  for (const Json& node : json) {
    axis.push_back(number_of(node));
    if (axis.size() > 1 && !(axis.back() > axis[axis.size() - 2])) {
      throw IoError("an axis does not rise");
    }
  }
  if (axis.size() < 2 || axis.size() > kLongestAxis) throw IoError("an axis has no fit length");
  return axis;
}

Json node_json(const cases::HandMotionNode& node) {
  Json json = Json::array();
  for (const CarpalGroup group : anatomy::kMovingGroups) {
    const cases::GroupMotion& m = node.groups[static_cast<std::size_t>(group)];
    const auto& q = m.quaternion;
    json.push_back(Json::array({q[0], q[1], q[2], q[3], m.shift.x, m.shift.y, m.shift.z}));
  }
  return json;
}

cases::HandMotionNode node_of(const Json& json) {
  const auto groups = json.get<std::array<Json, anatomy::kMovingGroups.size()>>();
  cases::HandMotionNode node;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const auto v = groups[i].get<std::array<Json, 7>>();
    cases::GroupMotion& m = node.groups[static_cast<std::size_t>(anatomy::kMovingGroups[i])];
    double squares = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      m.quaternion[k] = number_of(v[k]);
      squares += m.quaternion[k] * m.quaternion[k];
    }
    if (!(std::abs(squares - 1) < kUnitTolerance))
      throw IoError("a quaternion is not of unit length");
    m.shift = {number_of(v[4]), number_of(v[5]), number_of(v[6])};
  }
  return node;
}

Json report_json(const cases::HandMotionReport& report) {
  Json corrections;
  for (const CarpalGroup group : anatomy::kMovingGroups) {
    const auto& c = report.corrections[static_cast<std::size_t>(group)];
    corrections[name_text(group)] = {{"mean_mm", c.mean_shift_mm},
                                     {"greatest_mm", c.greatest_shift_mm},
                                     {"mean_deg", c.mean_turn_deg},
                                     {"greatest_deg", c.greatest_turn_deg}};
  }
  return {{"corrections", corrections},
          {"scan_overlap_mm", report.scan_overlap_mm},
          {"overlap_of_model_mm", report.overlap_of_model_mm},
          {"overlap_at_nodes_mm", report.overlap_at_nodes_mm},
          {"overlap_between_nodes_mm", report.overlap_between_nodes_mm},
          {"nodes_over_tenth_mm", report.nodes_over_tenth_mm},
          {"cells_over_tenth_mm", report.cells_over_tenth_mm},
          {"overlap_in_pronation_mm", report.overlap_in_pronation_mm}};
}

cases::HandMotionReport report_of(const Json& json) {
  cases::HandMotionReport report;
  for (const CarpalGroup group : anatomy::kMovingGroups) {
    const Json& c = json.at("corrections").at(name_text(group));
    report.corrections[static_cast<std::size_t>(group)] = {
        number_of(c.at("mean_mm")), number_of(c.at("greatest_mm")), number_of(c.at("mean_deg")),
        number_of(c.at("greatest_deg"))};
  }
  report.scan_overlap_mm = number_of(json.at("scan_overlap_mm"));
  report.overlap_of_model_mm = number_of(json.at("overlap_of_model_mm"));
  report.overlap_at_nodes_mm = number_of(json.at("overlap_at_nodes_mm"));
  report.overlap_between_nodes_mm = number_of(json.at("overlap_between_nodes_mm"));
  report.nodes_over_tenth_mm = number_of(json.at("nodes_over_tenth_mm"));
  report.cells_over_tenth_mm = number_of(json.at("cells_over_tenth_mm"));
  report.overlap_in_pronation_mm = number_of(json.at("overlap_in_pronation_mm"));
  return report;
}

cases::HandMotion motion_of(const Json& json) {
  cases::HandMotion motion;
  const Json& limits = json.at("limits");
  motion.limits = {interval_of(limits.at("flexion_rad")),
                   interval_of(limits.at("radial_deviation_rad")),
                   interval_of(limits.at("pronation_rad")), interval_of(limits.at("traction_n"))};
  const Json& scan = json.at("scan");
  motion.scan = {number_of(scan.at("flexion_rad")), number_of(scan.at("radial_deviation_rad")), 0,
                 0};
  motion.flexion_rad = axis_of(json.at("flexion_rad"));
  motion.deviation_rad = axis_of(json.at("radial_deviation_rad"));
  for (const CarpalGroup group : anatomy::kMovingGroups) {
    motion.reference[static_cast<std::size_t>(group)] =
        vec3_of(json.at("reference_mm").at(name_text(group)));
  }
  const Json& nodes = json.at("nodes");
  if (nodes.size() != motion.flexion_rad.size() * motion.deviation_rad.size()) {
    throw IoError("the table is not full");
  }
  for (const Json& node : nodes) motion.nodes.push_back(node_of(node));
  const Json& traction = json.at("traction");
  motion.hand_axis = vec3_of(traction.at("axis"));
  motion.radiocarpal_mm_per_n = number_of(traction.at("radiocarpal_mm_per_n"));
  motion.midcarpal_mm_per_n = number_of(traction.at("midcarpal_mm_per_n"));
  const Json& pronation = json.at("pronation");
  motion.pronation_axis = vec3_of(pronation.at("axis"));
  motion.pronation_centre = vec3_of(pronation.at("centre_mm"));
  motion.pronation_rad = axis_of(pronation.at("angle_rad"));
  for (const Json& shift : pronation.at("shift_mm")) {
    motion.pronation_shift.push_back(vec3_of(shift));
  }
  if (motion.pronation_shift.size() != motion.pronation_rad.size()) {
    throw IoError("the table of pronation is not full");
  }
  motion.report = report_of(json.at("report"));
  if (const auto problem = cases::problem_of_motion(motion)) throw IoError(*problem);
  return motion;
}

}  // namespace

std::string hand_motion_text(const cases::HandMotion& motion) {
  Json json;
  json["format"] = "carpus hand motion";
  json["schema_version"] = kVersion;
  json["limits"] = {{"flexion_rad", json_of(motion.limits.flexion_rad)},
                    {"radial_deviation_rad", json_of(motion.limits.radial_deviation_rad)},
                    {"pronation_rad", json_of(motion.limits.pronation_rad)},
                    {"traction_n", json_of(motion.limits.traction_n)}};
  json["scan"] = {{"flexion_rad", motion.scan.flexion_rad},
                  {"radial_deviation_rad", motion.scan.radial_deviation_rad}};
  json["flexion_rad"] = motion.flexion_rad;
  json["radial_deviation_rad"] = motion.deviation_rad;
  Json references;
  Json groups = Json::array();
  for (const CarpalGroup group : anatomy::kMovingGroups) {
    references[name_text(group)] = json_of(motion.reference[static_cast<std::size_t>(group)]);
    groups.push_back(name_text(group));
  }
  json["reference_mm"] = references;
  json["groups"] = groups;
  Json nodes = Json::array();
  for (const cases::HandMotionNode& node : motion.nodes) nodes.push_back(node_json(node));
  json["nodes"] = nodes;
  json["traction"] = {{"axis", json_of(motion.hand_axis)},
                      {"radiocarpal_mm_per_n", motion.radiocarpal_mm_per_n},
                      {"midcarpal_mm_per_n", motion.midcarpal_mm_per_n}};
  Json shifts = Json::array();
  for (const Vec3& shift : motion.pronation_shift) shifts.push_back(json_of(shift));
  json["pronation"] = {{"axis", json_of(motion.pronation_axis)},
                       {"centre_mm", json_of(motion.pronation_centre)},
                       {"angle_rad", motion.pronation_rad},
                       {"shift_mm", shifts}};
  json["report"] = report_json(motion.report);
  return json.dump() + "\n";
}

cases::HandMotion parse_hand_motion(const std::string& text, const std::filesystem::path& file) {
  try {
    if (nests_deeper_than(text, kDeepest)) throw IoError("nests too deeply");
    const Json json = Json::parse(text);
    if (json.value("format", "") != "carpus hand motion") {
      throw IoError("is no table of hand motion");
    }
    if (json.at("schema_version") != kVersion) {
      throw SchemaError(file.string() +
                        ": was written by a newer program; update carpus, or remove the file: the "
                        "table is then made anew");
    }
    return motion_of(json);
  } catch (const Json::exception& error) {
    throw IoError(file.string() + ": is damaged (" + error.what() +
                  "); remove it: the table is then made anew");
  } catch (const IoError& error) {
    throw IoError(file.string() + ": " + error.what() +
                  "; remove the file: the table is then made anew");
  }
}

}  // namespace carpus::case_io
