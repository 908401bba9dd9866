// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/reconstruct_case.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "anatomy/bone_naming.hpp"
#include "cases/make_hand_motion.hpp"
#include "cases/scaphoid_landmarks.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text_format.hpp"
#include "fields/distance_field.hpp"
#include "hull/quickhull.hpp"
#include "reconstruct/given_labels.hpp"
#include "reconstruct/named_segmentation.hpp"
#include "reconstruct/skin_surface.hpp"
#include "reconstruct/surface_bones.hpp"

namespace carpus::reconstruct {
namespace {

using anatomy::BoneNaming;
using anatomy::NamingStatus;
using imaging::BoneSegmentation;
using imaging::RegionLabel;

/// Part of the whole work that segmentation takes, for the progress bar.
constexpr double kSegmentationShare = 0.35;
/// Of the model wrist; adults' are 0.85 to 1.15.
constexpr double kSmallestAdult = 0.78;

std::string list_of(const std::vector<BoneId>& bones) {
  std::string text;
  for (const BoneId bone : bones) {
    if (!text.empty()) text += ", ";
    text += name_of(bone);
  }
  return text;
}

/// Joints of 1 mm are lost in voxels with a side as long as theirs.
constexpr double kCoarseMm = 1.3;

/// For a refusal: what else to do than it says.
std::string advice_on_slices(const GridGeometry& scan) {
  const double longest = std::max({scan.spacing.x, scan.spacing.y, scan.spacing.z});
  if (longest < kCoarseMm) return "";
  return " The likely reason is the scan's slices of " + format("%.2g", longest) +
         " mm: joints are narrower. Give slices of 1 mm or less, or outline the bones elsewhere "
         "and "
         "give them by --labels.";
}

void refuse_what_cannot_be_operated(const BoneNaming& naming,
                                    RegionLabel regions,
                                    const GridGeometry& scan) {
  if (naming.status == NamingStatus::NotAWrist) {
    throw InvalidInput(
        "the bones in this volume do not make a wrist: " + std::to_string(regions) +
        " separate bones were found, " + std::to_string(kBoneCount - naming.missing.size()) +
        " could be matched, with a misfit of " + std::to_string(std::lround(naming.cost)) +
        " (known wrists: up to 20). Give a CT that shows distal radius and ulna, all carpal bones "
        "and the bases of the metacarpals, of one hand only, without metal." +
        advice_on_slices(scan));
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
                       "radius, with bones that are not fused." +
                       advice_on_slices(scan));
  }
}

std::vector<std::string> warnings_of(const BoneNaming& naming) {
  std::vector<std::string> warnings;
  if (!naming.missing.empty()) {
    warnings.push_back("not found: " + list_of(naming.missing) + "; the case goes without");
  }
  if (naming.status == NamingStatus::Doubtful && naming.cost < anatomy::kDoubtfulNamingCost) {
    warnings.push_back(
        "one of the bones lies or is shaped as on no known wrist: check its name and outline");
  } else if (naming.status == NamingStatus::Doubtful) {
    warnings.push_back("the names fit worse than on any known wrist (misfit " +
                       std::to_string(std::lround(naming.cost)) +
                       ", known up to 20): check them before use");
  }
  const auto nameless = static_cast<std::size_t>(
      std::count(naming.regions.begin(), naming.regions.end(), std::nullopt));
  if (naming.scale < kSmallestAdult) {
    warnings.push_back("the wrist is " + std::to_string(std::lround(100 * naming.scale)) +
                       " % of an adult's size. If it is a child's, do not use the case: growth "
                       "plates and bones that are not ossified yet are not known here");
  }
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

/// Surfaces, and labels that agree with them. The segmentation's volumes are used up.
void build_surfaces(BoneSegmentation s,
                    Grid<std::uint8_t> labels,
                    const BoneSurfaceOptions& options,
                    const BoneNaming& naming,
                    const GridView<const std::int16_t>& ct,
                    Reconstruction& result) {
  cases::CaseData& data = result.data;
  std::vector<std::uint8_t> label_of;
  for (const cases::Bone& bone : data.bones) label_of.push_back(bone.label);
  const VoxelIndex offset = s.offset;
  SurfacedBones made = surface_bones(std::move(s), label_of, naming, ct, options, labels.view());
  for (std::size_t i = 0; i < label_of.size(); ++i) {
    data.bones[i].surface = MeshIn<frame::Bone>(std::move(made.surfaces[i]));
    check_bone(data.bones[i]);
    result.figures[i].simplification_error_mm = made.simplification_error_mm[i];
    for (const BoneEvidence& each : made.evidence) {
      if (each.label == label_of[i]) result.figures[i].trust = judge(each);
    }
  }
  data.labels = on_whole_scan(labels, offset, ct.geometry());
}

void keep_trust(const EarlierVersion& earlier,
                const Grid<std::uint8_t>& labels,
                Reconstruction& result) {
  const std::array<bool, 256> is_alone = left_alone(earlier.labels, labels);
  for (const EarlierBone& had : earlier.bones) {
    if (!had.trust || !is_alone[had.label]) continue;
    for (std::size_t i = 0; i < result.figures.size(); ++i) {
      if (result.data.bones[i].label == had.label) result.figures[i].trust = *had.trust;
    }
  }
}

void warn_of_flagged(Reconstruction& result) {
  for (std::size_t i = 0; i < result.figures.size(); ++i) {
    const BoneTrust& trust = result.figures[i].trust;
    if (!trust.flagged) continue;
    const cases::Bone& bone = result.data.bones[i];
    result.warnings.push_back("check the " + std::string(name_of(bone.bone, bone.part)) +
                              format(" (confidence %.2f): ", trust.confidence) + trust.why);
  }
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

/// Everything after the names. `correct` has the bones with labels and surfaces, and nothing else
/// yet.
void build_case(Grid<std::int16_t> ct,
                NamedSegmentation named,
                const ReconstructOptions& options,
                const std::function<void(std::string_view, double)>& stage,
                const std::function<void(cases::CaseData&)>& correct,
                Reconstruction& result) {
  const BoneNaming& naming = named.naming;
  refuse_what_cannot_be_operated(naming, named.segmentation.region_count, ct.geometry());
  result.of_scan = warnings_of(naming);
  result.warnings.insert(result.warnings.end(), result.of_scan.begin(), result.of_scan.end());
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
  Grid<std::uint8_t> labels = bone_labels(named);
  build_surfaces(std::move(named.segmentation), std::move(labels), options.surface, naming,
                 ct.view(), result);
  correct(data);
  warn_of_flagged(result);
  stage("hulls", 0.6);
  for_each_bone(result, [](cases::Bone& bone, BoneFigures& f) { build_hull(bone, f); });
  stage("distance fields, axis, skin", 0.65);
  side_by_side({[&] { data.scaphoid = cases::find_scaphoid_landmarks(data); },
                [&] { data.skin = build_skin_surface(ct.view()); },
                [&] {
                  for_each_bone(result, [](cases::Bone& bone, BoneFigures&) {
                    bone.distance_field = fields::build_distance_field(bone.surface);
                  });
                }});
  data.ct = std::move(ct);
  stage("structures, hand motion", 0.9);
  side_by_side({[&] { data.hand_motion = cases::make_hand_motion(data); },
                [&] { generate_structures(result); }});
}

}  // namespace

Reconstruction reconstruct_case(Grid<std::int16_t> ct, const ReconstructOptions& options) {
  Reconstruction result;
  StageClock clock;
  const auto stage = [&](std::string_view name, double fraction) {
    clock.begin(name);
    options.progress(name, fraction);
  };
  NamedSegmentation named = segment_and_name(
      ct, options.segmentation,
      [&](std::string_view name, double fraction) { stage(name, kSegmentationShare * fraction); });
  build_case(
      std::move(ct), std::move(named), options, stage, [](cases::CaseData&) {}, result);
  clock.end();
  result.stages = clock.stages();
  options.progress("done", 1.0);
  return result;
}

Reconstruction reconstruct_labelled(Grid<std::int16_t> ct,
                                    const Grid<std::uint8_t>& labels,
                                    const ReconstructOptions& options,
                                    const EarlierVersion* earlier) {
  Reconstruction result;
  StageClock clock;
  const auto stage = [&](std::string_view name, double fraction) {
    clock.begin(name);
    options.progress(name, fraction);
  };
  stage("names", 0.1);
  GivenSegmentation given = describe_labels(ct, labels, options.segmentation);
  result.warnings = given.warnings;
  const auto keep = [&](cases::CaseData& data) {
    if (earlier == nullptr) return;
    const std::array<bool, 256> is_kept = keep_untouched(*earlier, labels, data);
    for (std::size_t i = 0; i < data.bones.size(); ++i) {
      if (is_kept[data.bones[i].label]) result.figures[i].simplification_error_mm.reset();
    }
    keep_trust(*earlier, labels, result);
  };
  build_case(std::move(ct), std::move(given.named), options, stage, keep, result);
  clock.end();
  result.stages = clock.stages();
  options.progress("done", 1.0);
  return result;
}

}  // namespace carpus::reconstruct
