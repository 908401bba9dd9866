// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "phantom/bone_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "phantom/coherent_noise.hpp"

namespace carpus::phantom {
namespace {

/// The section that is swept lies this far inside the model's cut [mm].
constexpr double kSectionInsideCutMm = 0.5;
/// Shafts go on this far beyond the cut [mm]: farther than any field of view here.
constexpr double kShaftLengthMm = 60.0;
constexpr double kSectionStepMm = 0.4;
/// What lies beside the shaft near its end is a sliver left by the cut, not bone: allowed reach
/// beyond the section's radius [mm], growing by this slope towards the joint, where bones flare.
constexpr double kSliverMarginMm = 0.4;
constexpr double kFlareSlope = 0.8;
/// Distances are corrected by the gradient within this band [mm].
constexpr double kBandMm = 2.5;
constexpr double kGradientStepMm = 0.05;
/// The displaced distal fragment keeps this far from its neighbours [mm]: worn, not interlocked.
constexpr double kClearanceMm = 0.6;
constexpr std::array<BoneId, 4> kScaphoidNeighbours{BoneId::Trapezium, BoneId::Trapezoid,
                                                    BoneId::Capitate, BoneId::Radius};

/// Fingers, invented: a metacarpal's shaft past its section, then its phalanges [mm].
struct Finger {
  BoneId metacarpal;
  double shaft_mm;
  std::array<double, 3> phalanges_mm;  ///< 0: there is none
};
constexpr std::array<Finger, 5> kFingers{
    Finger{BoneId::Metacarpal1, 24, {30, 22, 0}}, Finger{BoneId::Metacarpal2, 40, {40, 23, 17}},
    Finger{BoneId::Metacarpal3, 39, {44, 28, 18}}, Finger{BoneId::Metacarpal4, 34, {41, 26, 18}},
    Finger{BoneId::Metacarpal5, 31, {32, 18, 16}}};
constexpr double kFingerJointMm = 1.6;
/// Heads, knobs and rods against the metacarpal's section.
constexpr double kHeadPart = 1.15;
constexpr double kKnobPart = 0.95;
constexpr double kRodPart = 0.7;
constexpr double kThinner = 0.85;  ///< from phalanx to phalanx

constexpr std::size_t slot_of(BoneId bone) { return static_cast<std::size_t>(bone) - 1; }

/// The largest connected patch of a bone's section, sampled on a square grid about the origin of
/// the plane; returns its points.
std::vector<Vec3> main_section(const anatomy::WristModel& model, BoneId bone, const Plane& plane) {
  const Aabb& box = model.bone(bone).bounds;
  const Vec3 u = any_perpendicular(plane.normal);
  const Vec3 v = cross(plane.normal, u);
  const Vec3 middle = box.centre() - plane.normal * plane.signed_distance(box.centre());
  const int half = static_cast<int>(length(box.extent()) / kSectionStepMm / 2) + 1;
  const int n = 2 * half + 1;
  const auto point = [&](int i, int j) {
    return middle + u * ((i - half) * kSectionStepMm) + v * ((j - half) * kSectionStepMm);
  };
  std::vector<char> state(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), 0);
  const auto at = [&](int i, int j) -> char& {
    return state[static_cast<std::size_t>(j) * static_cast<std::size_t>(n) +
                 static_cast<std::size_t>(i)];
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) at(i, j) = model.uncut_value(bone, point(i, j)) < 0 ? 1 : 0;
  std::vector<Vec3> best;
  for (int j0 = 0; j0 < n; ++j0) {
    for (int i0 = 0; i0 < n; ++i0) {
      std::vector<Vec3> patch;
      std::vector<std::array<int, 2>> stack{{i0, j0}};
      while (!stack.empty()) {
        const auto [i, j] = stack.back();
        stack.pop_back();
        if (i < 0 || j < 0 || i >= n || j >= n || at(i, j) != 1) continue;
        at(i, j) = 2;
        patch.push_back(point(i, j));
        for (const auto& [di, dj] :
             std::array<std::array<int, 2>, 4>{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}})
          stack.push_back({i + di, j + dj});
      }
      if (patch.size() > best.size()) best = std::move(patch);
    }
  }
  return best;
}

