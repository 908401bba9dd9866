// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Outline: the coarse skin field says how large the field of view must be.
// 2. For every voxel: signed distance to the nearest and the second nearest bone, each bone only
//    within its own box; label; HU with an edge as wide as a voxel (no supersampling needed).
// 3. Point spread: a Gaussian. 4. Noise: white, smoothed to the scanner's grain, stronger in dense
//    tissue, plus slow shading.
#include "phantom/phantom.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "core/units.hpp"
#include "imaging/gaussian.hpp"
#include "phantom/bone_shapes.hpp"
#include "phantom/coherent_noise.hpp"
#include "phantom/scanner_effects.hpp"
#include "phantom/soft_tissue.hpp"
#include "phantom/tissue.hpp"

namespace carpus::phantom {
namespace {

/// The hand is extended by about 28 degrees in the model's frame; the scanner's table lies midway.
constexpr double kBetweenForearmAndHandDegrees = 14.0;
constexpr double kAirAroundMm = 4.0;
/// Around the bones where they fill the field; what reconstruction keeps of it, too.
constexpr double kFleshAroundMm = 4.0;
/// Spacing of voxels that scanners have.
constexpr double kFinestMm = 0.15;
constexpr double kCoarsestMm = 2.0;
/// Where the bones fill the field it is smaller than a scanner's, and so are its voxels.
constexpr double kFinestFilledMm = 0.1;
/// Between skin and splint, of so much HU.
constexpr double kPaddingMm = 3.0;
constexpr double kPaddingHu = -850;
/// A table's sandwich: carbon of 200 HU, 1 mm thick, at both sides of 12 mm of foam.
constexpr double kTableSkinMm = 1.0;
constexpr double kTableFoamMm = 12.0;
constexpr double kTableSkinHu = 200;
constexpr double kTableFoamHu = -930;
/// The two halves of a bipartite bone lie so across its longest side [rad].
constexpr double kBipartiteTilt = 0.3;
/// Which bones were seen in two halves.
constexpr std::array<BoneId, 5> kBipartiteBones{BoneId::Scaphoid, BoneId::Lunate, BoneId::Trapezium,
                                                BoneId::Trapezoid, BoneId::Hamate};
/// A lunate's corner keeps so far from its neighbours [mm].
constexpr double kFacetJointMm = 1.3;
constexpr double kFacetBlendMm = 1.0;
/// Fused bones: within a joint this wide there is bone of this density.
constexpr double kFusionMm = 3.4;
constexpr double kFusionHu = 450;
constexpr double kNoiseSigmaMm = 0.2;
constexpr double kNoisePerHu = 1.0 / 2500.0;  // relative growth of the noise with HU above 0
constexpr double kShadingHu = 5.0;
constexpr double kAirHu = -1000.0;
constexpr double kCartilageHu = 80.0;
/// Two bones' distances add up to less than this within a joint [mm].
constexpr double kJointSpaceMm = 2.6;
constexpr double kCapsuleMm = 0.7;
/// Bones are looked for this far from a voxel: beyond, neither edge nor joint reaches it [mm].
constexpr double kReachMm = 2.0;
/// Half the width of a bone's edge before blur [mm].
constexpr double kEdgeMm = 0.1;

/// A smooth displacement of all of space: other shapes, the same joints.
Vec3 other_anatomy(const Vec3& p, const PhantomOptions& o) {
  Vec3 shift;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    shift[axis] = o.scan.warp_mm * (0.75 * coherent_noise(p, 16, o.seed * 31 + axis) +
                                    0.35 * coherent_noise(p, 9, o.seed * 37 + axis + 3));
  }
  return p + shift;
}

/// A point as one bone's shape is asked for it: the bone lies elsewhere and has another size.
struct BonePlace {
  Vec3 centre{};
  double size = 1;
  Vec3 shift{};
  Mat3 rotation = Mat3::identity();

  bool is_elsewhere = false;

