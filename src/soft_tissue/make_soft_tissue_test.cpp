// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/make_soft_tissue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "cases/find_structure.hpp"
#include "cases/make_structures.hpp"
#include "geometry/voxels_inside.hpp"
#include "soft_tissue/model_case_test_support.hpp"

namespace carpus::soft_tissue {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const Ligament* find(const SoftTissue& tissue, const std::string& id) {
  for (const Ligament& l : tissue.ligaments) {
    if (l.id == id) return &l;
  }
  return nullptr;
}

void expect_all_is_there(const SoftTissue& tissue) {
  EXPECT_THAT(tissue.problems, IsEmpty());
  EXPECT_EQ(tissue.ligaments.size(), TissueTable::generic().ligaments.size());
  EXPECT_EQ(tissue.cartilage.size(), 10U);
  EXPECT_EQ(tissue.spaces.size(), 3U);
  EXPECT_LE(tissue.deepest_in_bone_mm, 0.1);
  EXPECT_LE(tissue.deepest_in_other_mm, 0.1);
  EXPECT_NEAR(tissue.size, 1, 0.02);
  for (const Ligament& l : tissue.ligaments) {
    EXPECT_EQ(check_surface(l.body), SurfaceStatus::Ok) << l.id;
    EXPECT_GT(volume_of(l.body), 0) << l.id;
  }
}

/// Strands are held where they say and share the stiffness.
void expect_strands_are_held(const SoftTissue& tissue) {
  for (const Ligament& l : tissue.ligaments) {
    const auto tabled = std::find_if(TissueTable::generic().ligaments.begin(),
                                     TissueTable::generic().ligaments.end(),
                                     [&](const TabledLigament& t) { return t.id == l.id; });
    double stiffness = 0;
    for (const Strand& s : l.strands) {
      stiffness += s.stiffness_n_per_mm;
      EXPECT_DOUBLE_EQ(s.rest_length_mm, length_of(s)) << l.id;
      for (const Anchor& a : s.anchors) {
        // Lifted by half a thickness, tapered at the ends.
        EXPECT_LT(distance(s.course[a.point], a.at), l.thickness_mm + 0.6) << l.id;
      }
    }
    EXPECT_NEAR(stiffness, tabled->stiffness_n_per_mm, 1e-9) << l.id;
  }
}

void expect_spaces_nowhere_meet(const SoftTissue& tissue) {
  const auto& spaces = tissue.spaces;
  GridGeometry g;
  g.size = {220, 220, 220};
  g.spacing = {0.3, 0.3, 0.3};
  const Aabb box = bounds_of(spaces[0].surface.vertices);
  g.origin = box.centre() - Vec3{33, 33, 33};
  std::vector<Grid<std::uint8_t>> inside;
  for (const Space& s : spaces) inside.push_back(voxels_inside(s.surface, g));
  std::size_t shared = 0;
  for (std::size_t i = 0; i < g.voxel_count(); ++i) {
    if (inside[0][i] + inside[1][i] + inside[2][i] > 1) ++shared;
  }
  EXPECT_EQ(shared, 0U);
  for (const Space& s : spaces) {
    EXPECT_EQ(s.lining.size(), s.surface.vertices.size());
    EXPECT_THAT(s.lining, Contains(Lining::Synovium)) << s.id;
    EXPECT_THAT(s.lining, Contains(Lining::Cartilage)) << s.id;
  }
  EXPECT_THAT(spaces[0].lining, Contains(Lining::Disc));
}

void expect_cartilage(const SoftTissue& tissue) {
  for (const Cartilage& c : tissue.cartilage) {
    EXPECT_EQ(check_surface(c.body), SurfaceStatus::Ok);
    EXPECT_GT(c.area_mm2, 30);
    EXPECT_LE(c.greatest_thickness_mm, c.thickness_range_mm.high);
  }
}

TEST(MakeSoftTissue, OfTheGenericWristIsWholeOnBothSidesAndGrowsWithTheSize) {
  const SoftTissue left = make_soft_tissue(test::model_case(Side::Left, 1, Mat3::identity()));
  expect_all_is_there(left);
  expect_strands_are_held(left);
  expect_spaces_nowhere_meet(left);
  expect_cartilage(left);
  const double size = 1.15;
  const SoftTissue right =
      make_soft_tissue(test::model_case(Side::Right, size, rotation_about({0.6, 0.0, 0.8}, 2.0)));
  EXPECT_THAT(right.problems, IsEmpty());
  EXPECT_LE(right.deepest_in_other_mm, 0.1);
  EXPECT_NEAR(right.size, size, 0.02);
  for (const Ligament& l : right.ligaments) {
    const Ligament* mirrored = find(left, l.id);
    ASSERT_NE(mirrored, nullptr);
    EXPECT_NEAR(l.length_mm / size, mirrored->length_mm, 0.4) << l.id;
  }
}

TEST(MakeSoftTissue, FusedAndMissingBonesAreNamedAndTheRestIsMade) {
  cases::CaseData data = test::model_case(Side::Left, 1, Mat3::identity());
  // Lunate and triquetrum as one body, called lunate.
  auto& bones = data.bones;
  const auto of = [&](BoneId id) {
    return std::find_if(bones.begin(), bones.end(), [&](const auto& b) { return b.bone == id; });
  };
  TriangleMesh fused = of(BoneId::Lunate)->surface;
  const TriangleMesh& other = of(BoneId::Triquetrum)->surface;
  const auto first = static_cast<std::uint32_t>(fused.vertices.size());
  fused.vertices.insert(fused.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Triangle& t : other.facets) {
    fused.facets.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  of(BoneId::Lunate)->surface = MeshIn<frame::Bone>(fused);
  bones.erase(of(BoneId::Triquetrum));
  const SoftTissue tissue = make_soft_tissue(data);
  EXPECT_THAT(tissue.problems, Contains(HasSubstr("LT_volar) cannot be attached")));
  EXPECT_THAT(tissue.problems, Contains(HasSubstr("SL_dorsal) cannot be attached: the lunate")));
  EXPECT_EQ(find(tissue, "LRL"), nullptr);
  EXPECT_NE(find(tissue, "RSC"), nullptr);
  EXPECT_FALSE(tissue.disc.body.facets.empty());
  EXPECT_THAT(tissue.overlaps, IsEmpty());
}

std::vector<double> portal_distances(const cases::StructureFigures& figures) {
  std::vector<double> mm;
  for (const cases::PortalDistance& portal : figures.portals) mm.push_back(portal.mm);
  return mm;
}

TEST(MakeSoftTissue, StructuresAreMeasuredAsTheCaseHasThem) {
  cases::CaseData data = test::model_case(Side::Left, 1, Mat3::identity());
  const cases::MadeStructures made = cases::make_structures(data);
  const std::vector<double> before = portal_distances(made.figures);
  data.structures = made.structures;
  EXPECT_EQ(portal_distances(cases::measure_structures(data)), before);
  constexpr double kThickerMm = 0.5;
  for (cases::Structure& each : data.structures) {
    if (each.kind == anatomy::StructureKind::Nerve) each.radius_mm += kThickerMm;
  }
  const std::vector<double> after = portal_distances(cases::measure_structures(data));
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(after[i], before[i] - kThickerMm, 1e-9) << i;
  }
}

TEST(MakeSoftTissue, HoldsTendonsArteriesAndNervesToTheBoundAndMovesThemOutOfTheWay) {
  cases::CaseData data = test::model_case(Side::Left, 1, Mat3::identity());
  data.structures = cases::make_structures(data).structures;
  const std::vector<cases::Structure> before = data.structures;
  const SoftTissue tissue = make_soft_tissue_moving_structures(data);
  EXPECT_THAT(tissue.problems, IsEmpty());
  EXPECT_LE(tissue.deepest_in_other_mm, 0.1);
  ASSERT_EQ(data.structures.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double mm = cases::length_of(before[i]);
    EXPECT_NEAR(cases::length_of(data.structures[i]), mm, 0.04 * mm) << before[i].id;
    EXPECT_EQ(data.structures[i].radius_mm, before[i].radius_mm);
  }
  // One of them as it lay before.
  data.structures = {*cases::find_structure(before, "edc_index")};
  const SoftTissue unmoved = make_soft_tissue(data);
  EXPECT_GT(unmoved.deepest_in_other_mm, 0.5);
  EXPECT_THAT(unmoved.problems, Contains(HasSubstr("DRC, extensor digitorum to the index finger")));
  EXPECT_EQ(data.structures[0], *cases::find_structure(before, "edc_index"));
}

const Cartilage& of_label(const SoftTissue& tissue, std::uint8_t label) {
  return *std::find_if(tissue.cartilage.begin(), tissue.cartilage.end(),
                       [&](const Cartilage& c) { return c.label == label; });
}

/// How much two closed bodies have in common.
double shared_mm3(const TriangleMesh& a, const TriangleMesh& b) {
  constexpr double kVoxelMm = 0.2;
  const Aabb box = bounds_of(a.vertices);
  GridGeometry g;
  for (std::size_t k = 0; k < 3; ++k) {
    g.size[k] = static_cast<int>(box.extent()[k] / kVoxelMm) + 2;
  }
  g.spacing = {kVoxelMm, kVoxelMm, kVoxelMm};
  g.origin = box.low;
  const Grid<std::uint8_t> in_a = voxels_inside(a, g);
  const Grid<std::uint8_t> in_b = voxels_inside(b, g);
  std::size_t shared = 0;
  for (std::size_t i = 0; i < g.voxel_count(); ++i) shared += in_a[i] & in_b[i];
  return static_cast<double>(shared) * kVoxelMm * kVoxelMm * kVoxelMm;
}

TEST(MakeSoftTissue, CartilageOfADisplacedPieceIsThatOfTheWholeBonePressedWhereItLies) {
  constexpr double kWornMm = 0.6;  // of which two layers of 0.75 mm have to lie
  const SoftTissue in_place = make_soft_tissue(test::broken_case(0, kWornMm));
  const SoftTissue displaced = make_soft_tissue(test::broken_case(3.0, kWornMm));
  for (const Cartilage& c : in_place.cartilage) EXPECT_EQ(c.pressed_area_mm2, 0);
  EXPECT_LE(displaced.deepest_in_bone_mm, 0.1);
  EXPECT_THAT(displaced.overlaps, IsEmpty());
  EXPECT_THAT(displaced.problems, Not(Contains(HasSubstr("cartilage"))));
  const Cartilage& piece = of_label(displaced, test::kDistalPiece);
  const Cartilage& trapezium = of_label(displaced, static_cast<std::uint8_t>(BoneId::Trapezium));
  for (const Cartilage* pressed : {&piece, &trapezium}) {
    const Cartilage& before = of_label(in_place, pressed->label);
    // It faces what it faced, and has not lost what has been pressed.
    EXPECT_NEAR(pressed->area_mm2, before.area_mm2, 0.05 * before.area_mm2);
    EXPECT_GE(pressed->mean_thickness_mm, before.mean_thickness_mm);
    EXPECT_LE(pressed->greatest_thickness_mm, pressed->thickness_range_mm.high);
    EXPECT_GT(pressed->pressed_area_mm2, 0.4 * pressed->area_mm2);
    EXPECT_LT(pressed->pressed_thickness_mm, 0.5);
    EXPECT_EQ(check_surface(pressed->body), SurfaceStatus::Ok);
  }
  EXPECT_EQ(shared_mm3(piece.body, trapezium.body), 0);
}

}  // namespace
}  // namespace carpus::soft_tissue