Shaft shaft_of(const anatomy::WristModel& model, const anatomy::ModelBone& bone) {
  Shaft shaft;
  shaft.section = {bone.cut_plane->normal, bone.cut_plane->offset - kSectionInsideCutMm};
  shaft.axis = bone.shaft_axis;
  const std::vector<Vec3> section = main_section(model, bone.bone, shaft.section);
  for (const Vec3& p : section) shaft.centre += p / static_cast<double>(section.size());
  for (const Vec3& p : section) {
    const Vec3 d = p - shaft.centre;
    shaft.radius_mm = std::max(shaft.radius_mm, length(d - shaft.axis * dot(d, shaft.axis)));
  }
  // The distal radius and ulna are still flared where the model ends; metacarpals hardly.
  shaft.narrowing = bone.bone == BoneId::Radius ? 0.62 : (bone.bone == BoneId::Ulna ? 0.75 : 0.9);
  shaft.narrows_over_mm = belongs_to_forearm(bone.bone) ? 32.0 : 14.0;
  shaft.length_mm = kShaftLengthMm;
  return shaft;
}

Aabb with_shaft(Aabb box, const Shaft& shaft) {
  const double r = shaft.radius_mm + 1.0;
  Aabb section;
  section.include(shaft.centre);
  Aabb end;
  end.include(shaft.centre + shaft.axis * shaft.length_mm);
  box.include(section.grown(r));
  box.include(end.grown(r + shaft.head_mm));
  return box;
}

Shape shape_of(const anatomy::ModelBone& bone) {
  return {bone.bone, BonePart::Whole, static_cast<std::uint8_t>(bone.bone), bone.bounds};
}

}  // namespace

BoneShapes::BoneShapes(const anatomy::WristModel& model,
                       const std::optional<Fracture>& fracture,
                       bool has_fingers)
    : model_(&model), fracture_(fracture) {
  for (const anatomy::ModelBone& bone : model.bones()) {
    Shape shape = shape_of(bone);
    if (bone.cut_plane) {
      shafts_[slot_of(bone.bone)] = shaft_of(model, bone);
      if (has_fingers && !belongs_to_forearm(bone.bone)) add_finger(bone);
      shape.bounds = with_shaft(bone.bounds, shafts_[slot_of(bone.bone)]);
    }
    if (bone.bone == BoneId::Scaphoid && is_apart()) shape.part = BonePart::Proximal;
    shapes_.push_back(shape);
  }
  if (is_apart()) {
    Shape distal = shape_of(model.bone(BoneId::Scaphoid));
    distal.part = BonePart::Distal;
    distal.label = kScaphoidDistalLabel;
    const Mat3& turn = fracture_->rotation;
    const double angle = std::acos(
        std::clamp((turn.rows[0].x + turn.rows[1].y + turn.rows[2].z - 1) / 2, -1.0, 1.0));
    const double reach =
        length(distal.bounds.extent()) * std::max(0.1, angle) + length(fracture_->shift);
    distal.bounds = distal.bounds.grown(reach);
    shapes_.push_back(distal);
  }
  for (std::size_t k = 0; k < fingers_.size(); ++k) {
    const Phalanx& bone = fingers_[k];
    Shape shape{BoneId::Metacarpal1, BonePart::Whole, kBackgroundLabel, {}, static_cast<int>(k)};
    shape.bounds.include(bone.from);
    shape.bounds.include(bone.to);
    shape.bounds = shape.bounds.grown(bone.knob_mm + 1);
    shapes_.push_back(shape);
  }
}

void BoneShapes::add_finger(const anatomy::ModelBone& metacarpal) {
  Shaft& shaft = shafts_[slot_of(metacarpal.bone)];
  const auto finger = std::find_if(kFingers.begin(), kFingers.end(), [&](const Finger& f) {
    return f.metacarpal == metacarpal.bone;
  });
  shaft.head_mm = kHeadPart * shaft.radius_mm;
  shaft.length_mm = finger->shaft_mm;
  double along = shaft.length_mm + shaft.head_mm;
  double part = 1;
  for (const double length_mm : finger->phalanges_mm) {
    if (!(length_mm > 0)) break;
    const double knob = kKnobPart * part * shaft.radius_mm;
    along += kFingerJointMm + knob;
    const Vec3 from = shaft.centre + shaft.axis * along;
    along += length_mm - 2 * knob;
    fingers_.push_back(
        {from, shaft.centre + shaft.axis * along, kRodPart * part * shaft.radius_mm, knob});
    along += knob;
    part *= kThinner;
  }
}

double BoneShapes::phalanx_value(int phalanx, const Vec3& p) const noexcept {
  const Phalanx& bone = fingers_[static_cast<std::size_t>(phalanx)];
  const Vec3 axis = bone.to - bone.from;
  const double t = std::clamp(dot(p - bone.from, axis) / squared_length(axis), 0.0, 1.0);
  return std::min({distance(p, bone.from + axis * t) - bone.rod_mm,
                   distance(p, bone.from) - bone.knob_mm, distance(p, bone.to) - bone.knob_mm});
}

