// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/segmentation_study.hpp"
#include "core/error.hpp"

namespace carpus::cli {
namespace {

using Json = nlohmann::ordered_json;

StudiedScan scan_of(const Json& row) {
  StudiedScan scan;
  scan.seed = row.at("seed");
  scan.voxel_mm = row.at("voxel_mm");
  scan.difficulty = row.at("difficulty");
  scan.conditions = row.at("conditions").get<std::vector<std::string>>();
  scan.refused = row.at("refused");
  scan.is_side_right = row.at("side_right");
  scan.naming_cost = row.at("misfit");
  for (const Json& each : row.at("bones")) {
    StudiedBone bone;
    bone.label = each.at("label");
    bone.dice = each.at("dice");
    bone.is_found = each.contains("evidence");
    if (bone.is_found) {
      bone.evidence.label = bone.label;
      for (const auto& field : reconstruct::evidence_fields()) {
        bone.evidence.*field.value = each.at("evidence").at(std::string(field.name));
      }
      bone.trust = reconstruct::judge(bone.evidence);
    }
    scan.bones.push_back(bone);
  }
  if (scan.difficulty < 0 || scan.difficulty >= kDifficulties) {
    throw InvalidInput("there is no such difficulty");
  }
  return scan;
}

}  // namespace

std::string row_of(const StudiedScan& scan) {
  Json bones = Json::array();
  for (const StudiedBone& bone : scan.bones) {
    Json each{{"label", bone.label}, {"dice", bone.dice}};
    if (bone.is_found) {
      for (const auto& field : reconstruct::evidence_fields()) {
        each["evidence"][std::string(field.name)] = bone.evidence.*field.value;
      }
    }
    bones.push_back(std::move(each));
  }
  const Json row{{"voxel_mm", scan.voxel_mm},     {"seed", scan.seed},
                 {"difficulty", scan.difficulty}, {"conditions", scan.conditions},
                 {"refused", scan.refused},       {"side_right", scan.is_side_right},
                 {"misfit", scan.naming_cost},    {"bones", bones}};
  return row.dump() + "\n";
}

SegmentationStudy study_of_rows(const std::string& text, const std::string& file) {
  SegmentationStudy study;
  std::istringstream lines(text);
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    try {
      const Json row = Json::parse(line);
      study.scans.push_back(scan_of(row));
    } catch (const std::exception& problem) {
      // A run that was stopped may leave half a line at the end; that scan is made again.
      if (lines.peek() == std::char_traits<char>::eof()) break;
      throw InvalidInput(file + ", line " + std::to_string(number) + ": " + problem.what());
    }
  }
  return study;
}

}  // namespace carpus::cli