  [[nodiscard]] Vec3 model_point(const Vec3& p) const {
    if (!is_elsewhere) return p;
    return centre + (rotation.transposed() * (p - shift - centre)) / size;
  }
};

/// Of the shapes, in their order.
std::vector<BonePlace> bone_places(const BoneShapes& bones,
                                   const anatomy::WristModel& model,
                                   const PhantomOptions& o) {
  constexpr double kDisiDegreesPerMm = 6;
  std::vector<BonePlace> places;
  Rng rng(o.seed ^ 0xB0EULL);
  for (const Shape& shape : bones.shapes()) {
    BonePlace place;
    place.centre = model.bone(shape.bone).bounds.centre();
    const double smaller = o.scan.size_variation * rng.uniform();
    // Long bones keep their size, for their shafts go on; parts of one bone keep to each other.
    if (!model.bone(shape.bone).cut_plane && shape.part == BonePart::Whole) place.size -= smaller;
    if (shape.bone == BoneId::Lunate && o.scan.scapholunate_gap_mm > 0) {
      const Vec3 away =
          normalized_or(place.centre - model.bone(BoneId::Scaphoid).bounds.centre(), {0, 1, 0});
      place.shift = away * (0.5 * o.scan.scapholunate_gap_mm);
      place.size -= 0.03 * o.scan.scapholunate_gap_mm;
      place.rotation = rotation_about(
          {0, 1, 0}, radians_from_degrees(-kDisiDegreesPerMm * o.scan.scapholunate_gap_mm));
    }
    place.is_elsewhere = place.size != 1 || squared_length(place.shift) > 0;
    places.push_back(place);
  }
  return places;
}

/// What makes one bone of this person another one.
struct Variant {
  std::optional<BoneId> bipartite;
  Plane split;  ///< of it
  double split_mm = 0;
  Vec3 facet{};  ///< where the lunate's corner reaches to the hamate
  double facet_mm = 0;
};

struct Scene {
  const BoneShapes& bones;
  const BoneTissue& tissue;
  const SoftTissue& soft;
  Pose<frame::Wrist, frame::Patient> wrist_from_patient;
  double scale;
  const PhantomOptions& options;
  std::vector<BonePlace> places;  ///< of the bones, in the order of their shapes
  Variant variant;

  /// As BoneShapes::value or signed_distance gave it, of a bone that may be another one.
  [[nodiscard]] double varied(const Shape& shape, const Vec3& q, double value) const {
    if (shape.bone == variant.bipartite && shape.phalanx < 0) {
      value = std::max(value, 0.5 * variant.split_mm - std::abs(variant.split.signed_distance(q)));
    }
    if (shape.bone != BoneId::Lunate || !(variant.facet_mm > 0)) return value;
    double corner = distance(q, variant.facet) - variant.facet_mm;
    if (corner > 2 * kReachMm) return value;
    for (const BoneId other : {BoneId::Hamate, BoneId::Triquetrum, BoneId::Capitate}) {
      const Shape& neighbour = bones.shapes()[static_cast<std::size_t>(other) - 1];
      corner = std::max(corner, kFacetJointMm - bones.value(neighbour, q));
    }
    const double blend = std::clamp(0.5 + 0.5 * (value - corner) / kFacetBlendMm, 0.0, 1.0);
    // A smooth minimum.
    return value + (corner - value) * blend - kFacetBlendMm * blend * (1 - blend);
  }

  [[nodiscard]] Vec3 model_point(const Vec3& patient) const {
    const Vec3 p = (wrist_from_patient * Point<frame::Patient>{patient}).v / scale;
    return options.scan.warp_mm > 0 ? other_anatomy(p, options) : p;
  }
};

void check(const PhantomOptions& o) {
  if (!(o.scale >= 0.7 && o.scale <= 1.4)) {
    throw InvalidInput("phantom: scale " + std::to_string(o.scale) +
                       " is not between 0.7 and 1.4; wrists of adults are within 0.85 to 1.15");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(o.spacing[i] >= kFinestMm && o.spacing[i] <= kCoarsestMm)) {
      throw InvalidInput("phantom: spacing " + std::to_string(o.spacing[i]) +
                         " mm is not between 0.15 and 2 mm");
    }
  }
}

