// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Voxels of each body; distances to them.
// 2. Closing: all within r of either body, less all within r of what is not.
// 3. Less whatever is solid, by its true distance; less what a neighbouring space is nearer to.
// 4. The surface, smoothed; what lines it.
#include "soft_tissue/detail/lay_spaces.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "geometry/voxels_inside.hpp"
#include "imaging/distance_transform.hpp"
#include "imaging/gaussian.hpp"

namespace carpus::soft_tissue::detail {
namespace {

constexpr double kPadMm = 2.0;     ///< beyond what is within reach of both bodies
constexpr double kBeyondMm = 1.0;  ///< a space reaches this much beyond the closing radius
constexpr double kApartMm = 0.25;  ///< each of two neighbouring spaces keeps this from the border
constexpr double kOnDiscMm = 3.5;  ///< what is so near the disc is parted by its sides
constexpr double kFromSolidMm = 0.04;
constexpr double kSmoothVoxels = 1.2;  ///< sigma of the wall between bones
constexpr double kSimplifyMm = 0.02;   ///< coarser, an opened joint stretches facets to spikes
constexpr double kLinedByMm = 0.3;     ///< nearer than this it is the lining
constexpr double kNearValueMm = 1.2;   ///< voxels farther from the wall keep rough values

/// Smooth over this where the wall runs out on a bone, so that no fringe is left [mm].
constexpr float kBlendMm = 1.2F;

/// The greater one, rounded where both are about equal.
float rounded_max(float a, float b) {
  const float h = std::max(kBlendMm - std::abs(a - b), 0.0F) / kBlendMm;
  return std::max(a, b) + h * h * kBlendMm * 0.25F;
}

using Bodies = TabledSpace::Body;

bool is_of(const Bodies& body, BoneId bone) {
  return std::find(body.bones.begin(), body.bones.end(), bone) != body.bones.end();
}

Aabb box_of(const Bodies& body, const SpaceInput& in) {
  Aabb box;
  for (const cases::Bone& bone : in.bones->data().bones) {
    if (is_of(body, bone.bone)) box.include(bounds_of(bone.surface.vertices));
  }
  return box;
}

class Carving {
 public:
  Carving(const TabledSpace& tabled, const SpaceInput& in)
      : tabled_(tabled), in_(in), reach_(in.table->closing_radius_mm * in.model->size()) {
    for (const LaidLigament& l : *in.ligaments) covers_.emplace_back(l.sheet);
    if (in.disc != nullptr) disc_.emplace_back(*in.disc);
  }

  Space carve() {
    Space space{tabled_.id, tabled_.name, {}, {}, 0};
    const Aabb a = box_of(tabled_.between[0], in_);
    const Aabb b = box_of(tabled_.between[1], in_);
    if (a.is_empty() || b.is_empty()) return space;
    const double margin = reach_ + kBeyondMm;
    Aabb box{
        {std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y), std::max(a.low.z, b.low.z)},
        {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y), std::min(a.high.z, b.high.z)}};
    box.low -= Vec3{margin, margin, margin};
    box.high += Vec3{margin, margin, margin};
    if (tabled_.near_disc_mm > 0 && !disc_.empty()) {
      const Aabb about = disc_.front().box().grown(tabled_.near_disc_mm * in_.model->size() + 1);
      box.low = {std::max(box.low.x, about.low.x), std::max(box.low.y, about.low.y),
                 std::max(box.low.z, about.low.z)};
      box.high = {std::min(box.high.x, about.high.x), std::min(box.high.y, about.high.y),
                  std::min(box.high.z, about.high.z)};
    }
    if (box.is_empty()) return space;
    // Voxels of one size in the patient's frame, whatever the wrist's pose in it.
    grid_ = grid_about(box.grown(reach_ + kPadMm), in_.table->voxel_mm * in_.model->size());
    inner_ = box;
    const Grid<float> values = values_of();
    space.surface = smooth_surface(values, {in_.bones, {}}, kSimplifyMm);
    space.volume_mm3 = space.surface.facets.empty() ? 0 : volume_of(space.surface);
    for (const Vec3& v : space.surface.vertices) space.lining.push_back(lining_at(v));
    return space;
  }

