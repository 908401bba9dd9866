// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The skin is the smooth union of every bone inflated by the tissue that covers it and of a few
// strands for the muscles of forearm, thenar, hypothenar and palm. It is evaluated on a coarse grid
// (it bends over centimetres) and read by trilinear interpolation.
#include "phantom/soft_tissue.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.hpp"
#include "geometry/trilinear.hpp"
#include "phantom/coherent_noise.hpp"

namespace carpus::phantom {
namespace {

constexpr double kCoarseStepMm = 2.0;
/// Tissue over the back of a bone, where it is thinnest.
constexpr double kCoverMm = 4.5;
/// Blend radius of the outline: bones and muscles show through as soft ridges.
constexpr double kBlendMm = 3.0;
/// Air around the bones' boxes in the coarse grid.
constexpr double kMarginMm = 24.0;
/// Parts of the outline further than this from a point do not move its skin by 0.01 mm.
constexpr double kIgnoredBeyondMm = 8.0 * kBlendMm;
/// The part of the hand that any field of view here can show, along the forearm.
constexpr double kDistalEndMm = -85.0;
constexpr double kFingerEndMm = -190.0;
constexpr double kProximalEndMm = 55.0;

constexpr double kAirDepth = -1000.0;
constexpr double kSkinHu = 45;
constexpr double kFatHu = -95;
constexpr double kMuscleHu = 55;
constexpr double kTendonHu = 100;
constexpr double kSkinThicknessMm = 1.1;

/// Muscles that fill the outline, left wrist.
constexpr std::array kMuscles{
    Strand{{60, 3, 8}, {14, 6, 9}, 13.0},         Strand{{60, 12, 8}, {14, 11, 9}, 13.0},
    Strand{{14, 7, 9}, {-8, 6, 9}, 10.5},         Strand{{60, 7, -8}, {14, 6, -6}, 11.0},
    Strand{{-8, 1, 9}, {-26, -1, 7}, 10.5},       Strand{{-8, 12, 9}, {-26, 11, 7}, 10.5},
    Strand{{-26, 8, 3}, {-75, 6, -20}, 10.0},     Strand{{-26, -4, 2}, {-75, -8, -25}, 10.0},
    Strand{{-10, -8, 12}, {-22, -34, 8}, 10.5},   Strand{{-22, -34, 8}, {-30, -80, 5}, 9.0},
    Strand{{-26, -14, 6}, {-38, -28, -4}, 9.5},   Strand{{-20, 20, 9}, {-75, 17, -14}, 9.5},
    Strand{{-30, -18, -6}, {-58, -24, -26}, 7.0}, Strand{{14, 6, -6}, {-24, 6, -9}, 10.0},
    Strand{{12, 15, -4}, {-22, 14, -7}, 9.0},     Strand{{10, -4, -3}, {-16, -6, -4}, 8.5}};

/// Middle lines along which tendons run side by side, left wrist.
constexpr std::array<Vec3, 6> kFlexorLine{Vec3{60, 8, 13},  Vec3{12, 8, 15.5}, Vec3{-5, 7, 14},
                                          Vec3{-18, 6, 10}, Vec3{-35, 4, 0},   Vec3{-75, 0, -20}};
constexpr std::array<Vec3, 5> kExtensorLine{Vec3{60, 6, -11}, Vec3{12, 6, -14.5},
                                            Vec3{-10, 6, -15.5}, Vec3{-26, 3, -20},
                                            Vec3{-75, -2, -52}};

template <std::size_t N>
void add_tendons(std::vector<Strand>& tendons,
                 const std::array<Vec3, N>& line,
                 const Vec3& offset,
                 double radius_mm) {
  for (std::size_t i = 0; i + 1 < N; ++i) {
    tendons.push_back({line[i] + offset, line[i + 1] + offset, radius_mm});
  }
}

std::vector<Strand> make_tendons() {
  std::vector<Strand> tendons;
  for (const double y : {-6.6, -2.2, 2.2, 6.6}) {
    add_tendons(tendons, kFlexorLine, {0, y, 1.0}, 1.9);
    add_tendons(tendons, kFlexorLine, {0, y, -3.0}, 1.7);
  }
  for (const double y : {-17.0, -10.5, -4.0, 1.0, 6.0, 14.0}) {
    add_tendons(tendons, kExtensorLine, {0, y, std::abs(y) * 0.12}, 1.4);
  }
  return tendons;
}

Strand on_side(Strand s, Side side) {
  if (side == Side::Right) {
    s.from.y = -s.from.y;
    s.to.y = -s.to.y;
  }
  return s;
}

double distance_to_box(const Aabb& box, const Vec3& p) {
  const Vec3 d{std::max({box.low.x - p.x, 0.0, p.x - box.high.x}),
               std::max({box.low.y - p.y, 0.0, p.y - box.high.y}),
               std::max({box.low.z - p.z, 0.0, p.z - box.high.z})};
  return length(d);
}

/// Smooth minimum -k ln sum exp(-v / k) over the parts that matter at p.
double skin_value(const BoneShapes& bones, const std::vector<Strand>& muscles, const Vec3& p) {
  double sum = 0;
  for (const Shape& shape : bones.shapes()) {
    if (distance_to_box(shape.bounds, p) - kCoverMm > kIgnoredBeyondMm) continue;
    sum += std::exp(-(bones.value(shape, p) - kCoverMm) / kBlendMm);
  }
  for (const Strand& muscle : muscles) sum += std::exp(-distance_to(muscle, p) / kBlendMm);
  return sum > 0 ? -kBlendMm * std::log(sum) : kIgnoredBeyondMm;
}

GridGeometry coarse_geometry(const BoneShapes& bones) {
  Aabb box;
  for (const Shape& shape : bones.shapes()) box.include(shape.bounds);
  box = box.grown(kMarginMm);
  const bool has_fingers = bones.shapes().back().phalanx >= 0;
  box.low.x = std::max(box.low.x, has_fingers ? kFingerEndMm : kDistalEndMm);
  box.high.x = std::min(box.high.x, kProximalEndMm);
  GridGeometry g;
  g.spacing = {kCoarseStepMm, kCoarseStepMm, kCoarseStepMm};
  g.origin = box.low;
  for (std::size_t i = 0; i < 3; ++i) {
    g.size[i] = static_cast<int>(box.extent()[i] / kCoarseStepMm) + 1;
  }
  return g;
}

}  // namespace

double distance_to(const Strand& s, const Vec3& p) noexcept {
  const Vec3 axis = s.to - s.from;
  const double t = std::clamp(dot(p - s.from, axis) / squared_length(axis), 0.0, 1.0);
  return distance(p, s.from + axis * t) - s.radius_mm;
}

SoftTissue::SoftTissue(const BoneShapes& bones, Side side, std::uint64_t seed)
    : depth_(coarse_geometry(bones)), tendons_(make_tendons()), seed_(seed) {
  std::vector<Strand> muscles(kMuscles.begin(), kMuscles.end());
  for (Strand& s : muscles) s = on_side(s, side);
  for (Strand& s : tendons_) s = on_side(s, side);
  const GridGeometry& g = depth_.geometry();
  parallel_for(g.voxel_count(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const VoxelIndex v = g.index_of(i);
      const Vec3 p = g.patient_from_voxel(
          {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
      depth_[i] = static_cast<float>(-skin_value(bones, muscles, p));
    }
  });
}

double SoftTissue::depth(const Vec3& p) const noexcept {
  return sample_at(depth_.view(), p, kAirDepth);
}

double SoftTissue::hounsfield(const Vec3& p, double depth_mm) const noexcept {
  if (depth_mm < kSkinThicknessMm) return kSkinHu;
  double tendon = 1e9;
  for (const Strand& t : tendons_) tendon = std::min(tendon, distance_to(t, p));
  const double patches = coherent_noise(p, 5.0, seed_) + 0.5 * coherent_noise(p, 2.1, seed_ + 1);
  const double fat_ends_at = 2.8 + 0.9 * coherent_noise(p, 9.0, seed_ + 2);
  const double subcutaneous = 1.0 - smooth_step(fat_ends_at - 0.3, fat_ends_at + 0.5, depth_mm);
  const double between = smooth_step(0.45, 0.75, patches);  // fat between muscles
  const double fat = std::max(subcutaneous, between);
  const double flesh = kMuscleHu + 9.0 * coherent_noise(p, 1.5, seed_ + 3);
  const double ground = flesh + (kFatHu - flesh) * fat;
  const double in_tendon = 1.0 - smooth_step(-0.3, 0.3, tendon);
  return ground + (kTendonHu - ground) * in_tendon;
}

}  // namespace carpus::phantom
