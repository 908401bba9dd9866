// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/joint_wall.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "arthroscopy/detail/carry_wall.hpp"
#include "arthroscopy/detail/lay_fibres.hpp"
#include "arthroscopy/portal_table.hpp"
#include "cases/joint_under_block.hpp"
#include "fields/distance_field.hpp"
#include "fields/triangle_tree.hpp"
#include "geometry/aabb.hpp"
#include "mesh/neighbours.hpp"
#include "mesh/part_bridges.hpp"
#include "mesh/simplify_in_states.hpp"

namespace carpus::arthroscopy {
namespace {

using soft_tissue::Lining;

constexpr double kFarMm = 4.0;
/// Of one side of the joint to the other: so near they touch, for the picture.
constexpr float kTouchingMm = 1.5F;
constexpr std::uint8_t kRingsAboutCut = 3;
constexpr int kSmoothedTimes = 30;
/// With a probe's 672 and a loose body's 720 less than 15 000 triangles are drawn.
constexpr std::size_t kMostFacets = 13500;
/// As far from a bone as a wall may lie that is on it: the grid of its space.
constexpr double kTouchMm = 0.2;
/// Of a place on a bone: so far it keeps to it rather than to what is about, which evens it out
/// over one facet or so.
constexpr float kHold = 0.5F;
/// So far scaphoid and triquetrum may part from the lunate: Geissler IV, a scope passes [E].
constexpr double kPartedMm = 3.2;

struct Nearest {
  std::uint8_t body = 0;
  double mm = kFarMm;
  std::uint8_t next_body = 0;  ///< of the row's other bones
  double next_mm = kFarMm;
};

enum class Row : std::uint8_t { Forearm, Proximal, Distal };

Row row_of(BoneId bone) {
  switch (bone) {
    case BoneId::Scaphoid:
    case BoneId::Lunate:
    case BoneId::Triquetrum:
      return Row::Proximal;
    default:
      return belongs_to_forearm(bone) ? Row::Forearm : Row::Distal;
  }
}

/// Of the bones on one side; the ulna turns against the forearm, the pisiform bounds no joint here.
bool bounds_joint(BoneId bone) {
  return bone != BoneId::Ulna && bone != BoneId::Pisiform && bone <= BoneId::Hamate;
}

/// Of a row's bones the one nearest to a place.
class NearestBones {
 public:
  explicit NearestBones(const cases::CaseData& data) : data_(data), trees_(data.bones.size()) {}

  [[nodiscard]] Nearest of(const Vec3& at, Row row) {
    Nearest best;
    for (std::size_t b = 0; b < data_.bones.size(); ++b) {
      const cases::Bone& bone = data_.bones[b];
      if (!is_of(bone, row) || bone.distance_field.values().empty()) continue;
      const fields::DistanceSample s = fields::sample_distance(bone.distance_field, at);
      if (!s.is_inside_grid) continue;
      const auto body = static_cast<std::uint8_t>(b);
      if (s.distance_mm < best.mm) {
        best = {body, s.distance_mm, best.body, best.mm};
      } else if (s.distance_mm < best.next_mm) {
        best.next_body = body;
        best.next_mm = s.distance_mm;
      }
    }
    if (best.mm >= kFarMm) best.body = far_from(at, row);
    best.mm = std::max(0.0, best.mm);
    best.next_mm = std::max(0.0, best.next_mm);
    return best;
  }

 private:
  static bool is_of(const cases::Bone& bone, Row row) {
    return bounds_joint(bone.bone) && row_of(bone.bone) == row;
  }

  /// Fields end some millimetres off: taken for equally far there, the row's first bone would take
  /// along what lies by its last.
  [[nodiscard]] std::uint8_t far_from(const Vec3& at, Row row) {
    std::uint8_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < data_.bones.size(); ++b) {
      if (!is_of(data_.bones[b], row)) continue;
      if (!trees_[b]) trees_[b].emplace(data_.bones[b].surface);
      const auto near = trees_[b]->nearest(at);
      if (!near || near->squared_distance >= least) continue;
      least = near->squared_distance;
      best = static_cast<std::uint8_t>(b);
    }
    return best;
  }