/// Where the lunate's surface is next to the hamate.
Vec3 corner_of_lunate(const BoneShapes& bones, const anatomy::WristModel& model) {
  constexpr double kStepMm = 0.2;
  const Vec3 from = model.bone(BoneId::Lunate).bounds.centre();
  const Vec3 towards = normalized_or(model.bone(BoneId::Hamate).bounds.centre() - from, {-1, 0, 0});
  const Shape& lunate = bones.shapes()[static_cast<std::size_t>(BoneId::Lunate) - 1];
  Vec3 p = from;
  for (int k = 0; k < 100 && bones.value(lunate, p) < 0; ++k) p = p + towards * kStepMm;
  return p;
}

Variant make_variant(const BoneShapes& bones,
                     const anatomy::WristModel& model,
                     const PhantomOptions& o) {
  Variant variant;
  Rng rng(o.seed ^ 0xB1BULL);
  if (o.scan.bipartite_mm > 0) {
    BoneId bone = kBipartiteBones[rng.below(kBipartiteBones.size())];
    // What is broken is two already.
    if (o.fracture != FractureKind::None && bone == BoneId::Scaphoid) bone = BoneId::Lunate;
    variant.bipartite = bone;
    const Aabb& box = model.bone(bone).bounds;
    const Vec3 extent = box.extent();
    Vec3 along{1, 0, 0};
    if (extent.y > extent.x && extent.y > extent.z) along = {0, 1, 0};
    if (extent.z > extent.x && extent.z > extent.y) along = {0, 0, 1};
    const Vec3 tilt{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    const Vec3 normal = normalized_or(along + tilt * kBipartiteTilt, along);
    variant.split = {normal, dot(normal, box.centre())};
    variant.split_mm = o.scan.bipartite_mm;
  }
  if (o.scan.hamate_facet_mm > 0) {
    variant.facet = corner_of_lunate(bones, model);
    variant.facet_mm = o.scan.hamate_facet_mm;
  }
  return variant;
}

/// Scanner: x towards the wrist's +y, y dorsal, z distal, a little tilted.
Pose<frame::Wrist, frame::Patient> pose_in_scanner(std::uint64_t seed, double tilt_degrees) {
  Rng rng(seed ^ 0x7117ULL);
  const Mat3 straight = Mat3::from_columns({0, 0, -1}, {1, 0, 0}, {0, -1, 0});
  Mat3 patient_from_wrist =
      rotation_about({1, 0, 0}, radians_from_degrees(kBetweenForearmAndHandDegrees)) * straight;
  for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const double angle = radians_from_degrees(tilt_degrees * rng.uniform(-1, 1));
    patient_from_wrist = rotation_about(axis, angle) * patient_from_wrist;
  }
  const Vec3 shift{rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-3, 3)};
  return Pose<frame::Patient, frame::Wrist>{patient_from_wrist, shift}.inverse();
}

/// Box of the hand within the table's reach, from the coarse skin field.
Aabb hand_box(const Scene& scene) {
  const auto patient_from_wrist = scene.wrist_from_patient.inverse();
  const GridGeometry& g = scene.soft.coarse_depth().geometry();
  const Vec3 origin = patient_from_wrist.translation;
  Aabb box;
  for (std::size_t i = 0; i < g.voxel_count(); ++i) {
    if (!(scene.soft.coarse_depth()[i] > 0)) continue;
    const VoxelIndex v = g.index_of(i);
    const Vec3 model = g.patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    const Vec3 p = (patient_from_wrist * Point<frame::Wrist>{model * scene.scale}).v;
    if (p.z - origin.z > -scene.options.scan.proximal_reach_mm * scene.scale &&
        p.z - origin.z < scene.options.scan.distal_reach_mm * scene.scale) {
      box.include(p);
    }
  }
  box = box.grown(kAirAroundMm + scene.options.scan.cast_mm +
                  (scene.options.scan.cast_mm > 0 ? kPaddingMm : 0.0));
  box.low.z = origin.z - scene.options.scan.proximal_reach_mm * scene.scale;
  box.high.z = origin.z + scene.options.scan.distal_reach_mm * scene.scale;
  return box;
}

