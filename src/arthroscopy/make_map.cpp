// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Joints by their spaces -> portals (detail/portal_placement, which tells how) -> the tour's points
// on the joints' walls (detail/tour_places) -> ligaments that yield on these walls
// (detail/lay_band) -> cartilage near them.
#include "arthroscopy/make_map.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arthroscopy/band_table.hpp"
#include "arthroscopy/detail/bone_landmarks.hpp"
#include "arthroscopy/detail/joint_of.hpp"
#include "arthroscopy/detail/lay_band.hpp"
#include "arthroscopy/detail/portal_placement.hpp"
#include "arthroscopy/detail/pulled_bones.hpp"
#include "arthroscopy/detail/scanned_bones.hpp"
#include "arthroscopy/detail/space_walls.hpp"
#include "arthroscopy/detail/tour_places.hpp"
#include "arthroscopy/detail/wrist_axes.hpp"
#include "arthroscopy/portal_table.hpp"
#include "fields/distance_field.hpp"

namespace carpus::arthroscopy {
namespace {

using soft_tissue::SoftTissue;
using soft_tissue::Space;

/// Cartilage of this joint: so near to the wall of its space.
constexpr double kOnWallMm = 0.6;
constexpr double kThinnestMm = 0.05;

const Space* space_of(const SoftTissue& tissue, const std::string& id) {
  for (const Space& space : tissue.spaces) {
    if (space.id == id && !space.surface.facets.empty()) return &space;
  }
  return nullptr;
}

/// The radioulnar ligaments are the disc's edges and hide what lies behind them as it does.
TriangleMesh disc_with_edges(const SoftTissue& tissue) {
  TriangleMesh whole = tissue.disc.body;
  if (whole.facets.empty()) return whole;
  for (const soft_tissue::Ligament& l : tissue.ligaments) {
    if (l.group != "radioulnar") continue;
    const auto first = static_cast<std::uint32_t>(whole.vertices.size());
    whole.vertices.insert(whole.vertices.end(), l.body.vertices.begin(), l.body.vertices.end());
    for (const Triangle& t : l.body.facets) {
      whole.facets.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
  }
  return whole;
}

class MapMaker {
 public:
  MapMaker(const cases::CaseData& data, const SoftTissue& tissue)
      : data_(data),
        tissue_(tissue),
        table_(PortalTable::generic()),
        axes_(data, tissue.size),
        bones_(data, table_.traction_n) {
    map_.forearm = body_of(BoneId::Radius).value_or(0);
    map_.disc = disc_with_edges(tissue);
    map_.disc_sheet = tissue.disc.middle;
    map_.distal = axes_.way({-1, 0, 0});
  }

  cases::ArthroscopicMap make() {
    take_joints();
    const detail::TourPlaces places(data_, tissue_, axes_, walls_);
    detail::PortalPlacement(data_, axes_, bones_, places, map_).place_all(table_);
    for (std::uint8_t j = 0; j < map_.joints.size(); ++j) {
      if (!is_reached(j)) map_.problems.push_back(map_.joints[j].name + ": no portal leads there");
    }
    if (map_.portals.empty()) return std::move(map_);
    for (const detail::Landmark& mark : detail::bone_landmarks(data_, axes_)) {
      const BoneId bone = mark.id == "ulnar_styloid" ? BoneId::Ulna : BoneId::Radius;
      map_.landmarks.push_back({mark.id, axes_.point(mark.at), body_of(bone).value_or(0)});
    }
    place_points(places);
    lay_bands();
    collect_cartilage();
    return std::move(map_);
  }

 private:
  [[nodiscard]] std::optional<std::uint8_t> body_of(BoneId bone) const {
    for (std::size_t b = 0; b < data_.bones.size(); ++b) {
      if (data_.bones[b].bone == bone) return static_cast<std::uint8_t>(b);
    }
    return std::nullopt;
  }

  void take_joints() {
    for (const TabledJoint& joint : table_.joints) {
      const Space* space = space_of(tissue_, joint.id);
      const auto proximal = body_of(joint.between[0]);
      const auto distal = body_of(joint.between[1]);
      if (space == nullptr || !proximal || !distal) {
        map_.problems.push_back("the " + joint.name + "'s space could not be made");
        continue;
      }
      map_.joints.push_back({joint.id, joint.name,
                             fields::build_distance_field(space->surface, {0.4, detail::kFarMm}),
                             *proximal, *distal});
      walls_.emplace_back(*space, data_);
    }
  }

  [[nodiscard]] bool is_reached(std::uint8_t joint) const {
    return std::any_of(map_.portals.begin(), map_.portals.end(),
                       [&](const cases::Portal& portal) { return portal.joint == joint; });
  }

  void place_points(const detail::TourPlaces& places) {
    for (const TabledPoint& point : table_.points) {
      const auto joint = detail::joint_of(map_, point.joint);
      if (!joint || !is_reached(*joint)) continue;  // the joint is named already
      const std::optional<Vec3> at = places.place_of(point, *joint);
      if (!at) {
        map_.problems.push_back(point.name + ": is missing in this case");
        continue;
      }
      cases::TourPoint placed;
      placed.number = point.number;
      placed.id = point.id;
      placed.name = point.name;
      placed.found_by = point.found_by;
      placed.at = *at;
      // The disc goes with the forearm, whatever bone is nearest.
      placed.body = detail::lies_on_disc(walls_[*joint], *at) ? map_.forearm
                                                              : detail::nearest_body(data_, *at);
      placed.is_probed = point.is_probed;
      placed.joint = *joint;
      for (const std::string& by : point.by) {
        for (std::uint8_t p = 0; p < map_.portals.size(); ++p) {
          if (map_.portals[p].id == by) placed.by.push_back(p);
        }
      }
      map_.points.push_back(std::move(placed));
    }
  }

  void lay_bands() {
    const BandTable& table = BandTable::generic();
    for (const TabledBand& band : table.bands) {
      const auto joint = detail::joint_of(map_, band.joint);
      if (!joint || map_.bands.size() == cases::kMaxBands) continue;
      auto laid =
          detail::lay_band(data_, tissue_, walls_[*joint], map_.joints[*joint].wall, band, table);
      if (!laid) {
        map_.problems.push_back("the " + band.name + " ligament yields nowhere in this case");
        continue;
      }
      laid->joint = *joint;
      map_.bands.push_back(std::move(*laid));
    }
  }

  void collect_cartilage() {
    for (const soft_tissue::Cartilage& c : tissue_.cartilage) {
      for (std::size_t b = 0; b < data_.bones.size(); ++b) {
        const MeshIn<frame::Bone>& surface = data_.bones[b].surface;
        if (data_.bones[b].label != c.label ||
            c.vertex_thickness_mm.size() != surface.vertices.size()) {
          continue;
        }
        for (const Triangle& f : surface.facets) {
          add_facet(surface, f, c.vertex_thickness_mm, static_cast<std::uint8_t>(b));
        }
      }
    }
  }

  void add_facet(const TriangleMesh& surface,
                 const Triangle& f,
                 const std::vector<float>& thickness,
                 std::uint8_t body) {
    for (const std::uint32_t v : f) {
      if (!(thickness[v] > kThinnestMm)) return;
    }
    const Vec3& a = surface.vertices[f[0]];
    const Vec3& b = surface.vertices[f[1]];
    const Vec3& c = surface.vertices[f[2]];
    const Vec3 middle = (a + b + c) / 3.0;
    const Vec3 normal = cross(b - a, c - a);
    const double twice = length(normal);
    if (!(twice > 0)) return;
    for (std::uint8_t j = 0; j < walls_.size(); ++j) {
      if (!is_reached(j) || !walls_[j].tree.nearest(middle, kOnWallMm)) continue;
      map_.cartilage.push_back({middle, normal / twice, twice / 2, body, j});
      return;
    }
  }

  const cases::CaseData& data_;
  const SoftTissue& tissue_;
  const PortalTable& table_;
  detail::WristAxes axes_;
  detail::PulledBones bones_;
  std::vector<detail::SpaceWalls> walls_;  ///< by joint
  cases::ArthroscopicMap map_;
};

}  // namespace

cases::ArthroscopicMap make_map(const cases::CaseData& data, const SoftTissue& tissue) {
  return MapMaker(data, tissue).make();
}

}  // namespace carpus::arthroscopy
