// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "phantom/phantom.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "anatomy/wrist_model.hpp"
#include "case_io/read_volume.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "phantom/bone_shapes.hpp"
#include "phantom/fracture.hpp"
#include "phantom/write_phantom.hpp"

namespace carpus::phantom {
namespace {

PhantomOptions coarse(FractureKind kind = FractureKind::Nonunion, Side side = Side::Left) {
  PhantomOptions options;
  options.spacing = {0.75, 0.75, 0.75};
  options.fracture = kind;
  options.side = side;
  return options;
}

/// A patient with a nonunion in slightly coarser voxels, made once.
const Phantom& demo() {
  PhantomOptions options;
  options.fracture = FractureKind::Nonunion;
  options.spacing = {0.5, 0.5, 0.6};
  static const Phantom phantom = make_phantom(options);
  return phantom;
}

std::map<int, double> volumes_mm3(const Phantom& phantom) {
  std::map<int, double> volumes;
  for (const std::uint8_t label : phantom.labels.values()) {
    volumes[label] += phantom.labels.geometry().voxel_volume_mm3();
  }
  return volumes;
}

/// Voxels of each connected piece (6 neighbours) of each label, largest first.
std::map<int, std::vector<std::size_t>> pieces_of(const Grid<std::uint8_t>& labels) {
  const GridGeometry& g = labels.geometry();
  std::vector<bool> seen(g.voxel_count());
  std::map<int, std::vector<std::size_t>> pieces;
  for (std::size_t start = 0; start < g.voxel_count(); ++start) {
    if (labels[start] == 0 || seen[start]) continue;
    std::size_t size = 0;
    std::vector<std::size_t> stack{start};
    seen[start] = true;
    while (!stack.empty()) {
      const VoxelIndex v = g.index_of(stack.back());
      stack.pop_back();
      ++size;
      for (const auto& [x, y, z] : std::array<std::array<int, 3>, 6>{
               {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}}) {
        const VoxelIndex n{v.x + x, v.y + y, v.z + z};
        if (!g.contains(n)) continue;
        const std::size_t at = g.offset_of(n);
        if (seen[at] || labels[at] != labels[start]) continue;
        seen[at] = true;
        stack.push_back(at);
      }
    }
    pieces[labels[start]].push_back(size);
  }
  for (auto& [label, sizes] : pieces) std::sort(sizes.rbegin(), sizes.rend());
  return pieces;
}

Vec3 centroid_in_wrist(const Phantom& phantom, std::uint8_t label) {
  const GridGeometry& g = phantom.labels.geometry();
  Vec3 sum{};
  double count = 0;
  for (std::size_t i = 0; i < g.voxel_count(); ++i) {
    if (phantom.labels[i] != label) continue;
    const VoxelIndex v = g.index_of(i);
    sum += Vec3{static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
    ++count;
  }
  return (phantom.wrist_from_patient * Point<frame::Patient>{g.patient_from_voxel(sum / count)}).v;
}

TEST(Phantom, HoldsEveryBoneInOnePiece) {
  PhantomOptions options;
  options.fracture = FractureKind::Nonunion;
  const auto pieces = pieces_of(make_phantom(options).labels);
  for (int label = 1; label <= 16; ++label) {
    ASSERT_TRUE(pieces.contains(label)) << label;
    EXPECT_EQ(pieces.at(label).size(), 1U) << label;
  }
}

TEST(Phantom, CarpalBonesHaveTheModelsVolume) {
  const auto volumes = volumes_mm3(demo());
  const auto& model = anatomy::WristModel::generic();
  for (const BoneId bone : kAllBones) {
    if (model.bone(bone).cut_plane || bone == BoneId::Scaphoid) continue;
    const double wanted = model.bone(bone).volume_mm3;
    EXPECT_NEAR(volumes.at(static_cast<int>(bone)), wanted, 0.02 * wanted) << name_of(bone);
  }
  const double scaphoid = volumes.at(3) + volumes.at(16) + volumes.at(17);
  const double wanted = model.bone(BoneId::Scaphoid).volume_mm3;
  EXPECT_NEAR(scaphoid, wanted, 0.06 * wanted);  // the gap's tissue bulges where the hump opens
}

TEST(Phantom, ShaftsReachTheEndsOfTheFieldOfView) {
  const GridGeometry& g = demo().labels.geometry();
  const auto is_in_slice = [&](BoneId bone, int z) {
    for (int y = 0; y < g.size[1]; ++y)
      for (int x = 0; x < g.size[0]; ++x)
        if (demo().labels[VoxelIndex{x, y, z}] == static_cast<std::uint8_t>(bone)) return true;
    return false;
  };
  EXPECT_TRUE(is_in_slice(BoneId::Radius, 0));  // z runs distally
  EXPECT_TRUE(is_in_slice(BoneId::Ulna, 0));
  for (const BoneId bone :
       {BoneId::Metacarpal2, BoneId::Metacarpal3, BoneId::Metacarpal4, BoneId::Metacarpal5}) {
    EXPECT_TRUE(is_in_slice(bone, g.size[2] - 1)) << name_of(bone);
  }
}

TEST(Phantom, HasTheDensitiesOfAWristCt) {
  const Phantom& p = demo();
  std::map<int, double> sum;
  std::map<int, double> count;
  double greatest = -2000;
  double least = 3000;
  for (std::size_t i = 0; i < p.ct.geometry().voxel_count(); ++i) {
    sum[p.labels[i]] += p.ct[i];
    ++count[p.labels[i]];
    greatest = std::max<double>(greatest, p.ct[i]);
    least = std::min<double>(least, p.ct[i]);
  }
  const auto mean = [&](int label) { return sum[label] / count[label]; };
  EXPECT_GT(greatest, 1200);
  EXPECT_LT(greatest, 2000);
  EXPECT_NEAR(least, -1024, 60);
  // Fractured scaphoid poles 620 +- 124 and 453 +- 71 HU [fractureddensityndscaphoid], here with
  // the sclerotic margins.
  EXPECT_NEAR(mean(3), 700, 200);
  EXPECT_NEAR(mean(16), 620, 200);
  EXPECT_GT(mean(3), mean(16));
  for (int label = 4; label <= 10; ++label) EXPECT_NEAR(mean(label), 600, 200) << label;
  EXPECT_LT(mean(17), 450);  // 150 HU, blurred by the faces 1 mm away
}

TEST(Phantom, WithoutFractureTheScaphoidIsWhole) {
  const auto volumes = volumes_mm3(make_phantom(coarse(FractureKind::None)));
  EXPECT_FALSE(volumes.contains(16));
  EXPECT_FALSE(volumes.contains(17));
  EXPECT_NEAR(volumes.at(3), 1964, 60);
}

TEST(Phantom, AFractureInPlaceLeavesOneBone) {
  for (const FractureKind kind :
       {FractureKind::Waist, FractureKind::ProximalPole, FractureKind::DistalThird}) {
    const auto volumes = volumes_mm3(make_phantom(coarse(kind)));
    EXPECT_FALSE(volumes.contains(16)) << name_of(kind);
    EXPECT_NEAR(volumes.at(3), 1964, 60) << name_of(kind);
  }
}

TEST(Phantom, DisplacedFragmentsAreWholeAndApart) {
  for (const FractureKind kind : {FractureKind::Displaced, FractureKind::Humpback}) {
    const auto pieces = pieces_of(make_phantom(coarse(kind)).labels);
    for (const int label : {3, 16}) {  // shards of a worn edge are small
      const std::vector<std::size_t>& sizes = pieces.at(label);
      const auto all = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
      EXPECT_GT(static_cast<double>(sizes.front()), 0.98 * static_cast<double>(all))
          << name_of(kind) << " " << label;
    }
  }
}

TEST(Phantom, FreshFragmentsFitWherePutBackAndOldOnesHaveLostBone) {
  const anatomy::WristModel& model = anatomy::WristModel::generic();
  for (const FractureKind kind : {FractureKind::Displaced, FractureKind::Nonunion}) {
    const Fracture fracture = make_fracture(model, kind, 5);
    const BoneShapes shapes(model, fracture);
    const auto piece = [&](BonePart part) {
      return *std::find_if(shapes.shapes().begin(), shapes.shapes().end(),
                           [&](const Shape& shape) { return shape.part == part; });
    };
    const auto displaced = [&](const Vec3& p) {
      return fracture.rotation * (p - fracture.pivot) + fracture.pivot + fracture.shift;
    };
    const Vec3 across = any_perpendicular(fracture.normal);
    for (const double beside : {-2.0, 0.0, 2.0}) {
      const Vec3 p = fracture.point + across * beside;
      const auto gap_at = [&](double height) {  // 0.2 to either side of the face
        const Vec3 q = p + fracture.normal * (height - fracture.height(p));
        return height < 0 ? shapes.value(piece(BonePart::Proximal), q)
                          : shapes.value(piece(BonePart::Distal), displaced(q));
      };
      const bool is_fresh = kind == FractureKind::Displaced;
      for (const double height : {-0.3, 0.3}) {
        EXPECT_EQ(gap_at(height) < 0, is_fresh) << name_of(kind) << " " << beside << " " << height;
      }
    }
  }
}

TEST(Phantom, EveryKindOfFractureHasItsName) {
  for (const FractureKind kind : kAllFractureKinds) EXPECT_EQ(fracture_of(name_of(kind)), kind);
  EXPECT_FALSE(fracture_of("ankle"));
}

TEST(Phantom, AProximalNonunionLeavesASmallProximalPole) {
  const auto volumes = volumes_mm3(make_phantom(coarse(FractureKind::ProximalNonunion)));
  EXPECT_LT(volumes.at(3), 0.45 * volumes.at(16));
  EXPECT_GT(volumes.at(3), 150);
}

TEST(Phantom, LiesInThePatientAsItsPoseSays) {
  for (const Side side : {Side::Left, Side::Right}) {
    const Phantom p = make_phantom(coarse(FractureKind::None, side));
    EXPECT_NEAR(p.wrist_from_patient.rotation.determinant(), 1.0, 1e-12);
    const double ulnar = side == Side::Left ? 1.0 : -1.0;
    const Vec3 pisiform = centroid_in_wrist(p, static_cast<std::uint8_t>(BoneId::Pisiform));
    const Vec3 triquetrum = centroid_in_wrist(p, static_cast<std::uint8_t>(BoneId::Triquetrum));
    const Vec3 thumb = centroid_in_wrist(p, static_cast<std::uint8_t>(BoneId::Metacarpal1));
    EXPECT_GT(pisiform.z, triquetrum.z);  // volar
    EXPECT_LT(thumb.y * ulnar, -15.0);    // radial
  }
}

TEST(Phantom, BonesFillAScanOfAGivenSize) {
  PhantomOptions options;
  options.filled_voxels = {96, 80, 112};
  const Phantom phantom = make_phantom(options);
  const GridGeometry& g = phantom.ct.geometry();
  ASSERT_EQ(g.size, *options.filled_voxels);
  VoxelIndex low{g.size[0], g.size[1], g.size[2]};
  VoxelIndex high{-1, -1, -1};
  for (std::size_t i = 0; i < phantom.labels.values().size(); ++i) {
    if (phantom.labels[i] == 0) continue;
    const VoxelIndex v = g.index_of(i);
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  constexpr double kMostMm = 5.5;  // 4 mm and what a step of 1 mm misses of a corner
  EXPECT_LE(low.x * g.spacing.x, kMostMm);
  EXPECT_LE(low.y * g.spacing.y, kMostMm);
  EXPECT_LE(low.z * g.spacing.z, kMostMm);
  EXPECT_LE((g.size[0] - 1 - high.x) * g.spacing.x, kMostMm);
  EXPECT_LE((g.size[1] - 1 - high.y) * g.spacing.y, kMostMm);
  EXPECT_LE((g.size[2] - 1 - high.z) * g.spacing.z, kMostMm);
  options.filled_voxels = {1000, 80, 112};
  EXPECT_THROW((void)make_phantom(options), InvalidInput);
}

TEST(Phantom, ScalesTheWholeWrist) {
  PhantomOptions small = coarse(FractureKind::None);
  small.scale = 0.9;
  const auto volumes = volumes_mm3(make_phantom(small));
  EXPECT_NEAR(volumes.at(static_cast<int>(BoneId::Capitate)), 2548 * 0.729, 60);
}

TEST(Phantom, GivesTheSameBytesForASeedOnAnyNumberOfThreads) {
  const Phantom one = make_phantom(coarse());
  // Backwards and in ranges of another length: what a pool may do.
  install_parallel_executor([](std::size_t count, std::size_t, const auto& body) {
    for (std::size_t end = count; end > 0;) {
      const std::size_t begin = end > 7 ? end - 7 : 0;
      body(begin, end);
      end = begin;
    }
  });
  const Phantom two = make_phantom(coarse());
  install_parallel_executor({});
  EXPECT_TRUE(std::equal(one.ct.values().begin(), one.ct.values().end(), two.ct.values().begin()));
  PhantomOptions other = coarse();
  other.seed = 2;
  const Phantom three = make_phantom(other);
  EXPECT_NE(three.wrist_from_patient, one.wrist_from_patient);
}

TEST(Phantom, NiftiSaysThatItIsSimulatedAwayFromItsTruth) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("carpus_phantom_" + std::to_string(::getpid()));
  write_phantom(demo(), folder, CtFormat::Nifti);
  EXPECT_EQ(case_io::read_description(folder / "ct.nii.gz"), "simulated wrist, seed 1");
  std::filesystem::remove_all(folder);
}

TEST(Phantom, RefusesImpossibleOptions) {
  PhantomOptions options;
  options.scale = 3;
  EXPECT_THROW((void)make_phantom(options), InvalidInput);
  options.scale = 1;
  options.spacing.z = 0;
  EXPECT_THROW((void)make_phantom(options), InvalidInput);
}

}  // namespace
}  // namespace carpus::phantom
