// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. A triangle is a fracture face where none of the bone's outer samples is near.
// 2. Sign: by the nearest triangle's normal where that is plain, else by winding numbers; beside a
//    fracture face the bridged gap counts as inside.
// 3. The farthest place of an envelope: a lattice over it, then a search with halved steps about
// the
//    best places of the lattice, since distances change by no more than the way.
#include "view_trainer/scaphoid_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "anatomy/bone_words.hpp"
#include "core/error.hpp"
#include "geometry/aabb.hpp"

namespace carpus::view_trainer {
namespace {

std::vector<const MeshIn<frame::Bone>*> surfaces_of(const std::vector<const cases::Bone*>& parts) {
  if (parts.empty()) throw InvalidInput("view trainer: the case has no scaphoid");
  std::vector<const MeshIn<frame::Bone>*> surfaces;
  for (const cases::Bone* part : parts) surfaces.push_back(&part->surface);
  return surfaces;
}

TriangleMesh joined(const std::vector<const cases::Bone*>& parts) {
  TriangleMesh all;
  for (const cases::Bone* part : parts) {
    const auto offset = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), part->surface.vertices.begin(),
                        part->surface.vertices.end());
    for (const Triangle& f : part->surface.facets) {
      all.facets.push_back({f[0] + offset, f[1] + offset, f[2] + offset});
    }
  }
  return all;
}

Vec3 middle_of(const TriangleMesh& mesh, const Triangle& f) {
  return (mesh.vertices[f[0]] + mesh.vertices[f[1]] + mesh.vertices[f[2]]) / 3.0;
}

/// By triangle: none of the samples of the outer surface lies near. They are 0.5 mm apart.
std::vector<std::uint8_t> fracture_faces(const TriangleMesh& all, const BoneSolid& solid) {
  constexpr double kNearMm = 0.5;
  constexpr double kCellMm = 1.0;
  Aabb box;
  for (const Vec3& v : all.vertices) box.include(v);
  GridGeometry cells;
  const Aabb grown = box.grown(2 * kCellMm);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cells.size[axis] = static_cast<int>(grown.extent()[axis] / kCellMm) + 2;
  }
  cells.spacing = {kCellMm, kCellMm, kCellMm};
  cells.origin = grown.low;
  Grid<std::vector<Vec3>> near(cells);
  const auto cell_of = [&](const Vec3& p) {
    const Vec3 v = cells.voxel_from_patient(p);
    return VoxelIndex{static_cast<int>(v.x), static_cast<int>(v.y), static_cast<int>(v.z)};
  };
  for (const OuterPoint& outer : solid.outer_points())
    near[cell_of(outer.point)].push_back(outer.point);
  const auto has_outer = [&](const Vec3& p) {
    const VoxelIndex c = cell_of(p);
    for (int k = -1; k <= 1; ++k) {
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          const VoxelIndex at{c.x + i, c.y + j, c.z + k};
          if (!cells.contains(at)) continue;
          for (const Vec3& q : near[at]) {
            if (squared_length(q - p) < kNearMm * kNearMm) return true;
          }
        }
      }
    }
    return false;
  };
  std::vector<std::uint8_t> faces;
  faces.reserve(all.facets.size());
  for (const Triangle& f : all.facets) {
    faces.push_back(has_outer(middle_of(all, f)) ? std::uint8_t{0} : std::uint8_t{1});
  }
  return faces;
}

TriangleMesh outer_of(const TriangleMesh& all, const std::vector<std::uint8_t>& is_fracture) {
  TriangleMesh outer;
  outer.vertices = all.vertices;
  for (std::size_t i = 0; i < all.facets.size(); ++i) {
    if (is_fracture[i] == 0) outer.facets.push_back(all.facets[i]);
  }
  return outer;
}