/// What `box` has of the bones and what lies next to them.
Aabb within_reach_of_bones(const Scene& scene, const Aabb& box) {
  constexpr double kStepMm = 1.0;
  const auto patient_from_wrist = scene.wrist_from_patient.inverse();
  Aabb bones;
  for (const Shape& shape : scene.bones.shapes()) {
    const Aabb& own = shape.bounds;
    for (double x = own.low.x; x <= own.high.x; x += kStepMm) {
      for (double y = own.low.y; y <= own.high.y; y += kStepMm) {
        for (double z = own.low.z; z <= own.high.z; z += kStepMm) {
          const Vec3 q{x, y, z};
          const Vec3 p = (patient_from_wrist * Point<frame::Wrist>{q * scene.scale}).v;
          if (box.contains(p) && scene.bones.value(shape, q) < 0) bones.include(p);
        }
      }
    }
  }
  bones = bones.grown(kFleshAroundMm);
  for (std::size_t i = 0; i < 3; ++i) {
    bones.low[i] = std::max(bones.low[i], box.low[i]);
    bones.high[i] = std::min(bones.high[i], box.high[i]);
  }
  return bones;
}

/// The box in so many voxels.
GridGeometry divided(const Aabb& box, const std::array<int, 3>& voxels) {
  GridGeometry g;
  g.size = voxels;
  g.origin = box.low;
  for (std::size_t i = 0; i < 3; ++i) {
    g.spacing[i] = box.extent()[i] / voxels[i];
    if (g.spacing[i] >= kFinestFilledMm && g.spacing[i] <= kCoarsestMm) continue;
    throw InvalidInput("phantom: " + std::to_string(voxels[i]) + " voxels along axis " +
                       std::to_string(i) + " of the bones would be " +
                       std::to_string(g.spacing[i]) +
                       " mm, not between 0.1 and 2 mm; give another number or another scale");
  }
  return g;
}

GridGeometry field_of_view(const Scene& scene, const PhantomOptions& options) {
  Aabb box = hand_box(scene);
  const double widest = options.scan.width_mm * scene.scale;
  if (box.extent().x > widest) {  // cut the thumb, which points away from the wrist's middle
    const bool is_thumb_low = options.side == Side::Left;
    (is_thumb_low ? box.low.x : box.high.x) =
        is_thumb_low ? box.high.x - widest : box.low.x + widest;
  }
  if (options.scan.cut_off_mm > 0) {
    const double by = (kAirAroundMm + options.scan.cut_off_mm) * scene.scale;
    const bool is_low = Rng(options.seed ^ 0xC07ULL).uniform() < 0.5;
    (is_low ? box.low.x : box.high.x) += is_low ? by : -by;
  }
  if (options.filled_voxels) {
    return divided(within_reach_of_bones(scene, box), *options.filled_voxels);
  }
  GridGeometry g;
  g.spacing = options.spacing;
  g.origin = box.low;
  for (std::size_t i = 0; i < 3; ++i) {
    g.size[i] = static_cast<int>(box.extent()[i] / g.spacing[i]) + 1;
  }
  return g;
}

/// Nearest two bones of each voxel of one slice.
struct SliceBones {
  explicit SliceBones(std::size_t count)
      : nearest(count), second(count), first_mm(count), second_mm(count) {}
  void clear() {
    std::fill(nearest.begin(), nearest.end(), -1);
    std::fill(second.begin(), second.end(), -1);
    std::fill(first_mm.begin(), first_mm.end(), 1e3F);
    std::fill(second_mm.begin(), second_mm.end(), 1e3F);
  }
  std::vector<int> nearest;  ///< index into shapes, -1 where none is within reach
  std::vector<int> second;
  std::vector<float> first_mm;
  std::vector<float> second_mm;
};