  const cases::CaseData& data_;
  std::vector<std::optional<fields::TriangleTree>> trees_;  ///< by body, as they are asked for
};

/// Whether a ligament binds bones of one row to each other: it goes with them.
bool is_of_row(const soft_tissue::Ligament& ligament, const cases::CaseData& data, Row row) {
  bool has_any = false;
  for (const soft_tissue::Strand& strand : ligament.strands) {
    for (const soft_tissue::Anchor& anchor : strand.anchors) {
      const auto bone = std::find_if(data.bones.begin(), data.bones.end(),
                                     [&](const auto& one) { return one.label == anchor.label; });
      if (anchor.label == 0 || bone == data.bones.end() || row_of(bone->bone) != row) return false;
      has_any = true;
    }
  }
  return has_any;
}

/// By vertex of a wall, until its sides are parted.
struct OnWall {
  std::vector<float> gap_mm;   ///< from one side to the other
  std::vector<bool> spans;     ///< of a ligament from one side to the other
  std::vector<Carried> guess;  ///< how it goes with the bones, by how near they are ...
  std::vector<float> hold;     ///< ... and how firmly it does
};

/// By how near each is, so that on one bone's cartilage a place goes with that bone alone.
Carried by_distance(const Nearest& proximal, const Nearest& distal) {
  Carried carried;
  carried.body = {proximal.body, distal.body, proximal.next_body, distal.next_body};
  const std::array<double, Carried::kMost> mm{proximal.mm, distal.mm, proximal.next_mm,
                                              distal.next_mm};
  double sum = 0;
  std::array<double, Carried::kMost> parts{};
  for (std::size_t k = 0; k < mm.size(); ++k) {
    if (k > 1 && mm[k] >= kFarMm) continue;
    parts[k] = 1 / ((mm[k] + kTouchMm) * (mm[k] + kTouchMm));
    sum += parts[k];
  }
  for (std::size_t k = 0; k < mm.size(); ++k) carried.share[k] = static_cast<float>(parts[k] / sum);
  return carried;
}

/// What lies on a bone, or is the disc, goes as that does; all else hangs between.
float hold_of(Lining lining) {
  if (lining == Lining::Disc) return 1.0F;
  return lining == Lining::Cartilage || lining == Lining::Bone ? kHold : 0.0F;
}

OnWall line(JointWall& wall,
            const cases::CaseData& data,
            const soft_tissue::SoftTissue& tissue,
            const TabledJoint& joint) {
  OnWall on;
  NearestBones bones(data);
  const Row near_row = row_of(joint.between[0]);
  const Row far_row = row_of(joint.between[1]);
  detail::LaidFibres laid = detail::lay_fibres(wall.surface, wall.lining, tissue);
  wall.fibre = std::move(laid.fibre);
  for (std::size_t i = 0; i < wall.surface.vertices.size(); ++i) {
    const Vec3& at = wall.surface.vertices[i];
    const Nearest proximal = bones.of(at, near_row);
    const Nearest distal = bones.of(at, far_row);
    const double both = proximal.mm + distal.mm;
    double share = both > 0 ? proximal.mm / both : 0.5;
    const soft_tissue::Ligament* lines = laid.ligament[i];
    bool spans = lines != nullptr;
    if (wall.lining[i] == Lining::Disc) share = 0;
    if (spans && is_of_row(*lines, data, near_row)) {
      share = 0;
      spans = false;
    } else if (spans && is_of_row(*lines, data, far_row)) {
      share = 1;
      spans = false;
    }
    wall.proximal.push_back(proximal.body);
    wall.distal.push_back(distal.body);
    wall.distal_share.push_back(static_cast<float>(share));
    on.gap_mm.push_back(static_cast<float>(both));
    on.spans.push_back(spans);
    on.guess.push_back(wall.lining[i] == Lining::Disc ? Carried{{proximal.body}, {1.0F}}
                                                      : by_distance(proximal, distal));
    on.hold.push_back(hold_of(wall.lining[i]));
  }
  return on;
}

/// About a cut all that lies between sides which nearly touch goes with its own side, and its stump
/// is smoothed down.
void take_sides(JointWall& wall, OnWall& on, std::size_t first_cut) {
  std::vector<Vec3>& vertices = wall.surface.vertices;
  std::vector<std::uint8_t> rings(vertices.size(), 0);
  std::fill(rings.begin() + static_cast<std::ptrdiff_t>(first_cut), rings.end(), 1);
  for (std::uint8_t ring = 1; ring <= kRingsAboutCut; ++ring) {
    for (const Triangle& t : wall.surface.facets) {
      if (std::none_of(t.begin(), t.end(), [&](auto v) { return rings[v] == ring; })) continue;
      for (const std::uint32_t v : t) {
        if (rings[v] != 0 || on.spans[v] || on.gap_mm[v] > kTouchingMm) continue;
        rings[v] = static_cast<std::uint8_t>(ring + 1);
        wall.distal_share[v] = std::round(wall.distal_share[v]);
        on.hold[v] = 0;
      }
    }
  }
  const mesh::Neighbours neighbours(wall.surface);
  for (int time = 0; time < kSmoothedTimes; ++time) {
    const std::vector<Vec3> before = vertices;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      if (rings[v] == 0 || rings[v] > kRingsAboutCut) continue;
      Vec3 sum;
      for (const std::uint32_t n : neighbours.of(v)) sum += before[n];
      vertices[v] = sum * (1.0 / static_cast<double>(neighbours.of(v).size()));
    }
  }
}