/// The envelope's surface by two coordinates: the way along its profile, from the middle of the
/// tip's face over the rim and along the side to the middle of the tail's, and the angle around.
class Envelope {
 public:
  explicit Envelope(const PlacedScrew& placed)
      : placed_(placed),
        tip_radius_(placed.instrument().tip_diameter_mm / 2),
        tail_radius_(placed.instrument().tail_diameter_mm / 2),
        length_(placed.instrument().length_mm),
        a_(any_perpendicular(placed.shaft)),
        b_(cross(placed.shaft, a_)) {}

  [[nodiscard]] double way() const noexcept { return tip_radius_ + length_ + tail_radius_; }
  [[nodiscard]] double mean_radius() const noexcept { return (tip_radius_ + tail_radius_) / 2; }
  [[nodiscard]] double rim_at_tip() const noexcept { return tip_radius_; }
  [[nodiscard]] double rim_at_tail() const noexcept { return tip_radius_ + length_; }
  /// From the tip [mm].
  [[nodiscard]] double height_at(double s) const noexcept {
    return std::clamp(s - tip_radius_, 0.0, length_);
  }
  [[nodiscard]] Vec3 at(double s, double angle) const noexcept {
    const double z = height_at(s);
    double radius = tip_radius_ + (tail_radius_ - tip_radius_) * z / length_;
    if (s < tip_radius_) radius = s;
    if (s > tip_radius_ + length_) radius = std::max(0.0, way() - s);
    return placed_.tip + placed_.shaft * z + (a_ * std::cos(angle) + b_ * std::sin(angle)) * radius;
  }

 private:
  PlacedScrew placed_;
  double tip_radius_;
  double tail_radius_;
  double length_;
  Vec3 a_;
  Vec3 b_;
};

struct EnvelopePlace {
  double s = 0;
  double angle = 0;
  double distance = -1e9;
};

constexpr double kLatticeMm = 0.4;
constexpr double kFinestMm = 0.003;

std::vector<double> lattice_along(const Envelope& envelope) {
  std::vector<double> along{envelope.rim_at_tip(), envelope.rim_at_tail()};
  const int steps = static_cast<int>(std::ceil(envelope.way() / kLatticeMm));
  for (int i = 0; i <= steps; ++i) along.push_back(envelope.way() * i / steps);
  return along;
}

}  // namespace

ScaphoidSurface::ScaphoidSurface(const cases::CaseData& data)
    : data_(data),
      fragments_(cases::scaphoid_parts(data)),
      solid_(surfaces_of(fragments_)),
      all_(joined(fragments_)),
      is_fracture_(fragments_.size() > 1 ? fracture_faces(all_, solid_)
                                         : std::vector<std::uint8_t>(all_.facets.size(), 0)),
      all_tree_(all_),
      outer_tree_(outer_of(all_, is_fracture_)) {
  for (const cases::Bone* part : fragments_) exact_.emplace_back(part->surface);
  if (fragments_.size() > 1) find_gap();
}

void ScaphoidSurface::find_gap() {
  constexpr double kStepMm = 0.3;
  Aabb box;
  for (const Vec3& v : all_.vertices) box.include(v);
  for (double z = box.low.z; z <= box.high.z; z += kStepMm) {
    for (double y = box.low.y; y <= box.high.y; y += kStepMm) {
      for (double x = box.low.x; x <= box.high.x; x += kStepMm) {
        const Vec3 p{x, y, z};
        if (!solid_.contains(p)) continue;
        const auto nearest = all_tree_.nearest(p);
        if (nearest && is_fracture_[nearest->facet] != 0) gap_points_.push_back(p);
      }
    }
  }
}

bool ScaphoidSurface::is_inside_a_fragment(const Vec3& point) const {
  return std::any_of(exact_.begin(), exact_.end(), [&](const fields::ExactSurface& each) {
    return each.signed_distance(point) < 0;
  });
}