double BoneShapes::long_bone_value(BoneId bone, const Vec3& p) const noexcept {
  const Shaft& shaft = shafts_[slot_of(bone)];
  const double slant = dot(shaft.section.normal, shaft.axis);
  const double along = shaft.section.signed_distance(p) / slant;  // mm along the axis, past section
  const Vec3 from_centre = p - shaft.centre;
  const double radial = length(from_centre - shaft.axis * dot(from_centre, shaft.axis));
  if (along <= 0) {
    const double allowed = shaft.radius_mm + kSliverMarginMm - kFlareSlope * along;
    return std::max(model_->uncut_value(bone, p), radial - allowed);
  }
  const double narrowing =
      1.0 - (1.0 - shaft.narrowing) * smooth_step(0, shaft.narrows_over_mm, along);
  const Vec3 in_section = shaft.centre + (from_centre - shaft.axis * along) / narrowing;
  const double swept = model_->uncut_value(bone, in_section) * narrowing;
  const double value =
      std::max({swept, radial - shaft.radius_mm - kSliverMarginMm, along - shaft.length_mm});
  if (!(shaft.head_mm > 0)) return value;
  const Vec3 head = shaft.centre + shaft.axis * shaft.length_mm;
  return std::min(value, distance(p, head) - shaft.head_mm);
}

double BoneShapes::fragment_value(BonePart part, const Vec3& p) const noexcept {
  const double half = 0.5 * fracture_->lost_mm;
  if (part == BonePart::Proximal) {
    return std::max(model_->uncut_value(BoneId::Scaphoid, p), fracture_->height(p) + half);
  }
  const Vec3 q = fracture_->undisplaced(p);
  double value = std::max(model_->uncut_value(BoneId::Scaphoid, q), half - fracture_->height(q));
  value = std::max(value, fracture_->least_gap_mm - half - fracture_->height(p));
  for (const BoneId other : kScaphoidNeighbours) {
    if (model_->bone(other).bounds.grown(kClearanceMm).contains(p)) {
      value = std::max(value, kClearanceMm - model_->signed_value(other, p));
    }
  }
  return value;
}

double BoneShapes::value(const Shape& shape, const Vec3& p) const noexcept {
  if (shape.phalanx >= 0) return phalanx_value(shape.phalanx, p);
  if (shape.part != BonePart::Whole) return fragment_value(shape.part, p);
  if (model_->bone(shape.bone).cut_plane) return long_bone_value(shape.bone, p);
  return model_->uncut_value(shape.bone, p);
}

double BoneShapes::signed_distance(const Shape& shape, const Vec3& p) const noexcept {
  const double f = value(shape, p);
  if (!(std::abs(f) < kBandMm)) return f;
  const double h = kGradientStepMm;
  const Vec3 slope{value(shape, {p.x + h, p.y, p.z}) - f, value(shape, {p.x, p.y + h, p.z}) - f,
                   value(shape, {p.x, p.y, p.z + h}) - f};
  // Below a tenth the surface is not near (a ridge of the medial axis): the value stands as it is.
  return f / std::clamp(length(slope) / h, 0.5, 2.0);
}

double BoneShapes::shaft_fraction(BoneId bone, const Vec3& p) const noexcept {
  if (!model_->bone(bone).cut_plane) return 0;
  const double along = shafts_[slot_of(bone)].section.signed_distance(p);
  return belongs_to_forearm(bone) ? smooth_step(-4, 16, along) : smooth_step(-10, 3, along);
}

bool BoneShapes::is_gap_tissue(const Vec3& p) const noexcept {
  if (!is_apart()) return false;
  const Vec3 q = fracture_->undisplaced(p);
  const double half = 0.5 * fracture_->lost_mm;
  if (!(fracture_->height(p) > -half && fracture_->height(q) < half)) return false;
  return model_->uncut_value(BoneId::Scaphoid, p) < 0 ||
         model_->uncut_value(BoneId::Scaphoid, q) < 0;
}

double BoneShapes::depth_from_fracture(BonePart part, const Vec3& p) const noexcept {
  const double half = 0.5 * fracture_->lost_mm;
  return part == BonePart::Proximal ? -fracture_->height(p) - half
                                    : fracture_->height(fracture_->undisplaced(p)) - half;
}

}  // namespace carpus::phantom
