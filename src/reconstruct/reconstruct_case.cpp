// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/reconstruct_case.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "anatomy/bone_naming.hpp"
#include "cases/make_hand_motion.hpp"
#include "cases/scaphoid_landmarks.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fields/distance_field.hpp"
#include "hull/quickhull.hpp"
#include "reconstruct/skin_surface.hpp"

namespace carpus::reconstruct {
namespace {

using anatomy::BoneNaming;
using anatomy::NamingStatus;
using imaging::BoneSegmentation;
using imaging::RegionLabel;

/// Part of the whole work that segmentation takes, for the progress bar.
constexpr double kSegmentationShare = 0.35;

std::string hu(double value) { return std::to_string(std::lround(value)) + " HU"; }

[[noreturn]] void refuse_boneless(const BoneSegmentation& s, const GridGeometry& g) {
  throw InvalidInput(
      "no bone found in the volume of " + std::to_string(g.size[0]) + " x " +
      std::to_string(g.size[1]) + " x " + std::to_string(g.size[2]) +
      " voxels: the densest smoothed value is " + hu(s.densest_hu) +
      ", cortical bone has more than 650 HU and encloses its marrow. Give a CT of a wrist in "
      "Hounsfield units (not MRI, not a label volume), with the rescale slope and intercept "
      "intact.");
}

std::string list_of(const std::vector<BoneId>& bones) {
  std::string text;
  for (const BoneId bone : bones) {
    if (!text.empty()) text += ", ";
    text += name_of(bone);
  }
  return text;
}

void refuse_what_cannot_be_operated(const BoneNaming& naming, RegionLabel regions) {
  if (naming.status == NamingStatus::NotAWrist) {
    throw InvalidInput(
        "the bones in this volume do not make a wrist: " + std::to_string(regions) +
        " separate bones were found, " + std::to_string(kBoneCount - naming.missing.size()) +
        " could be matched, with a misfit of " + std::to_string(std::lround(naming.cost)) +
        " (known wrists: up to 20). Give a CT that shows distal radius and ulna, all carpal bones "
        "and the bases of the metacarpals, of one hand only, without metal.");
  }
  std::vector<BoneId> needed;
  for (const BoneId bone : naming.missing) {
    if (bone == BoneId::Radius || bone == BoneId::Lunate || bone == BoneId::Capitate ||
        bone == BoneId::Scaphoid) {
      needed.push_back(bone);
    }
  }
  if (!needed.empty()) {
    throw InvalidInput("not found: " + list_of(needed) +
                       ". A case needs them; give a CT that shows the whole carpus and the distal "
                       "radius, with bones that are not fused.");
  }
}

std::vector<std::string> warnings_of(const BoneNaming& naming) {
  std::vector<std::string> warnings;
  if (!naming.missing.empty()) {
    warnings.push_back("not found: " + list_of(naming.missing) + "; the case goes without");
  }
  if (naming.status == NamingStatus::Doubtful) {
    warnings.push_back("the names fit worse than on any known wrist (misfit " +
                       std::to_string(std::lround(naming.cost)) +
                       ", known up to 20): check them before use");
  }
  const auto nameless = static_cast<std::size_t>(
      std::count(naming.regions.begin(), naming.regions.end(), std::nullopt));
  if (naming.far_bodies > 0) {
    warnings.push_back(std::to_string(naming.far_bodies) +
                       " bodies beyond the wrist (fingers, sesamoids, a support) were left out");
  }
  if (nameless > naming.far_bodies) {
    warnings.push_back(std::to_string(nameless - naming.far_bodies) +
                       " dense bodies in the wrist are no bone of it and were left out: look "
                       "whether one is a fragment");
  }
  return warnings;
}

struct NamedSegmentation {
  BoneSegmentation segmentation;
  BoneNaming naming;
};

/// How bones are told from clefts: a strong weight parts narrow joints, but pierces the thin cortex
/// of scans with thick slices or much noise, so that bones fall apart or fill up with outside.
struct Separation {
  double cleft_weight;
  double bone_threshold_hu;
};

/// Tried in this order, after the options as given, until the names fit; the best fit is kept. With
/// 1 mm slices the second was right where the first was not (misfit 0.7 against 36), with 1.25 mm
/// the third (0.7 against 237).
constexpr std::array<Separation, 3> kFurtherSeparations{{{1.0, 250}, {1.0, 180}, {3.0, 250}}};

bool fits(const BoneNaming& naming) {
  return naming.cost < anatomy::kDoubtfulNamingCost && naming.missing.empty();
}

template <typename Stage>
NamedSegmentation segment_and_name(const Grid<std::int16_t>& ct,
                                   imaging::BoneSegmentationOptions options,
                                   const Stage& stage) {
  const auto attempt = [&] {
    NamedSegmentation result;
    result.segmentation =
        imaging::segment_bones(ct.view(), options, [&](std::string_view name, double fraction) {
          stage(name, kSegmentationShare * fraction);
        });
    if (result.segmentation.status != imaging::SegmentationStatus::Ok) {
      refuse_boneless(result.segmentation, ct.geometry());
    }
    stage("names", kSegmentationShare);
    result.naming =
        anatomy::name_bones(result.segmentation.regions.view(), result.segmentation.region_count);
    return result;
  };
  NamedSegmentation best = attempt();
  for (const Separation& other : kFurtherSeparations) {
    if (fits(best.naming)) break;
    options.cleft_weight = other.cleft_weight;
    options.bone_threshold_hu = other.bone_threshold_hu;
    NamedSegmentation next = attempt();
    if (next.naming.cost < best.naming.cost) best = std::move(next);
  }
  return best;
}

std::uint8_t label_for(const anatomy::RegionName& name) {
  return name.part == BonePart::Distal ? kScaphoidDistalLabel
                                       : static_cast<std::uint8_t>(name.bone);
}

/// Replaces region numbers by bone labels, on the part of the scan that was segmented.
Grid<std::uint16_t> bone_labels(const BoneSegmentation& s, const BoneNaming& naming) {
  std::vector<std::uint16_t> label_of_region(naming.regions.size() + 1, kBackgroundLabel);
  for (std::size_t i = 0; i < naming.regions.size(); ++i) {
    if (naming.regions[i]) label_of_region[i + 1] = label_for(*naming.regions[i]);
  }
  Grid<std::uint16_t> labels = s.regions;
  for (std::uint16_t& label : labels.values()) label = label_of_region[label];
  return labels;
}

Grid<std::uint8_t> on_whole_scan(const Grid<std::uint16_t>& part,
                                 const VoxelIndex& offset,
                                 const GridGeometry& whole) {
  Grid<std::uint8_t> labels(whole);
  for (std::size_t i = 0; i < part.values().size(); ++i) {
    const VoxelIndex v = part.geometry().index_of(i);
    labels[VoxelIndex{v.x + offset.x, v.y + offset.y, v.z + offset.z}] =
        static_cast<std::uint8_t>(part[i]);
  }
  return labels;
}

/// One entry a label, in the order of labels, with the naming's figures.
void list_bones(const BoneNaming& naming, Reconstruction& result) {
  for (const auto& region : naming.regions) {
    if (!region) continue;
    cases::Bone bone;
    bone.bone = region->bone;
    bone.part = region->part;
    bone.label = label_for(*region);
    const bool known = std::any_of(result.data.bones.begin(), result.data.bones.end(),
                                   [&](const cases::Bone& b) { return b.label == bone.label; });
    if (!known) result.data.bones.push_back(std::move(bone));
  }
  auto& bones = result.data.bones;
  std::sort(bones.begin(), bones.end(),
            [](const cases::Bone& a, const cases::Bone& b) { return a.label < b.label; });
  for (const cases::Bone& bone : bones) {
    BoneFigures figures;
    for (const auto& region : naming.regions) {
      if (region && label_for(*region) == bone.label) figures.naming_cost = region->cost;
    }
    result.figures.push_back(figures);
  }
}

void check_bone(const cases::Bone& bone) {
  if (check_surface(bone.surface) == SurfaceStatus::Ok) return;
  throw InvalidInput(std::string(name_of(bone.bone, bone.part)) +
                     ": no closed surface could be made; the bone has too few voxels at this "
                     "resolution. Give a CT with voxels of 0.6 mm or less.");
}

/// Surfaces, and labels that agree with them.
void build_surfaces(const BoneSegmentation& s,
                    Grid<std::uint16_t> labels,
                    const BoneSurfaceOptions& options,
                    const GridGeometry& whole,
                    cases::CaseData& data) {
  std::vector<BoneField> fields(data.bones.size());
  std::vector<std::uint16_t> label_of;
  for (const cases::Bone& bone : data.bones) label_of.push_back(bone.label);
  parallel_for(fields.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      fields[i] = build_bone_field(labels.view(), label_of[i], s.edge_excess.view(), options);
      data.bones[i].surface = build_bone_surface(fields[i], options);
      check_bone(data.bones[i]);
    }
  });
  label_by_fields(fields, label_of, labels.view());
  data.labels = on_whole_scan(labels, s.offset, whole);
}