double ScaphoidSurface::signed_distance(const Vec3& point) const {
  const auto nearest = all_tree_.nearest(point);
  if (!nearest) return 1e9;
  if (is_fracture_[nearest->facet] != 0) {
    const auto outer = outer_tree_.nearest(point);
    const double distance = outer ? std::sqrt(outer->squared_distance) : 1e9;
    return solid_.contains(point) || is_inside_a_fragment(point) ? -distance : distance;
  }
  const double distance = std::sqrt(nearest->squared_distance);
  const Triangle& f = all_.facets[nearest->facet];
  const Vec3& a = all_.vertices[f[0]];
  const Vec3 normal =
      normalized_or(cross(all_.vertices[f[1]] - a, all_.vertices[f[2]] - a), Vec3{});
  const double rise = dot(point - nearest->point, normal);
  // Only at an edge sharper than 60 degrees could a triangle that is seen so steeply mislead.
  constexpr double kPlain = 0.5;
  if (std::abs(rise) > kPlain * distance) return rise < 0 ? -distance : distance;
  return is_inside_a_fragment(point) ? -distance : distance;
}

Protrusion ScaphoidSurface::protrusion_of(const PlacedScrew& placed) const {
  const Envelope envelope(placed);
  const auto measure = [&](double s, double angle) {
    return EnvelopePlace{s, angle, signed_distance(envelope.at(s, angle))};
  };
  const auto is_farther = [](const EnvelopePlace& a, const EnvelopePlace& b) {
    return a.distance > b.distance;
  };
  const double around_step = kLatticeMm / envelope.mean_radius();
  const int around = static_cast<int>(std::ceil(2 * std::numbers::pi / around_step));
  std::vector<EnvelopePlace> places;
  for (const double s : lattice_along(envelope)) {
    for (int j = 0; j < around; ++j)
      places.push_back(measure(s, 2 * std::numbers::pi * j / around));
  }
  constexpr std::size_t kStarts = 6;
  const std::size_t starts = std::min(kStarts, places.size());
  std::partial_sort(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(starts),
                    places.end(), is_farther);
  EnvelopePlace best = places.front();
  for (std::size_t i = 0; i < starts; ++i) {
    EnvelopePlace here = places[i];
    for (double step = kLatticeMm / 2; step > kFinestMm;) {
      const double turn = step / envelope.mean_radius();
      const EnvelopePlace before = here;
      for (const auto& [ds, da] : {std::array{step, 0.0}, std::array{-step, 0.0},
                                   std::array{0.0, turn}, std::array{0.0, -turn}}) {
        const EnvelopePlace next =
            measure(std::clamp(before.s + ds, 0.0, envelope.way()), before.angle + da);
        if (is_farther(next, here)) here = next;
      }
      if (!is_farther(here, before)) step /= 2;
    }
    if (is_farther(here, best)) best = here;
  }
  Protrusion result;
  result.depth_mm = best.distance;
  result.at = envelope.at(best.s, best.angle);
  const double height = envelope.height_at(best.s);
  const double length = placed.instrument().length_mm;
  const Vec3 to_distal = data_.scaphoid.central_axis.distal - data_.scaphoid.central_axis.proximal;
  const bool tip_is_distal = dot(placed.shaft, to_distal) < 0;
  if (height < kPoleMm) result.region = tip_is_distal ? Region::Distal : Region::Proximal;
  if (height > length - kPoleMm) result.region = tip_is_distal ? Region::Proximal : Region::Distal;
  return result;
}

std::string ScaphoidSurface::neighbour_at(const Vec3& point) const {
  constexpr double kReachMm = 3.0;
  double best = kReachMm * kReachMm;
  std::string name;
  for (const cases::Bone& bone : data_.bones) {
    if (bone.bone == BoneId::Scaphoid) continue;
    for (const Vec3& v : bone.surface.vertices) {
      if (squared_length(v - point) >= best) continue;
      best = squared_length(v - point);
      name = words_of(bone.bone, bone.part);
    }
  }
  return name;
}

}  // namespace carpus::view_trainer
