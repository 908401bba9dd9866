// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The smallest case that can be saved: three octahedra for bones, noise for a CT.
#pragma once

#include <cstddef>
#include <cstdint>

#include "anatomy/bone_id.hpp"
#include "cases/case_data.hpp"
#include "geometry/mat3.hpp"
#include "geometry/pose.hpp"

namespace carpus::case_io::test {

/// An octahedron about `centre`, with the hull in the order that hull_from_mesh gives.
inline cases::Bone octahedron(BoneId id, BonePart part, std::uint8_t label, const Vec3& centre) {
  cases::Bone bone;
  bone.bone = id;
  bone.part = part;
  bone.label = label;
  const double r = 5.1 + 0.1 * label;
  for (const Vec3& d : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1},
                        Vec3{0, 0, -1}}) {
    bone.surface.vertices.push_back(centre + d * r);
  }
  bone.surface.facets = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                         {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  bone.hull.vertices = bone.surface.vertices;
  bone.hull.facets = bone.surface.facets;
  bone.hull.neighbours = {{4, 1, 3}, {5, 2, 0}, {6, 3, 1}, {7, 0, 2},
                          {0, 7, 5}, {1, 4, 6}, {2, 5, 7}, {3, 6, 4}};
  bone.hull.input_indices = {0, 1, 2, 3, 4, 5};
  GridGeometry g;
  g.size = {7, 6, 5};
  g.spacing = {0.1 + 0.2, 1.0 / 3.0, 0.7};  // numbers that text could round
  g.origin = centre - Vec3{1.0 / 7.0, 2, 3};
  bone.distance_field = Grid<float>(g);
  for (std::size_t i = 0; i < g.voxel_count(); ++i) {
    bone.distance_field[i] = static_cast<float>(i) / 7.0F - 3.0F;
  }
  return bone;
}

/// A nerve and a tendon with numbers that text could round.
inline std::vector<cases::Structure> small_structures() {
  return {{"epl",
           "extensor pollicis longus",
           anatomy::StructureKind::Tendon,
           1.0 / 3.0,
           BoneId::Radius,
           {{{1.0 / 7.0, 2, 3}, 0}, {{4, 5.1, 6}, 0.1 + 0.2}, {{7, 8, 9}, 1}}},
          {"dsbun",
           "dorsal sensory branch of the ulnar nerve",
           anatomy::StructureKind::Nerve,
           0.8,
           BoneId::Ulna,
           {{{1, 2, 3}, 0.5}, {{-4, 5, 6}, 0.75}}}};
}

/// Two by two nodes with numbers that text could round; scanned in the first of them.
inline cases::HandMotion small_table() {
  cases::HandMotion table;
  table.limits = {{-1.0 / 3.0, 1.1}, {-0.7, 0.1 + 0.2}, {-1.5, 1.5}, {0, 100}};
  table.scan = {-1.0 / 3.0, -0.7, 0, 0};
  table.flexion_rad = {-1.0 / 3.0, 1.1};
  table.deviation_rad = {-0.7, 0.1 + 0.2};
  table.nodes.resize(4);
  for (std::size_t i = 1; i < 4; ++i) {
    for (const auto group : anatomy::kMovingGroups) {
      auto& motion = table.nodes[i].groups[static_cast<std::size_t>(group)];
      const double x = 0.01 * static_cast<double>(i) / 3.0;
      motion = {{1, x, 0, -x}, {1.0 / 7.0, static_cast<double>(i), 0.3}};
    }
  }
  for (const auto group : anatomy::kMovingGroups) {
    table.reference[static_cast<std::size_t>(group)] = {1.0 / 9.0, 2, 3};
    table.report.corrections[static_cast<std::size_t>(group)] = {0.1, 0.3, 1.0 / 3.0, 7};
  }
  table.hand_axis = {0, 0.6, -0.8};
  table.radiocarpal_mm_per_n = 1.0 / 98;
  table.midcarpal_mm_per_n = 2.0 / 98;
  table.pronation_axis = {0, 0, 1};
  table.pronation_centre = {1, 2.0 / 3.0, 3};
  table.pronation_rad = {-1.5, 0, 1.5};
  table.pronation_shift = {{0.1, 0.2, 0.3}, {}, {0.1 + 0.2, 0, 0}};
  table.report.scan_overlap_mm = 0.01;
  table.report.overlap_of_model_mm = 3.3;
  table.report.cells_over_tenth_mm = 1.0 / 70;
  return table;
}

inline cases::CaseData small_case() {
  cases::CaseData data;
  data.pseudonym = "wrist \"7\"";
  data.side = Side::Right;
  data.provenance = {true,
                     "simulated wrist, seed 7",
                     "carpus 0.1.0",
                     "2026-01-02T03:04:05Z",
                     {"axes were put in the order left, posterior, superior"}};
  data.wrist_from_patient = {rotation_about({0, 0, 1}, 0.3), {1.0 / 3.0, 2, 3}};
  GridGeometry g;
  g.size = {20, 18, 16};
  g.spacing = {0.3, 0.3, 0.5};
  g.origin = {-12.1, 3.7, 100.0 / 3.0};
  g.direction = rotation_about({0, 1, 0}, 0.1);
  data.ct = Grid<std::int16_t>(g);
  data.labels = Grid<std::uint8_t>(g);
  for (std::size_t i = 0; i < g.voxel_count(); ++i) {
    data.ct[i] = static_cast<std::int16_t>((i * 7919) % 3000) - 1000;
    data.labels[i] = static_cast<std::uint8_t>(i % 17);
  }
  data.bones = {octahedron(BoneId::Scaphoid, BonePart::Proximal, 3, {1, 2, 3}),
                octahedron(BoneId::Lunate, BonePart::Whole, 4, {20, 2, 3}),
                octahedron(BoneId::Scaphoid, BonePart::Distal, 16, {1, 20, 3})};
  data.bones[1].patient_from_bone = {rotation_about({1, 0, 0}, 0.2), {4, 5, 1.0 / 9.0}};
  data.skin = Pose<frame::Patient, frame::Bone>{} * data.bones[0].surface;
  data.skin.facets.pop_back();  // skin may be open
  data.scaphoid = {{{1, 2, 3}, {4, 5, 6}}, 3.25, {{7, 8, 9}, {1.0 / 3.0, 11, 12}}, {2, 3, 4}};
  data.hand_motion = small_table();
  return data;
}

}  // namespace carpus::case_io::test