/// Runs `work` for each bone, side by side where the program has threads.
template <typename Work>
void for_each_bone(Reconstruction& result, const Work& work) {
  parallel_for(result.data.bones.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) work(result.data.bones[i], result.figures[i]);
  });
}

void build_hull(cases::Bone& bone, BoneFigures& figures) {
  const auto start = StageClock::Clock::now();
  hull::HullResult hull = hull::build_convex_hull(bone.surface.vertices);
  figures.hull_seconds = StageClock::seconds_since(start);
  if (hull.status != hull::HullStatus::Ok) {
    throw InvalidInput(std::string(name_of(bone.bone, bone.part)) +
                       ": its surface has no convex hull with a volume; check the scan's geometry");
  }
  bone.hull = std::move(hull.polytope);
}

/// What no CT shows, as the generic wrist has it. A scan so unlike a wrist that its radius cannot
/// be laid on was refused before.
void generate_structures(Reconstruction& result) {
  cases::MadeStructures made = cases::make_structures(result.data);
  result.data.structures = std::move(made.structures);
  result.structures = std::move(made.figures);
  for (const std::string& problem : result.structures.problems) {
    result.warnings.push_back("generated structures: " + problem);
  }
}

}  // namespace

Reconstruction reconstruct_case(Grid<std::int16_t> ct, const ReconstructOptions& options) {
  Reconstruction result;
  StageClock clock;
  const auto stage = [&](std::string_view name, double fraction) {
    clock.begin(name);
    options.progress(name, fraction);
  };
  const auto [segmentation, naming] = segment_and_name(ct, options.segmentation, stage);
  refuse_what_cannot_be_operated(naming, segmentation.region_count);
  result.warnings = warnings_of(naming);
  result.naming_cost = naming.cost;
  result.other_side_cost = naming.other_side_cost;
  result.size = naming.scale;
  cases::CaseData& data = result.data;
  data.pseudonym = options.pseudonym;
  data.provenance = options.provenance;
  data.side = naming.side;
  data.wrist_from_patient = naming.wrist_from_patient;
  list_bones(naming, result);

  stage("surfaces", 0.45);
  build_surfaces(segmentation, bone_labels(segmentation, naming), options.surface, ct.geometry(),
                 data);
  stage("hulls", 0.6);
  for_each_bone(result, [](cases::Bone& bone, BoneFigures& f) { build_hull(bone, f); });
  stage("distance fields", 0.65);
  for (cases::Bone& bone : data.bones) {
    bone.distance_field = fields::build_distance_field(bone.surface);
  }
  stage("skin", 0.85);
  data.skin = build_skin_surface(ct.view());
  data.ct = std::move(ct);
  stage("scaphoid axis", 0.9);
  data.scaphoid = cases::find_scaphoid_landmarks(data);
  stage("structures", 0.94);
  generate_structures(result);
  stage("hand motion", 0.98);
  data.hand_motion = cases::make_hand_motion(data);
  clock.end();
  result.stages = clock.stages();
  options.progress("done", 1.0);
  return result;
}

}  // namespace carpus::reconstruct
