// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/ground_truth.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "case_io/read_volume.hpp"
#include "core/error.hpp"

namespace carpus::reconstruct {
namespace {

namespace fs = std::filesystem;

/// Number in the file -> number here.
using LabelMap = std::array<std::uint8_t, 256>;

constexpr std::uint8_t kMostBoneLabel = kScaphoidDistalLabel;
/// Two grids are one if their corners agree to this part of a voxel: formats round differently.
constexpr double kSamePlace = 0.05;

LabelMap standard_map() {
  LabelMap map{};
  for (std::uint8_t label = 1; label <= kMostBoneLabel; ++label) map[label] = label;
  return map;
}

LabelMap read_map(const fs::path& file) {
  if (!fs::is_regular_file(file)) {  // a pipe would wait for whoever writes into it
    throw IoError(file.string() + ": is no regular file; give one, or remove it");
  }
  std::ifstream stream(file);
  const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
  if (!json.is_object()) {
    throw InvalidInput(file.string() + ": not a list of label numbers such as {\"radius\": 1}");
  }
  LabelMap map{};
  for (const auto& [name, value] : json.items()) {
    if (!value.is_number_integer()) continue;  // remarks
    const auto number = value.get<std::int64_t>();
    if (number < 0 || number > 255) {
      throw InvalidInput(file.string() + ": label of " + name + " is " + std::to_string(number) +
                         ", expected 0 to 255");
    }
    map[static_cast<std::size_t>(number)] = label_of_true_bone(name);
  }
  return map;
}

bool lie_on_one_grid(const GridGeometry& a, const GridGeometry& b) {
  if (a.size != b.size) return false;
  const double voxel = std::min({a.spacing.x, a.spacing.y, a.spacing.z});
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 v{(corner & 1) != 0 ? a.size[0] - 1.0 : 0.0,
                 (corner & 2) != 0 ? a.size[1] - 1.0 : 0.0,
                 (corner & 4) != 0 ? a.size[2] - 1.0 : 0.0};
    if (!(distance(a.patient_from_voxel(v), b.patient_from_voxel(v)) < kSamePlace * voxel)) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::uint8_t label_of_true_bone(std::string_view name) {
  if (name == "scaphoid_distal_fragment") return kScaphoidDistalLabel;
  const std::optional<NamedBone> bone = bone_of(name);
  if (!bone) return kBackgroundLabel;
  return bone->part == BonePart::Distal ? kScaphoidDistalLabel
                                        : static_cast<std::uint8_t>(bone->bone);
}

GroundTruth read_ground_truth(const fs::path& file) {
  GroundTruth truth{case_io::read_labels(file)};
  const fs::path names = file.parent_path() / "labels.json";
  const LabelMap map = fs::exists(names) ? read_map(names) : standard_map();
  for (std::uint8_t& label : truth.labels.values()) label = map[label];
  return truth;
}

void require_same_grid(const GridGeometry& ct,
                       const GridGeometry& labels,
                       const std::string& what) {
  if (lie_on_one_grid(ct, labels)) return;
  const auto text = [](const std::array<int, 3>& s) {
    return std::to_string(s[0]) + " x " + std::to_string(s[1]) + " x " + std::to_string(s[2]);
  };
  throw InvalidInput(what + " (" + text(labels.size) + " voxels) does not lie on the CT's grid (" +
                     text(ct.size) + " voxels): give the label volume that belongs to this scan");
}

void require_same_grid(const GridGeometry& ct, const GroundTruth& truth) {
  require_same_grid(ct, truth.labels.geometry(), "the ground truth");
}

std::vector<LabelDice> compare_labels(const GridView<const std::uint8_t>& found,
                                      const GroundTruth& truth) {
  require_same_grid(found.geometry(), truth);
  std::array<LabelDice, 256> count{};
  std::array<std::size_t, 256> both{};
  for (std::size_t i = 0; i < found.values().size(); ++i) {
    ++count[found[i]].found_voxels;
    ++count[truth.labels[i]].truth_voxels;
    if (found[i] == truth.labels[i]) ++both[found[i]];
  }
  std::vector<LabelDice> result;
  for (std::uint8_t label = 1; label <= kMostBoneLabel; ++label) {
    LabelDice& entry = count[label];
    if (entry.truth_voxels == 0) continue;
    entry.label = label;
    entry.dice = 2.0 * static_cast<double>(both[label]) /
                 static_cast<double>(entry.truth_voxels + entry.found_voxels);
    result.push_back(entry);
  }
  return result;
}

}  // namespace carpus::reconstruct
