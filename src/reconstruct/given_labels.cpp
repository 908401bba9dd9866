// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/given_labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "imaging/binary_mask.hpp"
#include "imaging/edge_excess.hpp"
#include "imaging/gaussian.hpp"
#include "reconstruct/ground_truth.hpp"

namespace carpus::reconstruct {
namespace {

/// Around the bones: the surface's and the noise's measures look this far.
constexpr double kMarginMm = 6;

imaging::VoxelBox box_around(const Grid<std::uint8_t>& labels) {
  const GridGeometry& g = labels.geometry();
  imaging::VoxelBox box{{g.size[0], g.size[1], g.size[2]}, {-1, -1, -1}};
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    if (labels[i] == 0) continue;
    if (labels[i] > kScaphoidDistalLabel) {
      throw InvalidInput("the labels hold the number " + std::to_string(labels[i]) +
                         "; bones have 1 to " + std::to_string(kScaphoidDistalLabel) +
                         ": say by --names which number is which bone");
    }
    const VoxelIndex v = g.index_of(i);
    box.low = {std::min(box.low.x, v.x), std::min(box.low.y, v.y), std::min(box.low.z, v.z)};
    box.high = {std::max(box.high.x, v.x), std::max(box.high.y, v.y), std::max(box.high.z, v.z)};
  }
  if (box.high.x < 0) throw InvalidInput("the labels hold no bone");
  const auto reach = [&](double spacing) {
    return static_cast<int>(std::ceil(kMarginMm / spacing));
  };
  const VoxelIndex by{reach(g.spacing.x), reach(g.spacing.y), reach(g.spacing.z)};
  box.low = {std::max(0, box.low.x - by.x), std::max(0, box.low.y - by.y),
             std::max(0, box.low.z - by.z)};
  box.high = {std::min(g.size[0] - 1, box.high.x + by.x),
              std::min(g.size[1] - 1, box.high.y + by.y),
              std::min(g.size[2] - 1, box.high.z + by.z)};
  return box;
}

struct Given {
  std::vector<std::uint8_t> labels;  ///< of region i + 1
  bool is_scaphoid_broken = false;
};

/// Numbers the labels 1.. without gaps, as regions are.
Given number_regions(const GridView<const std::uint8_t>& labels, Grid<std::uint16_t>& regions) {
  std::array<std::uint16_t, 256> region_of{};
  for (const std::uint8_t label : labels.values()) region_of[label] = 1;
  region_of[kBackgroundLabel] = 0;
  Given given;
  for (std::size_t label = 1; label < region_of.size(); ++label) {
    if (region_of[label] == 0) continue;
    given.labels.push_back(static_cast<std::uint8_t>(label));
    region_of[label] = static_cast<std::uint16_t>(given.labels.size());
  }
  for (std::size_t i = 0; i < labels.values().size(); ++i) regions[i] = region_of[labels[i]];
  given.is_scaphoid_broken = region_of[kScaphoidDistalLabel] != 0 &&
                             region_of[static_cast<std::size_t>(BoneId::Scaphoid)] != 0;
  return given;
}

anatomy::RegionName name_given(std::uint8_t label, bool is_scaphoid_broken) {
  anatomy::RegionName name;
  if (label == kScaphoidDistalLabel) {
    name.bone = BoneId::Scaphoid;
    name.part = is_scaphoid_broken ? BonePart::Distal : BonePart::Whole;
    return name;
  }
  name.bone = static_cast<BoneId>(label);
  if (name.bone == BoneId::Scaphoid && is_scaphoid_broken) name.part = BonePart::Proximal;
  return name;
}

/// The given names in place of the fit's, with the fit's misfit where it agrees.
void keep_names(const Given& given, GivenSegmentation& result) {
  anatomy::BoneNaming& naming = result.named.naming;
  std::array<bool, 256> is_there{};
  for (std::size_t i = 0; i < given.labels.size(); ++i) {
    anatomy::RegionName name = name_given(given.labels[i], given.is_scaphoid_broken);
    const auto& fitted = naming.regions[i];
    is_there[static_cast<std::size_t>(name.bone)] = true;
    if (fitted && fitted->bone == name.bone) {
      name.cost = fitted->cost;
    } else {
      constexpr double kUnlike = 2 * anatomy::kSuspiciousBoneCost;
      name.cost = kUnlike;
      result.warnings.push_back(
          "what is called " + std::string(name_of(name.bone, name.part)) + " lies where the fit " +
          (fitted ? "would say " + std::string(name_of(fitted->bone, fitted->part))
                  : std::string("knows no bone")) +
          ": check the name");
    }
    naming.regions[i] = name;
  }
  naming.missing.clear();
  for (const BoneId bone : kAllBones) {
    if (!is_there[static_cast<std::size_t>(bone)]) naming.missing.push_back(bone);
  }
}

}  // namespace

GivenSegmentation describe_labels(const Grid<std::int16_t>& ct,
                                  const Grid<std::uint8_t>& labels,
                                  const imaging::BoneSegmentationOptions& options) {
  require_same_grid(ct.geometry(), labels.geometry(), "the label volume");
  const imaging::VoxelBox box = box_around(labels);
  const Grid<std::uint8_t> part = imaging::crop(labels.view(), box);
  const Grid<std::int16_t> hu = imaging::crop(ct.view(), box);
  GivenSegmentation result;
  imaging::BoneSegmentation& s = result.named.segmentation;
  s.status = imaging::SegmentationStatus::Ok;
  s.offset = box.low;
  s.regions = Grid<imaging::RegionLabel>(part.geometry());
  const Given given = number_regions(part.view(), s.regions);
  s.region_count = static_cast<imaging::RegionLabel>(given.labels.size());
  s.smoothed_hu = imaging::gaussian_smooth(hu.view(), options.smoothing_sigma_mm);
  const float soft_tissue = imaging::median_soft_tissue(s.smoothed_hu.view(), part.view());
  s.soft_tissue_hu = static_cast<double>(soft_tissue);
  s.edge_excess =
      imaging::measure_edge_excess(s.smoothed_hu.view(), part.view(), soft_tissue, options);
  result.named.naming = anatomy::name_bones(s.regions.view(), s.region_count);
  keep_names(given, result);
  return result;
}

}  // namespace carpus::reconstruct
