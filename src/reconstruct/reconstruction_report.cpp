// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/reconstruction_report.hpp"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "mesh/genus.hpp"
#include "mesh/self_intersection.hpp"

namespace carpus::reconstruct {
namespace {

std::string name_of_label(std::uint8_t label, bool scaphoid_is_broken) {
  if (label == kScaphoidDistalLabel) {
    return std::string(name_of(BoneId::Scaphoid, BonePart::Distal));
  }
  const auto bone = static_cast<BoneId>(label);
  const bool proximal = bone == BoneId::Scaphoid && scaphoid_is_broken;
  return std::string(name_of(bone, proximal ? BonePart::Proximal : BonePart::Whole));
}

__attribute__((format(printf, 2, 3))) void append(std::string& text, const char* format, ...) {
  std::array<char, 320> line{};
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line.data(), line.size(), format, arguments);
  va_end(arguments);
  text += line.data();
}

void add_dice(const std::vector<LabelDice>& dice,
              const Reconstruction& reconstruction,
              ReconstructionReport& report) {
  if (dice.empty()) return;
  const bool broken = std::any_of(
      dice.begin(), dice.end(), [](const LabelDice& d) { return d.label == kScaphoidDistalLabel; });
  double sum = 0;
  double least = 1;
  const auto& bones = reconstruction.data.bones;
  for (const LabelDice& d : dice) {
    sum += d.dice;
    least = std::min(least, d.dice);
    const auto bone = std::find_if(bones.begin(), bones.end(),
                                   [&](const cases::Bone& b) { return b.label == d.label; });
    if (bone != bones.end()) {
      report.bones[static_cast<std::size_t>(bone - bones.begin())].dice = d.dice;
    } else {
      BoneLine line;
      line.name = name_of_label(d.label, broken);
      line.dice = 0;
      line.is_found = false;
      report.bones.push_back(line);
    }
  }
  report.dice_mean = sum / static_cast<double>(dice.size());
  report.dice_min = least;
}

void add_surfaces(const std::vector<SurfaceDistance>& surfaces,
                  const Reconstruction& reconstruction,
                  ReconstructionReport& report) {
  if (surfaces.empty()) return;
  double sum = 0;
  double worst = 0;
  const auto& bones = reconstruction.data.bones;
  for (const SurfaceDistance& distance : surfaces) {
    sum += distance.mean_mm;
    worst = std::max(worst, distance.p95_mm);
    for (std::size_t i = 0; i < bones.size(); ++i) {
      if (bones[i].label == distance.label) report.bones[i].surface = distance;
    }
  }
  report.surface_mean_mm = sum / static_cast<double>(surfaces.size());
  report.surface_p95_mm = worst;
}

nlohmann::ordered_json number_or_null(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

void append_bones(const ReconstructionReport& report, std::string& text) {
  append(text, "%-18s %8s %8s %8s %8s %9s %8s %10s %7s%s\n", "bone", "vertices", "facets",
         "hull v.", "hull f.", "hull ms", "misfit", "confidence", "Dice",
         report.surface_mean_mm ? "   mm: mean / 95 % / most" : "");
  for (const BoneLine& b : report.bones) {
    if (b.is_found) {
      append(text, "%-18s %8zu %8zu %8zu %8zu %9.2f %8.2f %9.2f%s", b.name.c_str(), b.vertices,
             b.facets, b.hull_vertices, b.hull_facets, 1000 * b.hull_seconds, b.naming_cost,
             b.trust.confidence, b.trust.flagged ? "!" : " ");
    } else {
      append(text, "%-18s %8s %55s", b.name.c_str(), "", "NOT FOUND");
    }
    if (b.dice) append(text, " %7.4f", *b.dice);
    if (b.surface) {
      append(text, "   %.3f / %.3f / %.3f", b.surface->mean_mm, b.surface->p95_mm,
             b.surface->most_mm);
    }
    text += '\n';
  }
  for (const BoneLine& b : report.bones) {
    if (b.trust.flagged) text += "! " + b.name + ": " + b.trust.why + '\n';
    if (b.genus != 0) {
      append(text, "  %s: its surface has %d handles, where a bone has none: look for a leak\n",
             b.name.c_str(), b.genus);
    }
    if (b.self_intersections > 0) {
      append(text, "  %s: its surface passes through itself at %zu pairs of facets\n",
             b.name.c_str(), b.self_intersections);
    }
  }
}

/// The worst bone's.
void append_simplification(const ReconstructionReport& report, std::string& text) {
  const BoneLine* worst = nullptr;
  for (const BoneLine& b : report.bones) {
    if (!b.simplification_error_mm) continue;
    if (worst == nullptr || *b.simplification_error_mm > *worst->simplification_error_mm) {
      worst = &b;
    }
  }
  if (worst == nullptr) return;
  append(
      text,
      "\nSimplified surfaces lie within %.3f mm of what they were made of (%s; measured at every "
      "vertex)\n",
      *worst->simplification_error_mm, worst->name.c_str());
}

/// What no CT shows, and how near its nerves lie to portals, beside what is published.
void append_structures(const ReconstructionReport& report, std::string& text) {
  const cases::StructureFigures& f = report.structure_figures;
  append(text,
         "\nTendons, arteries and nerves: %zu, generated, not seen in the CT (size %.2f, misfit of "
         "bones up to %.2f mm; in bone %.2f, in each other up to %.2f, under the skin at least "
         "%.2f mm)\n",
         report.structures, f.scale, f.worst_misfit_mm, f.deepest_in_bone_mm, f.deepest_in_other_mm,
         f.least_under_skin_mm);
  for (const cases::PortalDistance& portal : f.portals) {
    append(text, "portal %s: %.1f mm to the %s", portal.portal.c_str(), portal.mm,
           portal.nearest.c_str());
    for (const auto& published : portal.published) {
      append(text, "; published to the %s %.2f mm %s", published.to.c_str(), published.mm,
             published.mark.c_str());
    }
    text += '\n';
  }
}

nlohmann::ordered_json structures_json(const ReconstructionReport& report) {
  const cases::StructureFigures& f = report.structure_figures;
  nlohmann::ordered_json portals = nlohmann::ordered_json::array();
  for (const cases::PortalDistance& portal : f.portals) {
    portals.push_back({{"portal", portal.portal}, {"nerve", portal.nearest}, {"mm", portal.mm}});
  }
  return {{"generated", true},
          {"count", report.structures},
          {"in_bone_mm", f.deepest_in_bone_mm},
          {"in_another_mm", f.deepest_in_other_mm},
          {"under_skin_mm", f.least_under_skin_mm},
          {"portals", portals}};
}

}  // namespace

ReconstructionReport make_report(const Reconstruction& reconstruction,
                                 const std::vector<LabelDice>& dice,
                                 const std::vector<SurfaceDistance>& surfaces) {
  ReconstructionReport report;
  report.side = name_of(reconstruction.data.side);
  report.stages = reconstruction.stages;
  report.voxels = reconstruction.data.ct.values().size();
  report.conventions = reconstruction.data.provenance.conventions;
  report.naming_cost = reconstruction.naming_cost;
  report.other_side_cost = reconstruction.other_side_cost;
  report.structures = reconstruction.data.structures.size();
  report.structure_figures = reconstruction.structures;
  for (std::size_t i = 0; i < reconstruction.data.bones.size(); ++i) {
    const cases::Bone& bone = reconstruction.data.bones[i];
    BoneLine line;
    line.name = name_of(bone.bone, bone.part);
    line.vertices = bone.surface.vertices.size();
    line.facets = bone.surface.facets.size();
    line.hull_vertices = bone.hull.vertices.size();
    line.hull_facets = bone.hull.facets.size();
    line.hull_seconds = reconstruction.figures[i].hull_seconds;
    line.naming_cost = reconstruction.figures[i].naming_cost;
    line.trust = reconstruction.figures[i].trust;
    line.simplification_error_mm = reconstruction.figures[i].simplification_error_mm;
    line.genus = mesh::genus_of(bone.surface);
    line.self_intersections = mesh::count_self_intersections(bone.surface);
    report.bones.push_back(line);
  }
  add_surfaces(surfaces, reconstruction, report);
  add_dice(dice, reconstruction, report);
  return report;
}

std::string text_of(const ReconstructionReport& report) {
  std::string text;
  append(text, "side: %s (misfit %.1f; as the other side %.1f)\n\n", report.side.c_str(),
         report.naming_cost, report.other_side_cost);
  for (const std::string& words : report.conventions) text += "by convention: " + words + "\n";
  if (!report.conventions.empty()) text += '\n';
  append_bones(report, text);
  append_simplification(report, text);
  if (report.dice_mean && report.dice_min) {
    append(text, "\nDice: mean %.4f, worst bone %.4f\n", *report.dice_mean, *report.dice_min);
  }
  if (report.surface_mean_mm && report.surface_p95_mm) {
    append(text,
           "\nSurfaces from the true ones: mean %.3f mm, 95 %% within %.3f mm on the worst bone\n",
           *report.surface_mean_mm, *report.surface_p95_mm);
  }
  if (report.structures > 0) append_structures(report, text);
  double total = 0;
  for (const StageTime& stage : report.stages) total += stage.seconds;
  append(text, "\n%-28s %8s %6s %7s %12s\n", "stage", "seconds", "share", "so far", "peak MiB");
  double so_far = 0;
  for (const StageTime& stage : report.stages) {
    so_far += stage.seconds;
    append(text, "%-28s %8.2f %5.1f%% %7.2f %12.0f\n", stage.name.c_str(), stage.seconds,
           total > 0 ? 100 * stage.seconds / total : 0.0, so_far,
           stage.peak_memory_bytes / (1024 * 1024));
  }
  if (report.peak_memory_bytes && report.voxels > 0) {
    const auto voxels = static_cast<double>(report.voxels);
    append(text, "peak memory %.0f MiB, %.1f bytes a voxel beyond the scan itself\n",
           *report.peak_memory_bytes / (1024 * 1024),
           *report.peak_memory_bytes / voxels - sizeof(std::int16_t));
  }
  return text;
}

std::string json_of(const ReconstructionReport& report) {
  nlohmann::ordered_json json;
  json["side"] = report.side;
  json["bones"] = nlohmann::ordered_json::array();
  for (const BoneLine& b : report.bones) {
    if (!b.is_found) continue;
    json["bones"].push_back({{"name", b.name},
                             {"dice", number_or_null(b.dice)},
                             {"vertices", b.vertices},
                             {"facets", b.facets},
                             {"hull_vertices", b.hull_vertices},
                             {"hull_facets", b.hull_facets},
                             {"confidence", b.trust.confidence},
                             {"flagged", b.trust.flagged},
                             {"why", b.trust.why},
                             {"simplification_error_mm", number_or_null(b.simplification_error_mm)},
                             {"genus", b.genus},
                             {"self_intersections", b.self_intersections}});
    if (!b.surface) continue;
    json["bones"].back()["surface_mean_mm"] = b.surface->mean_mm;
    json["bones"].back()["surface_p95_mm"] = b.surface->p95_mm;
    json["bones"].back()["surface_most_mm"] = b.surface->most_mm;
  }
  if (report.surface_mean_mm) {
    json["surface_mean_mm"] = *report.surface_mean_mm;
    json["surface_p95_mm"] = number_or_null(report.surface_p95_mm);
  }
  json["dice_mean"] = number_or_null(report.dice_mean);
  json["dice_min"] = number_or_null(report.dice_min);
  json["stages"] = nlohmann::ordered_json::array();
  for (const StageTime& stage : report.stages) {
    json["stages"].push_back({{"name", stage.name},
                              {"seconds", stage.seconds},
                              {"peak_memory_bytes", stage.peak_memory_bytes}});
  }
  if (report.peak_memory_bytes) json["peak_memory_bytes"] = *report.peak_memory_bytes;
  json["conventions"] = report.conventions;
  if (report.structures > 0) json["structures"] = structures_json(report);
  return json.dump(2) + "\n";
}

}  // namespace carpus::reconstruct
