// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/detail/lay_cartilage.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "anatomy/reduction.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "mesh/normals.hpp"

namespace carpus::soft_tissue::detail {
namespace {

constexpr double kOpposed = 0.5;  ///< cosine: normals against each other, and towards
constexpr double kFromLigamentMm = 0.1;
constexpr double kEdgeMm = 0.6;  ///< over which it rises beside a ligament
constexpr double kLeastLevel = 0.02;
constexpr double kThinnestMm = 0.05;
constexpr double kApartMm = 0.02;  ///< between two layers, each
constexpr int kSmoothings = 8;
constexpr int kThicknessSmoothings = 3;
/// Thinner than this share of what it was, cartilage is pressed; less is the smoothing's.
constexpr double kPressedShare = 0.9;
constexpr double kFullShare = 0.75;  ///< of the smoothed mask, where the layer is whole

using Motion = Pose<frame::Patient, frame::Bone>;
using Leading = Pose<frame::Bone, frame::Bone>;

/// A surface that another may face, and where it is in each posture: a piece of a broken bone where
/// it was in the whole one.
struct Opponent {
  const TriangleMesh* surface = nullptr;
  const fields::TriangleTree* tree = nullptr;
  Aabb box;
  std::optional<BoneId> bone;  ///< empty: the disc
  std::vector<Motion> motions;
};

/// How each bone goes back to where it was before a break led its pieces apart; empty where none
/// did. Cartilage grew on the whole bone: its thickness is that joint's and not the gap's that is
/// left. A gap alone is bone that was lost, and no way that a piece went.
std::vector<Leading> leading_back(const cases::CaseData& data) {
  const cases::Bone* proximal = cases::find_bone(data, BoneId::Scaphoid, BonePart::Proximal);
  const cases::Bone* distal = cases::find_bone(data, BoneId::Scaphoid, BonePart::Distal);
  if (proximal == nullptr || distal == nullptr) return {};
  const auto faces = anatomy::reduction_of(proximal->surface, distal->surface);
  if (!faces) return {};
  anatomy::FractureOffset across = faces->offset({});
  across.gap_mm = 0;
  if (!anatomy::lies_apart(across)) return {};
  std::vector<Leading> leading(data.bones.size());
  leading[static_cast<std::size_t>(distal - data.bones.data())] =
      faces->first_from_second_reduced();
  return leading;
}

/// From each vertex to the nearest other bone, or the disc, as all lies in the scan.
std::vector<double> room_as_scanned(const Opponent& own,
                                    const std::vector<Opponent>& opponents,
                                    double farthest) {
  std::vector<double> room(own.surface->vertices.size(), farthest);
  for (const Opponent& o : opponents) {
    if (o.bone && *o.bone == *own.bone) continue;
    for (std::size_t v = 0; v < room.size(); ++v) {
      const Vec3& at = own.surface->vertices[v];
      if (!o.box.grown(room[v]).contains(at)) continue;
      const auto hit = o.tree->nearest(at, room[v]);
      if (hit) room[v] = std::sqrt(hit->squared_distance);
    }
  }
  return room;
}

std::vector<anatomy::HandPose> postures_of(const TabledCartilage& tabled,
                                           const cases::HandMotion& motion) {
  std::vector<anatomy::HandPose> postures{motion.scan};
  if (motion.is_empty()) return postures;
  for (const auto& [flexion, deviation] : tabled.postures) {
    anatomy::HandPose pose = motion.scan;
    pose.flexion_rad = radians_from_degrees(flexion);
    pose.radial_deviation_rad = radians_from_degrees(deviation);
    postures.push_back(pose);
  }
  return postures;
}

std::vector<std::vector<std::uint32_t>> neighbours_of(const TriangleMesh& mesh) {
  std::vector<std::vector<std::uint32_t>> of(mesh.vertices.size());
  for (const Triangle& t : mesh.facets) {
    for (std::size_t k = 0; k < 3; ++k) of[t[k]].push_back(t[(k + 1) % 3]);
  }
  return of;
}

void smooth_values(std::vector<double>& values,
                   const std::vector<std::vector<std::uint32_t>>& neighbours,
                   int passes) {
  for (int pass = 0; pass < passes; ++pass) {
    const std::vector<double> before = values;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (neighbours[i].empty()) continue;
      double sum = 0;
      for (const std::uint32_t n : neighbours[i]) sum += before[n];
      values[i] = 0.5 * before[i] + 0.5 * sum / static_cast<double>(neighbours[i].size());
    }
  }
}

std::vector<double> vertex_areas(const TriangleMesh& mesh) {
  std::vector<double> areas(mesh.vertices.size());
  for (const Triangle& t : mesh.facets) {
    const Vec3& a = mesh.vertices[t[0]];
    const double area = 0.5 * length(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
    for (const std::uint32_t v : t) areas[v] += area / 3;
  }
  return areas;
}

/// Takes small patches off the mask.
void drop_small(std::vector<double>& mask,
                const TriangleMesh& mesh,
                const std::vector<std::vector<std::uint32_t>>& neighbours,
                double least_area_mm2) {
  const std::vector<double> areas = vertex_areas(mesh);
  std::vector<bool> is_seen(mask.size());
  for (std::uint32_t start = 0; start < mask.size(); ++start) {
    if (is_seen[start] || mask[start] <= 0.5) continue;
    std::vector<std::uint32_t> patch{start};
    is_seen[start] = true;
    double area = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      area += areas[patch[i]];
      for (const std::uint32_t n : neighbours[patch[i]]) {
        if (is_seen[n] || mask[n] <= 0.5) continue;
        is_seen[n] = true;
        patch.push_back(n);
      }
    }
    if (area >= least_area_mm2) continue;
    for (const std::uint32_t v : patch) mask[v] = 0;
  }
}

}  // namespace