/// Where forearm and row, or the rows, touch as scanned the space has a bridge, which the opened
/// joint would draw out to a peg: no tissue is there.
void part(JointWall& wall, OnWall& on) {
  const std::size_t count = wall.surface.vertices.size();
  mesh::PartedBridges parted =
      mesh::part_bridges(wall.surface.vertices, wall.surface.facets, wall.distal_share,
                         [&](std::uint32_t v) { return on.spans[v]; });
  wall.parted = parted.bridges;
  wall.surface.facets = std::move(parted.facets);
  for (const mesh::CutVertex& c : parted.cuts) {
    const Vec3 a = wall.surface.vertices[c.a];
    wall.surface.vertices.push_back(a + (wall.surface.vertices[c.b] - a) * c.share);
    wall.lining.push_back(wall.lining[c.a]);
    wall.fibre.push_back(wall.fibre[c.a]);
    wall.proximal.push_back(wall.proximal[c.a]);
    wall.distal.push_back(wall.distal[c.a]);
    wall.distal_share.push_back(std::round(wall.distal_share[c.a]));
    on.guess.push_back(on.guess[c.a]);
    on.hold.push_back(0);
  }
  take_sides(wall, on, count);
}

JointWall wall_of(const cases::CaseData& data,
                  const soft_tissue::SoftTissue& tissue,
                  const soft_tissue::Space& space,
                  const TabledJoint& joint) {
  JointWall wall;
  wall.joint = joint.id;
  wall.surface = space.surface;
  wall.lining = space.lining;
  OnWall on = line(wall, data, tissue, joint);
  part(wall, on);
  wall.carried = detail::carry_wall(wall.surface, on.guess, on.hold);
  return wall;
}

using BodyMotion = Pose<frame::Patient, frame::Bone>;

/// The wall's vertices where these motions of the case's bones lay them, as a page does.
std::vector<Vec3> laid(const JointWall& wall, const std::vector<BodyMotion>& motions) {
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < wall.surface.vertices.size(); ++i) {
    const Point<frame::Bone> at{wall.surface.vertices[i]};
    const Carried& with = wall.carried[i];
    Vec3 place;
    for (std::size_t k = 0; k < Carried::kMost; ++k) {
      if (with.share[k] > 0) {
        place += (motions[with.body[k]] * at).v * static_cast<double>(with.share[k]);
      }
    }
    places.push_back(place);
  }
  return places;
}

/// As scanned, pulled at most, and so with the proximal row's bones apart as torn ligaments let
/// them.
std::array<std::vector<Vec3>, 3> states_of(const cases::CaseData& data, const JointWall& wall) {
  anatomy::HandPose pulled = data.hand_motion.scan;
  pulled.traction_n = PortalTable::generic().traction_n;
  std::vector<BodyMotion> opened;
  std::vector<BodyMotion> parted;
  const cases::Bone* lunate = cases::find_bone(data, BoneId::Lunate, BonePart::Whole);
  for (const cases::Bone& bone : data.bones) {
    opened.push_back(cases::pose_under_block(data.hand_motion, bone.bone, pulled));
    parted.push_back(opened.back());
    if (lunate == nullptr || bone.bone == BoneId::Lunate) continue;
    if (row_of(bone.bone) != Row::Proximal) continue;
    const Vec3 away =
        bounds_of(bone.surface.vertices).centre() - bounds_of(lunate->surface.vertices).centre();
    parted.back().translation += normalized_or(away, {}) * kPartedMm;
  }
  return {wall.surface.vertices, laid(wall, opened), laid(wall, parted)};
}

template <typename T>
void keep_only(std::vector<T>& values, const std::vector<std::uint32_t>& kept) {
  std::vector<T> left;
  for (const std::uint32_t v : kept) left.push_back(values[v]);
  values = std::move(left);
}

/// So few facets as are drawn in time. What is flat in the scan may be drawn out when the joint
/// opens: simplified by its scanned shape alone the wall stood before the scope in spikes.
void simplify(JointWall& wall, const cases::CaseData& data) {
  const auto states = states_of(data, wall);
  mesh::InStates fewer = mesh::simplify_in_states(wall.surface.facets, states, kMostFacets);
  wall.surface.facets = std::move(fewer.facets);
  wall.simplified_by_mm = fewer.error_mm;
  keep_only(wall.surface.vertices, fewer.kept);
  keep_only(wall.lining, fewer.kept);
  keep_only(wall.fibre, fewer.kept);
  keep_only(wall.proximal, fewer.kept);
  keep_only(wall.distal, fewer.kept);
  keep_only(wall.distal_share, fewer.kept);
  keep_only(wall.carried, fewer.kept);
}

}  // namespace

std::vector<JointWall> make_joint_walls(const cases::CaseData& data,
                                        const soft_tissue::SoftTissue& tissue) {
  std::vector<JointWall> walls;
  for (const TabledJoint& joint : PortalTable::generic().joints) {
    for (const soft_tissue::Space& space : tissue.spaces) {
      if (space.id == joint.id && !space.surface.facets.empty()) {
        walls.push_back(wall_of(data, tissue, space, joint));
        simplify(walls.back(), data);
      }
    }
  }
  return walls;
}

}  // namespace carpus::arthroscopy
