// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/surface_bones.hpp"

#include <cstddef>
#include <utility>

#include "core/parallel.hpp"
#include "imaging/region_merging.hpp"
#include "reconstruct/label_by_surfaces.hpp"
#include "reconstruct/sharpen_surface.hpp"

namespace carpus::reconstruct {

SurfacedBones surface_bones(imaging::BoneSegmentation s,
                            std::span<const std::uint8_t> label_of,
                            const anatomy::BoneNaming& naming,
                            const GridView<const std::int16_t>& ct,
                            const BoneSurfaceOptions& options,
                            const GridView<std::uint8_t>& labels) {
  const imaging::RegionTable regions =
      imaging::measure_regions(s.regions.view(), s.edge_excess.view());
  s.regions = {};  // each volume goes when nobody asks for it any more
  SurfacedBones result;
  result.simplification_error_mm.resize(label_of.size());
  std::vector<BoneField> fields(label_of.size());
  std::vector<MeshIn<frame::Bone>> meshes(label_of.size());
  parallel_for(fields.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      fields[i] = build_bone_field(labels, label_of[i], s.edge_excess.view(), options);
      meshes[i] = build_bone_surface(fields[i], options, &result.simplification_error_mm[i]);
    }
  });
  label_by_fields(fields, {label_of.begin(), label_of.end()}, labels);
  fields = {};
  std::vector<LabelSurface> surfaces;
  for (std::size_t i = 0; i < meshes.size(); ++i) surfaces.push_back({label_of[i], &meshes[i]});
  result.evidence = measure_evidence(labels, regions, s.edge_excess.view(), s.smoothed_hu.view(),
                                     surfaces, naming);
  s.smoothed_hu = s.edge_excess = {};
  std::vector<TriangleMesh*> moved;
  std::vector<const TriangleMesh*> done;
  for (MeshIn<frame::Bone>& mesh : meshes) {
    moved.push_back(&mesh);
    done.push_back(&mesh);
  }
  sharpen_surfaces(moved, ct, s.soft_tissue_hu);
  label_by_surfaces(done, label_of, labels);
  for (MeshIn<frame::Bone>& mesh : meshes) result.surfaces.push_back(std::move(mesh));
  return result;
}

}  // namespace carpus::reconstruct
