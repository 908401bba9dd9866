// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/surface_truth.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "anatomy/bone_id.hpp"
#include "case_io/surface_file.hpp"
#include "core/error.hpp"
#include "fields/triangle_tree.hpp"
#include "reconstruct/ground_truth.hpp"

namespace carpus::reconstruct {
namespace fs = std::filesystem;
namespace {

/// More than this in one plane is a cut: bones are round [mm^2].
constexpr double kCutArea = 12;
constexpr double kInPlaneMm = 0.05;
constexpr double kInPlaneCosine = 0.9994;  // 2 degrees
/// A saw's edge is no surface of a bone, nor what a point spread makes of it [mm].
constexpr double kBesideCutMm = 1.5;
/// Of the facets, how many of the largest are asked whether they lie in a cut.
constexpr std::size_t kMostAsked = 40;

struct Cut {
  Vec3 normal;  ///< unit, out of what is left of the bone
  double offset = 0;
};

struct FlatFacet {
  Vec3 normal;
  Vec3 middle;
  double area = 0;
};

std::vector<FlatFacet> flat_facets(const TriangleMesh& mesh) {
  std::vector<FlatFacet> facets;
  for (const Triangle& t : mesh.facets) {
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3 across = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
    facets.push_back({normalized_or(across, {0, 0, 0}),
                      (a + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0, 0.5 * length(across)});
  }
  std::sort(facets.begin(), facets.end(),
            [](const FlatFacet& a, const FlatFacet& b) { return a.area > b.area; });
  return facets;
}

std::vector<Cut> cuts_of(const TriangleMesh& mesh) {
  const std::vector<FlatFacet> facets = flat_facets(mesh);
  std::vector<Cut> cuts;
  for (std::size_t i = 0; i < std::min(kMostAsked, facets.size()); ++i) {
    const Cut cut{facets[i].normal, dot(facets[i].normal, facets[i].middle)};
    double area = 0;
    for (const FlatFacet& f : facets) {
      if (dot(f.normal, cut.normal) > kInPlaneCosine &&
          std::abs(dot(cut.normal, f.middle) - cut.offset) < kInPlaneMm) {
        area += f.area;
      }
    }
    if (area > kCutArea) cuts.push_back(cut);
  }
  return cuts;
}

bool is_beyond(const std::vector<Cut>& cuts, const Vec3& p) {
  return std::any_of(cuts.begin(), cuts.end(), [&](const Cut& cut) {
    return dot(cut.normal, p) - cut.offset > -kBesideCutMm;
  });
}

/// A finer surface says no more of a bone, and comparing it takes minutes.
constexpr std::size_t kMostFacets = 2'000'000;
/// No scan reaches farther from its origin [mm].
constexpr double kFarthestMm = 10'000;

/// @throws InvalidInput naming the file and what to do.
void check_true_surface(const fs::path& file, const TriangleMesh& surface) {
  const auto refuse = [&](const std::string& why) {
    throw InvalidInput(file.string() + ": " + why);
  };
  if (surface.facets.empty()) {
    refuse("holds no facets; give the bone's surface in triangles, or take the file away");
  }
  if (surface.facets.size() > kMostFacets) {
    refuse("has " + std::to_string(surface.facets.size()) + " facets, more than " +
           std::to_string(kMostFacets) + "; simplify it, edges of 0.1 mm are fine enough");
  }
  for (const Vec3& p : surface.vertices) {
    if (length(p) <= kFarthestMm) continue;  // not so what is no number
    refuse(
        "has a vertex more than 10 m from the origin, or at no place at all; export it again in "
        "mm, in the scan's frame (LPS)");
  }
  if (!(area_of(surface) > 0)) {
    refuse("has no facet with an area; export the bone's surface again");
  }
}

/// A distance and how much of a surface has it.
struct Weighed {
  double mm = 0;
  double area = 0;
};

void add_distances(const TriangleMesh& from,
                   const TriangleMesh& to,
                   const std::vector<Cut>& cuts,
                   std::vector<Weighed>& distances) {
  std::vector<double> area(from.vertices.size());
  for (const Triangle& t : from.facets) {
    const Vec3& a = from.vertices[t[0]];
    const double third = length(cross(from.vertices[t[1]] - a, from.vertices[t[2]] - a)) / 6;
    for (const std::uint32_t v : t) area[v] += third;
  }
  const fields::TriangleTree tree(to);
  for (std::size_t i = 0; i < from.vertices.size(); ++i) {
    if (!(area[i] > 0) || is_beyond(cuts, from.vertices[i])) continue;
    const auto near = tree.nearest(from.vertices[i]);
    if (near) distances.push_back({std::sqrt(near->squared_distance), area[i]});
  }
}

}  // namespace

std::vector<TrueSurface> read_true_surfaces(const fs::path& folder) {
  if (!fs::is_directory(folder)) {
    throw IoError(folder.string() + ": is no folder; give one with a surface for each bone");
  }
  std::vector<TrueSurface> result;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::uint8_t label = label_of_true_bone(entry.path().stem().string());
    if (label == kBackgroundLabel) continue;
    if (!entry.is_regular_file()) {
      throw InvalidInput(entry.path().string() +
                         ": is named as a bone and is no file; give the bone's surface in its "
                         "place, or take it away");
    }
    MeshIn<frame::Patient> surface(case_io::read_surface(entry.path()));
    check_true_surface(entry.path(), surface);
    result.push_back({label, std::move(surface)});
  }
  if (result.empty()) {
    throw InvalidInput(folder.string() +
                       ": no file is named as a bone is; expected radius.ply, scaphoid.ply ...");
  }
  std::sort(result.begin(), result.end(),
            [](const TrueSurface& a, const TrueSurface& b) { return a.label < b.label; });
  const auto twice = std::adjacent_find(
      result.begin(), result.end(),
      [](const TrueSurface& a, const TrueSurface& b) { return a.label == b.label; });
  if (twice != result.end()) {
    throw InvalidInput(folder.string() + ": has two surfaces of the bone with label " +
                       std::to_string(twice->label) + "; keep the one to compare with");
  }
  return result;
}

SurfaceDistance distance_between(const TriangleMesh& found, const TriangleMesh& truth) {
  const std::vector<Cut> cuts = cuts_of(truth);
  std::vector<Weighed> distances;
  add_distances(found, truth, cuts, distances);
  add_distances(truth, found, cuts, distances);
  std::sort(distances.begin(), distances.end(),
            [](const Weighed& a, const Weighed& b) { return a.mm < b.mm; });
  SurfaceDistance result;
  const double area = std::accumulate(distances.begin(), distances.end(), 0.0,
                                      [](double sum, const Weighed& d) { return sum + d.area; });
  double so_far = 0;
  for (const Weighed& d : distances) {
    result.mean_mm += d.mm * d.area / area;
    if (so_far < 0.95 * area) result.p95_mm = d.mm;
    so_far += d.area;
    result.most_mm = d.mm;
  }
  return result;
}

std::vector<SurfaceDistance> compare_surfaces(const cases::CaseData& found,
                                              std::span<const TrueSurface> truth) {
  std::vector<SurfaceDistance> result;
  for (const TrueSurface& each : truth) {
    const auto bone = std::find_if(found.bones.begin(), found.bones.end(),
                                   [&](const cases::Bone& b) { return b.label == each.label; });
    if (bone == found.bones.end()) continue;
    SurfaceDistance distance =
        distance_between(bone->patient_from_bone * bone->surface, each.surface);
    distance.label = each.label;
    result.push_back(distance);
  }
  return result;
}

}  // namespace carpus::reconstruct