TriangleMesh raised_sheet(const TriangleMesh& surface,
                          const std::vector<double>& level,
                          const std::vector<float>& thickness) {
  const std::vector<Vec3> normals = mesh::vertex_normals(surface);
  TriangleMesh sheet;  // vertices in pairs: raised, and on the surface
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> of_edge;
  std::map<std::uint32_t, std::uint32_t> of_vertex;
  const auto add = [&](const Vec3& at, const Vec3& normal, double mm) {
    const auto index = static_cast<std::uint32_t>(sheet.vertices.size());
    sheet.vertices.push_back(at + normal * mm);
    sheet.vertices.push_back(at);
    return index;
  };
  const auto vertex = [&](std::uint32_t v) {
    const auto [it, is_new] = of_vertex.try_emplace(v);
    if (is_new)
      it->second = add(surface.vertices[v], normals[v], static_cast<double>(thickness[v]));
    return it->second;
  };
  const auto crossing = [&](std::uint32_t a, std::uint32_t b) {
    const auto [it, is_new] = of_edge.try_emplace(std::minmax(a, b));
    if (is_new) {
      const double t = level[a] / (level[a] - level[b]);
      it->second =
          add(surface.vertices[a] + (surface.vertices[b] - surface.vertices[a]) * t,
              normalized_or(normals[a] * (1 - t) + normals[b] * t, normals[a]), kThinnestMm);
    }
    return it->second;
  };
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Triangle& t : surface.facets) {
    std::vector<std::uint32_t> kept;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k];
      const std::uint32_t b = t[(k + 1) % 3];
      if (level[a] > 0) kept.push_back(vertex(a));
      if ((level[a] > 0) != (level[b] > 0)) kept.push_back(crossing(a, b));
    }
    for (std::size_t k = 2; k < kept.size(); ++k) {
      sheet.facets.push_back({kept[0], kept[k - 1], kept[k]});
      sheet.facets.push_back({kept[0] + 1, kept[k] + 1, kept[k - 1] + 1});
    }
    for (std::size_t k = 0; k < kept.size(); ++k)
      edges.insert({kept[k], kept[(k + 1) % kept.size()]});
  }
  for (const auto& [a, b] : edges) {
    if (edges.contains({b, a})) continue;
    sheet.facets.push_back({b, a, a + 1});
    sheet.facets.push_back({b, a + 1, b + 1});
  }
  return sheet;
}

