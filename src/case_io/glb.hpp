// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Surfaces as one binary glTF for viewers: a node for each, with its name.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "anatomy/material_table.hpp"
#include "arthroscopy/joint_wall.hpp"
#include "case_io/bone_bitmap.hpp"
#include "cases/case_data.hpp"
#include "geometry/pose.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::case_io {

/// A surface to show; pointers are owned elsewhere.
struct NamedMesh {
  std::string name;
  const TriangleMesh* mesh = nullptr;
  Pose<frame::Patient, frame::Bone> patient_from_bone;  ///< becomes the node's matrix
  anatomy::Tissue tissue = anatomy::Tissue::Bone;
  const BoneBitmap* bitmap = nullptr;  ///< null: its material alone
  std::vector<Vec3> normals{};         ///< of the vertices; empty: those of the facets
  bool is_generated = false;           ///< seen in no CT: its node's `extras` say `generated`
};

/// A tube to show: drawn round its middle line, which stays where it was scanned. Its node carries
/// in `extras` what it is (`structure`: "tendon", `title`, `forearm`: "radius", `generated`: true),
/// and its vertices in `_HAND_SHARE` how far each goes with the hand.
struct NamedTube {
  const cases::Structure* structure = nullptr;
};

/// The bytes of a .glb: one node and mesh each, float32 positions [mm, frame Patient before the
/// node's matrix] and smooth normals, uint32 indices. The unit is mm and +z is superior, not the
/// metres and Y-up of the glTF standard: the viewer converts (docs/case_format.md). Empty meshes
/// are left out. Each has its tissue's material: physically based, with KHR_materials_specular, and
/// its six fields as they are in `extras`; a bitmap is a PNG within the file, its charts' borders
/// split vertices, whose normals stay those of the whole surface.
[[nodiscard]] std::string make_glb(std::span<const NamedMesh> meshes,
                                   std::span<const NamedTube> tubes = {},
                                   std::span<const arthroscopy::JointWall> joints = {});

/// Bones (where they are now, each with its bitmap), skin and structures of a case, named as in the
/// case.
/// @param joints  for each a node `joint_wall_<its id>` more: `extras` {generated: true, joint: its
///     id}, and by vertex `_LINING` (soft_tissue::Lining), `_FIBRE`, `_PROXIMAL` and `_DISTAL`
///     (place of a bone in the case), `_DISTAL_SHARE`, and how it goes with the bones: of four,
///     `_BODIES` (places in the case) and `_SHARES` (1 in all, the foremost first).
/// @param besides  surfaces of the same patient, after the skin.
[[nodiscard]] std::string make_case_glb(const cases::CaseData& data,
                                        std::span<const arthroscopy::JointWall> joints = {},
                                        std::span<const NamedMesh> besides = {});

/// Vertex normals: the mean of the facets' normals, weighted by their area.
[[nodiscard]] std::vector<Vec3> smooth_normals(const TriangleMesh& mesh);

}  // namespace carpus::case_io