void find_bones(const Scene& scene, const GridGeometry& g, int z, SliceBones& out) {
  out.clear();
  const double reach = kReachMm / scene.scale + 0.5;
  const auto& shapes = scene.bones.shapes();
  std::vector<Aabb> boxes;
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    boxes.push_back(
        shapes[s].bounds.grown(reach + 3 * length(scene.places[s].shift) + scene.variant.facet_mm));
  }
  std::size_t i = 0;
  for (int y = 0; y < g.size[1]; ++y) {
    for (int x = 0; x < g.size[0]; ++x, ++i) {
      const Vec3 p = scene.model_point(g.patient_from_voxel(
          {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}));
      for (std::size_t s = 0; s < shapes.size(); ++s) {
        if (!boxes[s].contains(p)) continue;
        const Vec3 q = scene.places[s].model_point(p);
        const double f = scene.varied(shapes[s], q, scene.bones.value(shapes[s], q));
        if (f > reach) continue;
        const auto d = static_cast<float>(
            scene.varied(shapes[s], q, scene.bones.signed_distance(shapes[s], q)) * scene.scale);
        if (d < out.first_mm[i]) {
          out.second_mm[i] = out.first_mm[i];
          out.second[i] = out.nearest[i];
          out.first_mm[i] = d;
          out.nearest[i] = static_cast<int>(s);
        } else {
          if (d < out.second_mm[i]) out.second[i] = static_cast<int>(s);
          out.second_mm[i] = std::min(out.second_mm[i], d);
        }
      }
    }
  }
}

/// HU outside bone.
double surroundings(const Scene& scene, const Vec3& p, double first_mm, double second_mm) {
  const double depth_mm = scene.soft.depth(p) * scene.scale;
  if (depth_mm <= 0 && first_mm > kReachMm) {
    const double out = -depth_mm - kPaddingMm;
    if (!(scene.options.scan.cast_mm > 0) || out > scene.options.scan.cast_mm) return kAirHu;
    return out < 0 ? kPaddingHu : scene.options.scan.cast_hu;
  }
  if (scene.bones.is_gap_tissue(p)) return scene.tissue.gap_hounsfield(p);
  const double soft = scene.soft.hounsfield(p, std::max(depth_mm, 0.0));
  const double joint =
      std::max(1.0 - smooth_step(kJointSpaceMm - 0.6, kJointSpaceMm, first_mm + second_mm),
               1.0 - smooth_step(kCapsuleMm - 0.3, kCapsuleMm, first_mm));
  return soft + (kCartilageHu - soft) * joint;
}

bool is_fusion(const Scene& scene, const SliceBones& near, std::size_t i) {
  if (!scene.options.scan.is_fused || near.nearest[i] < 0 || near.second[i] < 0) return false;
  const auto is_one = [&](int shape) {
    const BoneId bone = scene.bones.shapes()[static_cast<std::size_t>(shape)].bone;
    return bone == BoneId::Lunate || bone == BoneId::Triquetrum;
  };
  return is_one(near.nearest[i]) && is_one(near.second[i]) &&
         static_cast<double>(near.first_mm[i] + near.second_mm[i]) < kFusionMm;
}

void paint_slice(const Scene& scene,
                 const GridGeometry& g,
                 int z,
                 const SliceBones& near,
                 Grid<float>& hu,
                 Grid<std::uint8_t>& labels) {
  const auto& shapes = scene.bones.shapes();
  std::size_t i = 0;
  for (int y = 0; y < g.size[1]; ++y) {
    for (int x = 0; x < g.size[0]; ++x, ++i) {
      const Vec3 p = scene.model_point(g.patient_from_voxel(
          {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}));
      const std::size_t at = g.offset_of({x, y, z});
      const double first = near.first_mm[i];
      const double in_bone = std::clamp(0.5 - 0.5 * first / kEdgeMm, 0.0, 1.0);
      double value = 0;
      if (in_bone < 1) {
        const double between = is_fusion(scene, near, i)
                                   ? kFusionHu
                                   : surroundings(scene, p, first, near.second_mm[i]);
        value = between * (1 - in_bone);
      }
      if (in_bone > 0) {
        const auto nearest = static_cast<std::size_t>(near.nearest[i]);
        const double depth_mm = std::max(0.0, -first) / scene.options.scan.cortex_thickness;
        value += in_bone * scene.options.scan.bone_density *
                 scene.tissue.hounsfield(shapes[nearest], scene.places[nearest].model_point(p),
                                         depth_mm);
      }
      hu[at] = static_cast<float>(value);
      if (first < 0) {
        labels[at] = shapes[static_cast<std::size_t>(near.nearest[i])].label;
      } else if (scene.bones.is_gap_tissue(p)) {
        labels[at] = kFractureGapLabel;
      }
    }
  }
}

