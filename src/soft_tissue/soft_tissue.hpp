// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The soft tissue of one case: generated (make_soft_tissue.hpp), never seen in its CT, and that is
// said wherever it is shown. Frame Patient as scanned [mm].
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "geometry/triangle_mesh.hpp"
#include "soft_tissue/tissue_table.hpp"

namespace carpus::soft_tissue {

/// Where an end, or a place on the way, of a strand is held.
struct Anchor {
  std::uint8_t label = 0;  ///< of the case's bone or part; 0: on another ligament
  std::string ligament;    ///< where there is no bone
  double fraction = 0;     ///< of that ligament's course
  Vec3 at;                 ///< on the bone's surface, or on that ligament's middle
  std::size_t point = 0;   ///< of the strand's course
};

/// A line of force of a ligament, as long as it lies in the scan: tension only, slack where shorter
/// than its rest length.
struct Strand {
  std::vector<Vec3> course;  ///< about a mm apart, wrapped over the bones
  std::vector<Anchor> anchors;
  double rest_length_mm = 0;
  double stiffness_n_per_mm = 0;
};

struct Ligament {
  std::string id;
  std::string name;
  std::string group;
  std::vector<Strand> strands;       ///< from one edge to the other
  double length_mm = 0;              ///< of the middle strand (or two), between its ends
  double straight_mm = 0;            ///< the same as the crow flies
  double width_mm = 0;               ///< mean
  double thickness_mm = 0;           ///< as meant: the table's times the size
  double measured_thickness_mm = 0;  ///< of the body, median
  Range length_range_mm;             ///< of the table times the size
  Range thickness_range_mm;
  TriangleMesh body;
};

/// Cartilage of one bone or part: a closed sheet on its surface, as it lies. Where a displaced
/// piece lies nearer to its neighbour than both layers are thick, both are pressed thinner than
/// they are unloaded.
struct Cartilage {
  std::uint8_t label = 0;
  TriangleMesh body;
  std::vector<float> vertex_thickness_mm;  ///< by the vertices of the *bone's* surface; 0 is bare
  double area_mm2 = 0;                     ///< of the bone that it covers
  double mean_thickness_mm = 0;            ///< over that, without the tapered edge; unloaded
  double greatest_thickness_mm = 0;        ///< unloaded
  double pressed_area_mm2 = 0;      ///< of the area, where it lies pressed by more than a tenth
  double pressed_thickness_mm = 0;  ///< as it lies there, in the mean; 0 where nothing presses
  Range thickness_range_mm;
};

struct Disc {
  TriangleMesh middle;  ///< the sheet that it thickens
  TriangleMesh body;
  double measured_thickness_mm = 0;
  Range thickness_range_mm;
};

/// What lines a joint's space, by vertex.
enum class Lining : std::uint8_t { Synovium = 0, Bone = 1, Cartilage = 2, Disc = 3, Ligament = 4 };

/// The closed surface of a joint's space: what a scope in it may see.
struct Space {
  std::string id;
  std::string name;
  TriangleMesh surface;        ///< outward from the space
  std::vector<Lining> lining;  ///< by vertex
  double volume_mm3 = 0;
};

/// Two tissues that lie in each other.
struct Overlap {
  std::string first;
  std::string second;
  double mm = 0;  ///< how deep
};

struct SoftTissue {
  double size = 1;             ///< of the wrist against the generic one
  double worst_misfit_mm = 0;  ///< rms of the worst of the bones' fits
  std::vector<Ligament> ligaments;
  std::vector<Cartilage> cartilage;  ///< in the order of the case's bones
  Disc disc;                         ///< empty where it cannot be attached
  std::vector<Space> spaces;
  double deepest_in_bone_mm = 0;  ///< of any vertex of any body but cartilage's own bone
  /// What lies in each other by more than 0.1 mm, the deepest first; in cases of older programs
  /// nobody looked.
  std::vector<Overlap> overlaps;
  double deepest_in_other_mm = 0;     ///< of any tissue in another
  std::vector<std::string> problems;  ///< in words; empty when all is well
};

[[nodiscard]] double length_of(const Strand& strand);

}  // namespace carpus::soft_tissue
