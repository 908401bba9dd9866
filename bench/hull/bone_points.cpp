// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/bone_points.hpp"

#include <algorithm>
#include <cmath>

#include "anatomy/wrist_model.hpp"
#include "case_io/ply.hpp"
#include "core/error.hpp"
#include "geometry/grid.hpp"
#include "mesh/marching_cubes.hpp"
#include "mesh/simplify.hpp"

namespace carpus::bench {
namespace {

constexpr double kSliceToPixel = 5.0 / 3.0;

TriangleMesh extract(const anatomy::WristModel& model, BoneId bone, double pixel_mm) {
  const Aabb box = model.bone(bone).bounds.grown(2 * pixel_mm);
  const Vec3 spacing{pixel_mm, pixel_mm, kSliceToPixel * pixel_mm};
  GridGeometry geometry;
  geometry.spacing = spacing;
  geometry.origin = box.low;
  for (std::size_t a = 0; a < 3; ++a)
    geometry.size[a] = static_cast<int>(box.extent()[a] / spacing[a]) + 2;
  Grid<float> inside(geometry);
  for (std::size_t i = 0; i < inside.values().size(); ++i) {
    const VoxelIndex v = geometry.index_of(i);
    const Vec3 p = geometry.patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    inside[i] = static_cast<float>(-model.signed_value(bone, p));
  }
  return mesh::extract_isosurface(GridView<const float>(inside.view()), 0.0F,
                                  {.close_at_border = true});
}

PointSet set_of(const std::filesystem::path& file, TriangleMesh surface) {
  return {file.stem().string(),
          std::move(surface.vertices),
          {.source = file.filename().string(), .surface_facets = surface.facets.size()}};
}

}  // namespace

PointSet model_bone(BoneId bone, std::size_t count) {
  const anatomy::WristModel& model = anatomy::WristModel::generic();
  // The number of vertices grows with 1 / pixel^2; three corrections come within a few per cent.
  double pixel_mm = 0.6;
  TriangleMesh surface = extract(model, bone, pixel_mm);
  for (int i = 0; i < 3; ++i) {
    pixel_mm *=
        std::sqrt(static_cast<double>(surface.vertices.size()) / static_cast<double>(count));
    surface = extract(model, bone, pixel_mm);
  }
  const std::string name(name_of(bone));
  return {name,
          std::move(surface.vertices),
          {.source = name + " of the parametric wrist (simulated)",
           .surface_facets = surface.facets.size()}};
}

void check_bones_folder(const std::filesystem::path& folder) {
  if (std::filesystem::is_directory(folder)) return;
  throw IoError(folder.string() +
                ": no such folder; give one of <bone>.ply, e.g. a case's bones, or leave --bones "
                "out for the parametric wrist (simulated)");
}

std::vector<PointSet> bones_in(const std::filesystem::path& folder) {
  check_bones_folder(folder);
  std::vector<PointSet> sets;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".ply" && bone_of(entry.path().stem().string())) {
      sets.push_back(set_of(entry.path(), case_io::read_ply(entry.path())));
    }
  }
  if (sets.empty())
    throw IoError(folder.string() + ": holds no <bone>.ply; give a case's bones folder");
  std::sort(sets.begin(), sets.end(),
            [](const PointSet& a, const PointSet& b) { return a.name < b.name; });
  return sets;
}

PointSet thinned_bone(const std::filesystem::path& file, std::size_t count) {
  TriangleMesh surface = case_io::read_ply(file);
  if (surface.vertices.size() > count) {
    constexpr double kAnyErrorMm = 5;  // the count is what is asked for
    surface =
        mesh::simplify(surface, {.target_facets = 2 * count - 4, .max_error_mm = kAnyErrorMm}).mesh;
  }
  return set_of(file, std::move(surface));
}

}  // namespace carpus::bench