/// Noise of unit deviation with the scanner's grain; each slice has its own generator, so that
/// threads do not matter.
Grid<float> scanner_noise(const GridGeometry& g, std::uint64_t seed) {
  Grid<float> white(g);
  const std::size_t slice = g.voxel_count() / static_cast<std::size_t>(g.size[2]);
  parallel_for(static_cast<std::size_t>(g.size[2]), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t z = begin; z < end; ++z) {
      Rng rng(seed ^ (0xC0FFEEULL + z * 0x9E3779B97F4A7C15ULL));
      for (std::size_t i = z * slice; i < (z + 1) * slice; ++i) {
        white[i] = static_cast<float>(rng.normal());
      }
    }
  });
  Grid<float> noise = imaging::gaussian_smooth(white.view(), kNoiseSigmaMm);
  double sum = 0;
  for (const float v : noise.values()) sum += static_cast<double>(v) * static_cast<double>(v);
  const double deviation = std::sqrt(sum / static_cast<double>(g.voxel_count()));
  for (float& v : noise.values()) v = static_cast<float>(v / deviation);
  return noise;
}

Grid<std::int16_t> scanned(const Grid<float>& hu, std::uint64_t seed, double noise_hu) {
  const Grid<float>& sharp = hu;
  const GridGeometry& g = hu.geometry();
  const Grid<float> noise = scanner_noise(g, seed);
  Grid<std::int16_t> ct(g);
  Rng rng(seed ^ 0x5AADEULL);
  const double phase = rng.uniform(0, 2 * kPi);
  parallel_for(g.voxel_count(), 1U << 16U, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const VoxelIndex v = g.index_of(i);
      const double shading = kShadingHu * std::sin(phase + 4.0 * v.x / g.size[0]) *
                             std::cos(phase + 3.0 * v.y / g.size[1]);
      const double clean = sharp[i];
      const double grain = noise_hu * (1 + kNoisePerHu * std::max(0.0, clean));
      const double value = clean + shading + grain * noise[i];
      ct[i] = static_cast<std::int16_t>(std::lround(std::clamp(value, -1024.0, 3071.0)));
    }
  });
  return ct;
}

/// A table under the arm: below all that is not air, in the scanner's y.
void add_table(Grid<float>& hu) {
  const GridGeometry& g = hu.geometry();
  const int rows = std::max(1, static_cast<int>((2 * kTableSkinMm + kTableFoamMm) / g.spacing.y));
  // The lowest rows that the field of view still shows: often its upper layer only.
  for (int y = 0; y < std::min(rows, g.size[1]); ++y) {
    const double from_top = (std::min(rows, g.size[1]) - 1 - y) * g.spacing.y;
    const bool is_skin = from_top < kTableSkinMm || from_top > kTableSkinMm + kTableFoamMm;
    for (int z = 0; z < g.size[2]; ++z) {
      for (int x = 0; x < g.size[0]; ++x) {
        float& value = hu[VoxelIndex{x, y, z}];
        if (static_cast<double>(value) > -950) continue;
        value = static_cast<float>(is_skin ? kTableSkinHu : kTableFoamHu);
      }
    }
  }
}