std::vector<Cartilage> lay_cartilage(const TabledCartilage& tabled,
                                     double size,
                                     const Surroundings& bones,
                                     const TriangleMesh& disc,
                                     const std::vector<Sheet>& ligaments) {
  const cases::CaseData& data = bones.data();
  const std::vector<anatomy::HandPose> postures = postures_of(tabled, data.hand_motion);
  const std::vector<Leading> leading = leading_back(data);
  std::vector<Opponent> opponents;
  for (std::size_t i = 0; i < data.bones.size(); ++i) {
    const cases::Bone& bone = data.bones[i];
    Opponent o{&bone.surface, &bones.tree(i), bounds_of(bone.surface.vertices), bone.bone, {}};
    for (const anatomy::HandPose& p : postures) {
      const Motion motion = data.hand_motion.pose_of(bone.bone, p);
      o.motions.push_back(leading.empty() ? motion : motion * leading[i]);
    }
    opponents.push_back(std::move(o));
  }
  const fields::TriangleTree disc_tree(disc);
  if (!disc.facets.empty()) {
    Opponent o{&disc, &disc_tree, bounds_of(disc.vertices), std::nullopt, {}};
    for (const anatomy::HandPose& p : postures) {
      o.motions.push_back(data.hand_motion.pose_of(BoneId::Radius, p));
    }
    opponents.push_back(std::move(o));
  }
  std::vector<SheetDistance> covers;
  for (const Sheet& s : ligaments) covers.emplace_back(s);

  std::vector<std::optional<Cartilage>> made(data.bones.size());
  parallel_for(data.bones.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const cases::Bone& bone = data.bones[i];
      if (bone.bone > BoneId::Hamate) continue;
      const Thickness& thickness = tabled.of_bone[static_cast<std::size_t>(bone.bone) - 1];
      const TriangleMesh& surface = bone.surface;
      const std::vector<Vec3> normals = mesh::vertex_normals(surface);
      const auto neighbours = neighbours_of(surface);
      const double farthest = tabled.farthest_mm * size;
      std::vector<double> mask(surface.vertices.size());
      std::vector<double> gap(surface.vertices.size(), farthest);
      for (std::size_t v = 0; v < mask.size(); ++v) {
        for (std::size_t p = 0; p < postures.size(); ++p) {
          if (mask[v] > 0 && p > 0) break;
          const Motion& own = opponents[i].motions[p];
          double nearest = farthest;
          bool does_face = false;
          for (std::size_t j = 0; j < opponents.size(); ++j) {
            const Opponent& o = opponents[j];
            if (o.bone && *o.bone == bone.bone) continue;
            const auto back = o.motions[p].inverse();
            const Vec3 at = (back * (own * Point<frame::Bone>{surface.vertices[v]})).v;
            if (!o.box.grown(nearest).contains(at)) continue;
            const auto hit = o.tree->nearest(at, nearest);
            if (!hit) continue;
            nearest = std::sqrt(hit->squared_distance);
            // As scanned no bone is in another; led back, one may be, and there was no room.
            if (!leading.empty() && o.bone && bones.exact_mm(j, at, 0.01) < 0) nearest = 0;
            const Vec3 normal = back.rotation * (own.rotation * normals[v]);
            const Vec3 way = normalized_or(hit->point - at, normal);
            does_face = dot(way, normal) > kOpposed &&
                        dot(facet_normal(*o.surface, hit->facet), normal) < -kOpposed;
          }
          if (p == 0) gap[v] = nearest;
          if (does_face) mask[v] = 1;
        }
      }
      // Two parts of a broken bone do not face each other as in a joint, but neither may lie in the
      // other's cartilage.
      std::vector<double> other_part(surface.vertices.size(), farthest);
      for (const Opponent& o : opponents) {
        if (!o.bone || *o.bone != bone.bone || o.surface == &surface) continue;
        for (std::size_t v = 0; v < other_part.size(); ++v) {
          const auto hit = o.tree->nearest(surface.vertices[v], other_part[v]);
          if (hit) other_part[v] = std::sqrt(hit->squared_distance);
        }
      }
      smooth_values(mask, neighbours, kSmoothings);
      drop_small(mask, surface, neighbours, tabled.least_area_mm2 * size * size);
      std::vector<double> level(mask.size());
      // A ligament may overhang: no more than the way to it.
      std::vector<double> to_ligament(mask.size(), thickness.mm * size + kEdgeMm);
      for (std::size_t v = 0; v < mask.size(); ++v) {
        level[v] = std::min(1.0, (mask[v] - 0.5) / (kFullShare - 0.5));
        if (level[v] <= 0) continue;
        for (const SheetDistance& cover : covers) {
          const double away = cover.mm(surface.vertices[v], to_ligament[v]);
          to_ligament[v] = std::min(to_ligament[v], away);
          level[v] = std::min(level[v], (away - kFromLigamentMm) / kEdgeMm);
        }
      }
      // Nor may a facet reach into one between its corners.
      for (std::size_t v = 0; v < mask.size(); ++v) {
        for (const std::uint32_t n : neighbours[v]) {
          if (level[v] <= 0 && level[n] <= 0) continue;
          const Vec3 between = (surface.vertices[v] + surface.vertices[n]) * 0.5;
          double away = std::max(to_ligament[v], to_ligament[n]);
          for (const SheetDistance& cover : covers) away = cover.mm(between, away);
          to_ligament[v] = std::min(to_ligament[v], away);
          to_ligament[n] = std::min(to_ligament[n], away);
        }
      }
      // A level of nearly nothing would make slivers.
      for (double& l : level) {
        if (std::abs(l) < kLeastLevel) l = -kLeastLevel;
      }
      const auto limit = [&](const std::vector<double>& room, std::size_t v) {
        return std::max(kThinnestMm, std::min(0.5 * room[v], other_part[v]) - kApartMm);
      };
      std::vector<double> grown(mask.size());
      for (std::size_t v = 0; v < mask.size(); ++v) {
        grown[v] = std::min(thickness.mm * size, limit(gap, v));
      }
      smooth_values(grown, neighbours, kThicknessSmoothings);
      for (std::size_t v = 0; v < mask.size(); ++v) grown[v] = std::min(grown[v], limit(gap, v));
      // As it lies it is pressed into the room that there is.
      std::vector<double> lying = grown;
      if (!leading.empty()) {
        const std::vector<double> room = room_as_scanned(opponents[i], opponents, farthest);
        std::vector<double> share(mask.size());
        for (std::size_t v = 0; v < mask.size(); ++v) {
          share[v] = std::min(1.0, limit(room, v) / grown[v]);
        }
        smooth_values(share, neighbours, kThicknessSmoothings);
        for (std::size_t v = 0; v < mask.size(); ++v) {
          lying[v] = std::min(share[v] * grown[v], limit(room, v));
        }
      }
      Cartilage c;
      c.label = bone.label;
      c.vertex_thickness_mm.assign(mask.size(), 0);
      const std::vector<double> areas = vertex_areas(surface);
      double whole = 0;
      for (std::size_t v = 0; v < mask.size(); ++v) {
        if (level[v] <= 0) continue;
        const double most = std::min(level[v] * grown[v], to_ligament[v] - kFromLigamentMm);
        const double unpressed_mm = std::max(kThinnestMm, most);
        const double mm = std::max(kThinnestMm, std::min(level[v] * lying[v], most));
        c.vertex_thickness_mm[v] = static_cast<float>(mm);
        c.area_mm2 += areas[v];
        c.greatest_thickness_mm = std::max(c.greatest_thickness_mm, unpressed_mm);
        if (mm < kPressedShare * unpressed_mm) {
          c.pressed_area_mm2 += areas[v];
          c.pressed_thickness_mm += mm * areas[v];
        }
        if (level[v] < 1) continue;
        whole += areas[v];
        c.mean_thickness_mm += unpressed_mm * areas[v];
      }
      if (!(c.area_mm2 > 0)) continue;
      if (whole > 0) c.mean_thickness_mm /= whole;
      if (c.pressed_area_mm2 > 0) c.pressed_thickness_mm /= c.pressed_area_mm2;
      c.thickness_range_mm = {thickness.range.low * size, thickness.range.high * size};
      c.body = raised_sheet(surface, level, c.vertex_thickness_mm);
      if (!c.body.facets.empty()) made[i] = std::move(c);
    }
  });
  std::vector<Cartilage> all;
  for (auto& c : made) {
    if (c) all.push_back(std::move(*c));
  }
  return all;
}

}  // namespace carpus::soft_tissue::detail