 private:
  /// Distance [mm] to the voxels of a body.
  Grid<float> distance_to(const Bodies& body) const {
    Grid<std::uint8_t> mask(grid_);
    const auto& bones = in_.bones->data().bones;
    for (const cases::Bone& bone : bones) {
      if (!is_of(body, bone.bone)) continue;
      const Grid<std::uint8_t> voxels = voxels_inside(bone.surface, grid_);
      for (std::size_t i = 0; i < mask.values().size(); ++i) mask[i] |= voxels[i];
    }
    const auto add = [&](const SheetDistance& sheet) {
      for_voxels_in(sheet.box(), [&](std::size_t i, const Vec3& p) {
        if (mask[i] == 0 && sheet.mm(p, 0.5) <= 0.1) mask[i] = 1;
      });
    };
    if (body.has_disc && !disc_.empty()) add(disc_.front());
    for (std::size_t l = 0; l < covers_.size(); ++l) {
      for (const std::string& begin : body.ligaments) {
        if ((*in_.ligaments)[l].ligament.id.starts_with(begin)) add(covers_[l]);
      }
    }
    return imaging::distance_to_value(mask.view(), 1);
  }

  template <typename Work>
  void for_voxels_in(const Aabb& box, const Work& work) const {
    std::array<int, 3> low{};
    std::array<int, 3> high{};
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::max(
          0, static_cast<int>(std::floor((box.low[a] - grid_.origin[a]) / grid_.spacing[a])));
      high[a] =
          std::min(grid_.size[a] - 1,
                   static_cast<int>(std::ceil((box.high[a] - grid_.origin[a]) / grid_.spacing[a])));
    }
    for (int z = low[2]; z <= high[2]; ++z) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int x = low[0]; x <= high[0]; ++x) {
          work(grid_.offset_of({x, y, z}),
               grid_.patient_from_voxel(
                   {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}));
        }
      }
    }
  }

  Grid<float> values_of() const {
    const Grid<float> to_a = distance_to(tabled_.between[0]);
    const Grid<float> to_b = distance_to(tabled_.between[1]);
    Grid<std::uint8_t> dilated(grid_);
    for (std::size_t i = 0; i < dilated.values().size(); ++i) {
      dilated[i] = std::min(to_a[i], to_b[i]) <= reach_ ? 1 : 0;
    }
    Grid<float> values = imaging::distance_to_background(dilated.view());
    for (float& v : values.values()) v = std::clamp(static_cast<float>(reach_) - v, -3.0F, 3.0F);
    values = imaging::gaussian_smooth(values.view(), kSmoothVoxels * grid_.spacing.x);
    std::vector<std::array<Grid<float>, 2>> nearer;
    for (const auto& [own, other] : tabled_.nearer) {
      nearer.push_back({distance_to(own), distance_to(other)});
    }
    if (tabled_.near_disc_mm > 0 && !disc_.empty()) {
      const auto end = static_cast<float>(tabled_.near_disc_mm * in_.model->size());
      const Grid<float> to_disc = distance_to({{}, true, {}});
      for (std::size_t i = 0; i < values.values().size(); ++i) {
        values[i] = rounded_max(values[i], to_disc[i] - end);
      }
    }
    const Grid<float> over_disc = over_disc_mm();
    const auto far = static_cast<float>(reach_ + kBeyondMm);
    parallel_for(values.values().size(), 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        float v = std::max({values[i], to_a[i] - far, to_b[i] - far});
        for (const auto& [own, other] : nearer) {
          float off = 0.5F * (own[i] - other[i]);
          if (tabled_.disc_side == DiscSide::Distal) off = std::min(off, over_disc[i]);
          if (tabled_.disc_side == DiscSide::Proximal) off = std::max(off, -over_disc[i]);
          v = rounded_max(v, off + static_cast<float>(kApartMm));
        }
        values[i] = v;
      }
    });
    const TabledRecess& recess = in_.table->recess;
    if (in_.model->has(recess.bone)) add_recess(recess, values);
    parallel_for(values.values().size(), 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (values[i] > kNearValueMm) continue;
        const VoxelIndex v = grid_.index_of(i);
        const Vec3 p = grid_.patient_from_voxel(
            {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
        values[i] = std::max(rounded_max(values[i], static_cast<float>(kFromSolidMm - solid_mm(p))),
                             static_cast<float>(outside_mm(p)));
      }
    });
    return values;
  }

  /// Negative on the disc's distal side and near it, whatever bone is nearer there.
  Grid<float> over_disc_mm() const {
    Grid<float> over(grid_, static_cast<float>(kOnDiscMm));
    if (!tabled_.disc_side || in_.disc == nullptr) return over;
    const TriangleMesh& sheet = in_.disc->middle;
    const fields::TriangleTree tree(sheet);
    const Vec3 distal = in_.model->way_of_wrist({-1, 0, 0});
    for_voxels_in(bounds_of(sheet.vertices).grown(kOnDiscMm), [&](std::size_t i, const Vec3& p) {
      const auto hit = tree.nearest(p, kOnDiscMm);
      if (!hit) return;
      Vec3 normal = facet_normal(sheet, hit->facet);
      if (dot(normal, distal) < 0) normal = -normal;
      const double above = dot(p - hit->point, normal);
      over[i] = static_cast<float>(std::max(-above, std::sqrt(hit->squared_distance) - kOnDiscMm));
    });
    return over;
  }

  /// How far a point is out of what is looked at.
  double outside_mm(const Vec3& p) const {
    double out = -1e9;
    for (std::size_t a = 0; a < 3; ++a) {
      out = std::max({out, inner_.low[a] - p[a], p[a] - inner_.high[a]});
    }
    return out;
  }

  /// To bone, ligament or disc; at most about a mm.
  double solid_mm(const Vec3& p) const {
    double mm = in_.bones->near(p).distance_mm;
    for (const SheetDistance& s : covers_) mm = std::min(mm, s.mm(p, 1.0));
    for (const SheetDistance& s : disc_) mm = std::min(mm, s.mm(p, 1.0));
    return mm;
  }

  void add_recess(const TabledRecess& recess, Grid<float>& values) const {
    const Vec3 a = in_.model->point(recess.bone, recess.from);
    const Vec3 b = in_.model->point(recess.bone, recess.to);
    const double radius = recess.radius_mm * in_.model->size();
    const bool is_own = recess.space == tabled_.id;
    Aabb box;
    box.include(a);
    box.include(b);
    for_voxels_in(box.grown(radius + 1), [&](std::size_t i, const Vec3& p) {
      const double t = std::clamp(dot(p - a, b - a) / squared_length(b - a), 0.0, 1.0);
      const auto mm = static_cast<float>(distance(p, a + (b - a) * t) - radius);
      values[i] = is_own ? std::min(values[i], mm)
                         : std::max(values[i], static_cast<float>(2 * kApartMm) - mm);
    });
  }

  Lining lining_at(const Vec3& p) const {
    const auto& bones = in_.bones->data().bones;
    double nearest = kLinedByMm;
    Lining lining = Lining::Synovium;
    for (std::size_t i = 0; i < bones.size(); ++i) {
      if (in_.bones->exact_mm(i, p, nearest) >= nearest) continue;
      const auto hit = in_.bones->tree(i).nearest(p);
      nearest = std::sqrt(hit->squared_distance);
      lining = Lining::Bone;
      for (const Cartilage& c : *in_.cartilage) {
        if (c.label != bones[i].label) continue;
        for (const std::uint32_t v : bones[i].surface.facets[hit->facet]) {
          if (c.vertex_thickness_mm[v] > 0) lining = Lining::Cartilage;
        }
      }
    }
    for (const SheetDistance& s : disc_) {
      if (s.mm(p, nearest) < nearest) lining = Lining::Disc;
    }
    if (lining == Lining::Synovium || lining == Lining::Bone) {
      for (const SheetDistance& s : covers_) {
        if (s.mm(p, nearest) < nearest) lining = Lining::Ligament;
      }
    }
    return lining;
  }

  const TabledSpace& tabled_;
  const SpaceInput& in_;
  double reach_ = 0;
  std::vector<SheetDistance> covers_;
  std::vector<SheetDistance> disc_;
  GridGeometry grid_;
  Aabb inner_;
};

}  // namespace

Space lay_space(const TabledSpace& tabled, const SpaceInput& input) {
  return Carving(tabled, input).carve();
}

}  // namespace carpus::soft_tissue::detail