/// A wire along the scaphoid's long axis, as it is left from a fixation before.
Wire wire_of(const Scene& scene, const LongAxis& axis) {
  const auto patient_from_wrist = scene.wrist_from_patient.inverse();
  const auto at = [&](double t) {
    const Vec3 p = (axis.centroid + axis.direction * t) * scene.scale;
    return (patient_from_wrist * Point<frame::Wrist>{p}).v;
  };
  const double beyond = scene.options.scan.is_screw ? -2 : 6;
  return {at(axis.least + 2), at(axis.greatest + beyond), scene.options.scan.metal_radius_mm};
}

/// Metal, hardening, motion, kernel, thick slices: in the order in which they come about.
void add_what_the_scanner_does(const Scene& scene,
                               const LongAxis& scaphoid,
                               Grid<float>& hu,
                               Grid<std::uint8_t>& labels) {
  const ScanOptions& o = scene.options.scan;
  const std::uint64_t seed = scene.options.seed;
  if (o.has_table) add_table(hu);
  harden_beam(o.beam_hardening_hu, hu);
  if (o.metal_radius_mm > 0) add_wire(wire_of(scene, scaphoid), o.metal_streaks_hu, seed, hu);
  if (o.motion_step_mm > 0) {
    Rng rng(seed ^ 0x307ULL);
    const int slice = static_cast<int>(hu.geometry().size[2] * rng.uniform(0.3, 0.7));
    const int step = static_cast<int>(std::lround(o.motion_step_mm / hu.geometry().spacing.x));
    step_aside(slice, step, static_cast<float>(kAirHu), hu);
    step_aside(slice, step, std::uint8_t{0}, labels);
  }
  hu = blurred_by_kernel(hu, o);
  const int count = static_cast<int>(std::lround(o.slice_mm / hu.geometry().spacing.z));
  if (count > 1) {
    hu = merged_slices(hu, count);
    labels = merged_slices(labels, count);
  }
}

}  // namespace

Phantom make_phantom(const PhantomOptions& options, const Progress& progress) {
  check(options);
  Phantom phantom;
  phantom.options = options;
  const auto& model = anatomy::WristModel::generic(options.side);
  phantom.scaphoid_axis = scaphoid_axis(model);
  if (options.fracture != FractureKind::None) {
    phantom.fracture = make_fracture(model, options.fracture, options.seed);
  }
  phantom.wrist_from_patient = pose_in_scanner(options.seed, options.scan.tilt_degrees);
  progress("outline", 0.0);
  const BoneShapes bones(model, phantom.fracture, options.scan.has_fingers);
  const BoneTissue tissue(bones, phantom.scaphoid_axis, options.seed * 11 + 1);
  const SoftTissue soft(bones, options.side, options.seed * 13 + 2);
  const Scene scene{bones,
                    tissue,
                    soft,
                    phantom.wrist_from_patient,
                    options.scale,
                    options,
                    bone_places(bones, model, options),
                    make_variant(bones, model, options)};

  const GridGeometry g = field_of_view(scene, options);
  Grid<float> hu(g);
  phantom.labels = Grid<std::uint8_t>(g);
  const auto slice = static_cast<std::size_t>(g.size[0]) * static_cast<std::size_t>(g.size[1]);
  constexpr int kSlicesPerReport = 16;
  for (int first = 0; first < g.size[2]; first += kSlicesPerReport) {
    progress("bones and soft tissue", 0.05 + 0.75 * first / g.size[2]);
    const int count = std::min(kSlicesPerReport, g.size[2] - first);
    parallel_for(static_cast<std::size_t>(count), 1, [&](std::size_t begin, std::size_t end) {
      SliceBones near(slice);
      for (std::size_t k = begin; k < end; ++k) {
        const int z = first + static_cast<int>(k);
        find_bones(scene, g, z, near);
        paint_slice(scene, g, z, near, hu, phantom.labels);
      }
    });
  }
  progress("scanner", 0.8);
  add_what_the_scanner_does(scene, phantom.scaphoid_axis, hu, phantom.labels);
  phantom.ct = scanned(hu, options.seed, options.scan.noise_hu);
  progress("done", 1.0);
  return phantom;
}

}  // namespace carpus::phantom
