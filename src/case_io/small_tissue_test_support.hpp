// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Soft tissue with one of each kind, of four points each.
#pragma once

#include "soft_tissue/soft_tissue.hpp"

namespace carpus::case_io::test {

inline TriangleMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

inline soft_tissue::SoftTissue small_tissue() {
  soft_tissue::SoftTissue tissue;
  tissue.size = 1.03;
  tissue.deepest_in_other_mm = 0.25;
  tissue.overlaps = {{"SL_dorsal", "extensor pollicis longus", 0.25}};
  tissue.problems = {"LT_volar: 3.9 mm long"};
  soft_tissue::Ligament l;
  l.id = "SL_dorsal";
  l.name = "scapholunate, dorsal part";
  l.group = "proximal_row";
  l.body = tetrahedron();
  l.length_mm = 5.3;
  soft_tissue::Strand s;
  s.course = {{1, 2, 3}, {0.1, 0.2, 0.3}};
  s.rest_length_mm = 3.25;
  s.stiffness_n_per_mm = 23;
  s.anchors = {{3, "", 0, {1, 2, 3}, 0}, {0, "VRUL", 0.45, {0.1, 0.2, 0.3}, 1}};
  l.strands = {s};
  tissue.ligaments = {l};
  soft_tissue::Cartilage c;
  c.label = 3;
  c.body = tetrahedron();
  c.vertex_thickness_mm = {0, 0.5F};
  c.pressed_area_mm2 = 0.25;
  c.pressed_thickness_mm = 0.5;
  tissue.cartilage = {c};
  tissue.disc.body = tissue.disc.middle = tetrahedron();
  tissue.spaces = {{"radiocarpal",
                    "radiocarpal joint",
                    tetrahedron(),
                    {soft_tissue::Lining::Bone, soft_tissue::Lining::Disc,
                     soft_tissue::Lining::Synovium, soft_tissue::Lining::Ligament},
                    12}};
  return tissue;
}

}  // namespace carpus::case_io::test
