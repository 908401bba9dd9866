// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/segmentation_study.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/text_format.hpp"
#include "phantom/phantom.hpp"
#include "reconstruct/ground_truth.hpp"
#include "reconstruct/named_segmentation.hpp"
#include "reconstruct/surface_bones.hpp"

namespace carpus::cli {
namespace {

/// Another person in another scanner; what happened to them grows with the difficulty.
phantom::PhantomOptions options_of(std::uint64_t seed, double voxel_mm, StudiedScan& scan) {
  phantom::PhantomOptions o;
  o.seed = seed;
  o.spacing = {voxel_mm, voxel_mm, voxel_mm};
  Rng rng(seed ^ 0x5E6ULL);
  o.side = rng.uniform() < 0.5 ? Side::Left : Side::Right;
  o.scale = rng.uniform(0.88, 1.12);
  o.fracture = rng.uniform() < 0.7
                   ? phantom::FractureKind::None
                   : phantom::kAllFractureKinds[rng.below(phantom::kAllFractureKinds.size())];
  // Two seeds after one another have the same difficulty, so that even and odd ones have all.
  scan.difficulty = static_cast<int>((seed / 2) % kDifficulties);
  const auto add = [&](phantom::Condition condition, double severity) {
    phantom::apply(condition, severity, o.scan);
    scan.conditions.push_back(
        format("%s %.2f", std::string(phantom::name_of(condition)).c_str(), severity));
  };
  add(phantom::Condition::OtherAnatomy, 0.2 + 0.2 * scan.difficulty);
  const double least = std::clamp(0.25 * scan.difficulty - 0.1, 0.0, 0.6);
  for (int k = 0; k < scan.difficulty; ++k) {
    add(phantom::kAllConditions[rng.below(phantom::kAllConditions.size())],
        rng.uniform(least, least + 0.4));
  }
  return o;
}

void name_and_measure(const phantom::Phantom& made, StudiedScan& scan) {
  using namespace reconstruct;
  NamedSegmentation named = segment_and_name(made.ct, {}, [](std::string_view, double) {});
  scan.naming_cost = named.naming.cost;
  scan.is_side_right = named.naming.side == made.options.side;
  if (named.naming.status == anatomy::NamingStatus::NotAWrist) {
    scan.refused = "the bones make no wrist";
    return;
  }
  Grid<std::uint8_t> labels = bone_labels(named);
  std::array<bool, 256> is_there{};
  for (const std::uint8_t label : labels.values()) is_there[label] = label != kBackgroundLabel;
  std::vector<std::uint8_t> numbers;
  for (std::uint8_t label = 1; label <= kScaphoidDistalLabel; ++label) {
    if (is_there[label]) numbers.push_back(label);
  }
  const VoxelIndex offset = named.segmentation.offset;
  const std::vector<BoneEvidence> evidence =
      surface_bones(std::move(named.segmentation), numbers, named.naming, made.ct.view(), {},
                    labels.view())
          .evidence;
  const auto whole = on_whole_scan(labels, offset, made.ct.geometry());
  for (StudiedBone& bone : scan.bones) {
    for (const BoneEvidence& each : evidence) {
      if (each.label != bone.label) continue;
      bone.is_found = true;
      bone.evidence = each;
      bone.trust = judge(each);
    }
  }
  for (const LabelDice& dice : compare_labels(whole.view(), {made.labels})) {
    for (StudiedBone& bone : scan.bones) {
      if (bone.label == dice.label) bone.dice = dice.dice;
    }
  }
}

}  // namespace

double study_voxel_mm(std::uint64_t seed) {
  constexpr std::array<double, 5> kVoxelsMm{0.7, 0.5, 0.6, 0.4, 0.7};
  // Pairs of seeds have one difficulty; each difficulty meets each size.
  return kVoxelsMm.at((seed / (2 * kDifficulties)) % kVoxelsMm.size());
}

StudiedScan study_scan(std::uint64_t seed, double voxel_mm) {
  StudiedScan scan;
  scan.seed = seed;
  scan.voxel_mm = voxel_mm;
  const phantom::Phantom made = phantom::make_phantom(options_of(seed, voxel_mm, scan));
  const Grid<std::uint8_t> nothing(made.labels.geometry());
  for (const reconstruct::LabelDice& dice :
       reconstruct::compare_labels(nothing.view(), {made.labels})) {
    // A sliver at the edge of the field of view is no bone that anyone looks for.
    constexpr double kLeastMm3 = 150;
    const double mm3 =
        static_cast<double>(dice.truth_voxels) * made.labels.geometry().voxel_volume_mm3();
    if (mm3 > kLeastMm3) scan.bones.push_back({dice.label, 0, false, {}, {}});
  }
  try {
    name_and_measure(made, scan);
  } catch (const InvalidInput& refusal) {
    scan.refused = refusal.what();
  }
  return scan;
}

FlagFigures figures_of(const std::vector<StudiedScan>& scans,
                       const std::function<bool(const StudiedScan&)>& is_asked_for) {
  FlagFigures figures;
  std::vector<double> wrong;
  std::vector<double> right;
  double sum = 0;
  for (const StudiedScan& scan : scans) {
    if (!is_asked_for(scan)) continue;
    for (const StudiedBone& bone : scan.bones) {
      ++figures.bones;
      sum += bone.dice;
      figures.worst_dice = std::min(figures.worst_dice, bone.dice);
      figures.wrong += bone.is_wrong() ? 1U : 0U;
      figures.told += bone.is_wrong() && bone.is_told() ? 1U : 0U;
      figures.wrong_found += bone.is_wrong() && bone.is_found ? 1U : 0U;
      figures.flagged += bone.is_wrong() && bone.is_found && bone.trust.flagged ? 1U : 0U;
      figures.false_alarms += !bone.is_wrong() && bone.is_told() ? 1U : 0U;
      if (bone.is_found) (bone.is_wrong() ? wrong : right).push_back(bone.trust.confidence);
    }
  }
  if (figures.bones > 0) figures.mean_dice = sum / static_cast<double>(figures.bones);
  if (!wrong.empty() && !right.empty()) {
    double wins = 0;
    for (const double a : wrong) {
      for (const double b : right) wins += a < b ? 1.0 : (a > b ? 0.0 : 0.5);
    }
    figures.auc = wins / (static_cast<double>(wrong.size()) * static_cast<double>(right.size()));
  }
  return figures;
}

}  // namespace carpus::cli
