// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Landmark by the radius's own surface -> skin mark by the table -> of the ways in near there,
// clear of nerves and arteries where there is such a one, that of most worth: room between the
// pulled bones, less what it costs in tendon, off the mark and past what lies ahead -> depth of the
// capsule by the joint's space. Points: bone of the joint's wall, a ligament's course, the disc.
#include "arthroscopy/make_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <tuple>

#include "arthroscopy/opened_space.hpp"
#include "arthroscopy/portal_table.hpp"
#include "cases/joint_under_block.hpp"
#include "cases/laid_structures.hpp"
#include "fields/distance_field.hpp"
#include "fields/triangle_tree.hpp"
#include "geometry/segment_distance.hpp"

namespace carpus::arthroscopy {
namespace {

using soft_tissue::Lining;
using soft_tissue::SoftTissue;
using soft_tissue::Space;

constexpr double kRadPerDeg = 3.14159265358979323846 / 180;
constexpr double kStepMm = 0.25;
/// Before the capsule bones leave a scope so much: a hand is not led as straight as a line [E].
constexpr double kBeforeRoomMm = 1.4;
constexpr double kFarStepMm = 0.5;  // where the joint is not near
/// A way is followed from so far outside its mark, which lies as deep as the bone that is felt.
constexpr double kOverMarkMm = 9.0;
constexpr double kTiltStepDeg = 5;  // both steps twice as long for what the tour does without
constexpr double kSearchStepMm = 0.5;
/// A nerve or an artery is to lie so far from a way: a tip slips into its hole 2.5 mm beside it
/// [E].
constexpr double kVitalClearMm = 2.5;
/// Of ways that cut as deep to so much the roomier is taken [E].
constexpr double kCutStepMm = 0.5;
constexpr double kRounding = 1e-3;  // of such a step: distances are true to rounding
/// Twice what a scope takes up: more room is worth nothing [E].
constexpr double kEnoughRoomMm = 2.0;
/// Room for which a mark a millimetre farther off is taken [E].
constexpr double kPerMmOff = 0.03;
constexpr double kPerMmTendon = 0.6;   // and for one into a tendon, which is spread aside [E]
constexpr double kPerMmPast = 0.4;     // and for one past what the portal is to look at first [E]
constexpr double kPerDegLeant = 0.02;  // and for a degree [E]
/// A place between two bones so much nearer to both is taken for each mm away from the usual [E].
constexpr double kPerMmAside = 0.15;
/// A scope's tip looks about from so far beyond the capsule at least [E]; farther in, where the
/// convex row lies nearer to the radius, bone stops it.
constexpr double kWorkingMm = 4.0;
constexpr double kLeastWayMm = 3.0;
constexpr double kFarMm = 4.0;
/// Two holes of 2.5 mm each (simulation) that do not touch, from the capsule to outside: nearer to
/// each other a scope could not tell by which it goes in [E]. The tour's portals keep so far apart
/// where there is room, the others always.
constexpr double kApartMm = 5.5;
constexpr double kOutsideMm = 20.0;
/// Skin over the dorsal capsule where the case has no skin [E].
constexpr double kSkinOverCapsuleMm = 8.0;
/// Cartilage of this joint: so near to the wall of its space.
constexpr double kOnWallMm = 0.6;
constexpr double kThinnestMm = 0.05;
/// From the capsule outwards: beyond the skin lies nothing.
constexpr double kToOutsideMm = 30.0;

/// The case in the frame of a left wrist of the generic size.
class Wrist {
 public:
  Wrist(const cases::CaseData& data, double size)
      : to_patient_(data.wrist_from_patient.inverse()),
        from_patient_(data.wrist_from_patient),
        size_(size),
        mirror_(data.side == Side::Left ? 1.0 : -1.0) {}

  [[nodiscard]] Vec3 point(const Vec3& left) const {
    return (to_patient_ * Point<frame::Wrist>{Vec3{left.x, left.y * mirror_, left.z} * size_}).v;
  }
  [[nodiscard]] Vec3 way(const Vec3& left) const {
    return (to_patient_ * Direction<frame::Wrist>{Vec3{left.x, left.y * mirror_, left.z}}).v;
  }
  [[nodiscard]] Vec3 left_of(const Vec3& point) const {
    const Vec3 w = (from_patient_ * Point<frame::Patient>{point}).v / size_;
    return {w.x, w.y * mirror_, w.z};
  }

 private:
  Pose<frame::Patient, frame::Wrist> to_patient_;
  Pose<frame::Wrist, frame::Patient> from_patient_;
  double size_;
  double mirror_;
};

/// The bones as the hand is pulled: how far they are, where each has gone.
class PulledBones {
 public:
  PulledBones(const cases::CaseData& data, double traction_n) : data_(data), structures_(data) {
    anatomy::HandPose pose = data.hand_motion.scan;
    pose.traction_n = traction_n;
    std::vector<Pose<frame::Patient, frame::Bone>> poses;
    for (const cases::Bone& bone : data.bones) {
      poses.push_back(cases::pose_under_block(data.hand_motion, bone.bone, pose));
      from_patient_.push_back(poses.back().inverse());
    }
    structures_.follow(poses);
  }
  [[nodiscard]] const Pose<frame::Bone, frame::Patient>& inverse(std::uint8_t body) const {
    return from_patient_[body];
  }
  /// What of a kind lies nearest to a way, from its capsule to outside.
  [[nodiscard]] std::optional<cases::BesideWay> beside(anatomy::StructureKind kind,
                                                       const Vec3& capsule,
                                                       const Vec3& inwards) const {
    std::optional<cases::BesideWay> nearest;
    for (std::size_t i = 0; i < structures_.size(); ++i) {
      if (data_.structures[i].kind != kind) continue;
      const double mm = structures_.gap_mm(i, capsule, capsule - inwards * kToOutsideMm);
      if (!nearest || mm < nearest->mm) nearest = cases::BesideWay{i, mm};
    }
    return nearest;
  }
  /// Whether a way passes this structure on the side to which `along` points; so where there is
  /// none.
  [[nodiscard]] bool is_beyond(const std::string& structure,
                               const Vec3& along,
                               const Vec3& capsule,
                               const Vec3& inwards) const {
    for (std::size_t i = 0; i < structures_.size(); ++i) {
      if (data_.structures[i].id != structure) continue;
      double least = kToOutsideMm;
      double side = 0;
      for (const Vec3& p : structures_.course(i)) {
        const double out = std::clamp(dot(capsule - p, inwards), 0.0, kToOutsideMm);
        const Vec3 off = capsule - inwards * out - p;
        if (length(off) >= least) continue;
        least = length(off);
        side = dot(off, along);
      }
      return side >= 0;
    }
    return true;
  }
  /// By how much a way comes nearer than `clear_mm` to any of these kinds, roughly; 0 for none.
  [[nodiscard]] double cut_mm(std::span<const anatomy::StructureKind> kinds,
                              double clear_mm,
                              const Vec3& capsule,
                              const Vec3& inwards) const {
    double least = clear_mm;
    for (std::size_t i = 0; i < structures_.size(); ++i) {
      if (std::find(kinds.begin(), kinds.end(), data_.structures[i].kind) == kinds.end()) continue;
      least = structures_.gap_mm(i, capsule, capsule - inwards * kToOutsideMm, least);
    }
    return std::max(0.0, std::ceil((clear_mm - least) / kCutStepMm - kRounding)) * kCutStepMm;
  }
  /// Least distance to any of them.
  [[nodiscard]] double distance_mm(const Vec3& point) const {
    double least = kFarMm;
    for (std::size_t b = 0; b < data_.bones.size(); ++b) {
      const Vec3 local = (from_patient_[b] * Point<frame::Patient>{point}).v;
      if (data_.bones[b].distance_field.values().empty()) continue;
      const fields::DistanceSample s =
          fields::sample_distance(data_.bones[b].distance_field, local);
      if (s.is_inside_grid) least = std::min(least, s.distance_mm);
    }
    return least;
  }

 private:
  const cases::CaseData& data_;
  std::vector<Pose<frame::Bone, frame::Patient>> from_patient_;
  cases::LaidStructures structures_;
};

const Space* space_of(const SoftTissue& tissue, const std::string& id) {
  for (const Space& space : tissue.spaces) {
    if (space.id == id && !space.surface.facets.empty()) return &space;
  }
  return nullptr;
}

/// Lister's tubercle: the most dorsal point of the radius where the generic one has it.
std::optional<Vec3> lister_of(const cases::CaseData& data, const Wrist& wrist) {
  const cases::Bone* radius = cases::find_bone(data, BoneId::Radius);
  if (radius == nullptr) return std::nullopt;
  std::optional<Vec3> best;
  for (const Vec3& v : radius->surface.vertices) {
    const Vec3 at = wrist.left_of(v);
    if (at.x < 1 || at.x > 12 || at.y < -4.5 || at.y > 4.5 || at.z > 0) continue;
    if (!best || at.z < best->z) best = at;
  }
  return best;
}

/// A forearm bone's styloid: its most distal point.
std::optional<Vec3> styloid_of(const cases::CaseData& data, const Wrist& wrist, BoneId id) {
  const cases::Bone* bone = cases::find_bone(data, id);
  if (bone == nullptr) return std::nullopt;
  std::optional<Vec3> best;
  for (const Vec3& v : bone->surface.vertices) {
    const Vec3 at = wrist.left_of(v);
    if (!best || at.x < best->x) best = at;
  }
  return best;
}

/// Where a line from within goes through the skin for the last time; none where there is no skin.
std::optional<double> way_to_skin(const MeshIn<frame::Patient>& skin,
                                  const Vec3& from,
                                  const Vec3& way) {
  std::optional<double> farthest;
  for (const Triangle& f : skin.facets) {
    const Vec3& a = skin.vertices[f[0]];
    const Vec3 ab = skin.vertices[f[1]] - a;
    const Vec3 ac = skin.vertices[f[2]] - a;
    const Vec3 p = cross(way, ac);
    const double det = dot(ab, p);
    if (det == 0) continue;
    const Vec3 s = from - a;
    const double u = dot(s, p) / det;
    const Vec3 q = cross(s, ab);
    const double v = dot(way, q) / det;
    const double t = dot(ac, q) / det;
    if (u < 0 || v < 0 || u + v > 1 || t < 0) continue;
    if (!farthest || t > *farthest) farthest = t;
  }
  return farthest;
}

/// The wall of one joint's space, with the body nearest to each of its vertices.
struct Walls {
  const Space* space = nullptr;
  fields::TriangleTree tree;
  std::vector<std::uint8_t> nearest;
};

struct WayIn {
  Vec3 capsule;
  Vec3 inwards;
  double room_mm = 0;
};

/// From the capsule to the working depth along a line: how thick a tip goes there; none where it is
/// less than `stop_below_mm`, which is found out sooner.
std::optional<WayIn> way_in(const cases::JointSpace& joint,
                            const PulledBones& bones,
                            const Vec3& from,
                            const Vec3& inwards,
                            double stop_below_mm) {
  std::optional<WayIn> way;
  double in = 0;
  double step = kStepMm;
  for (double s = 0; s < 30; s += step) {
    const Vec3 p = from + inwards * s;
    const OpenedSpace wall =
        opened_space_at(joint.wall, bones.inverse(joint.proximal), bones.inverse(joint.distal), p);
    const bool is_in = wall.is_near && wall.distance_mm < 0;
    step = wall.is_near ? kStepMm : kFarStepMm;
    if (!way) {
      if (!is_in && bones.distance_mm(p) < kBeforeRoomMm) return std::nullopt;  // bone is before it
      if (!is_in) continue;
      way = WayIn{p, inwards, kFarMm};
    }
    if (!is_in || in > kWorkingMm) break;
    way->room_mm = std::min(way->room_mm, bones.distance_mm(p));
    if (way->room_mm < stop_below_mm) return std::nullopt;
    in += kStepMm;
  }
  // A line that leaves the space at once only grazes it.
  if (way && in < kLeastWayMm) way.reset();
  return way;
}

class MapMaker {
 public:
  MapMaker(const cases::CaseData& data, const SoftTissue& tissue)
      : data_(data),
        tissue_(tissue),
        table_(PortalTable::generic()),
        wrist_(data, tissue.size),
        bones_(data, table_.traction_n) {
    map_.forearm = body_of(BoneId::Radius).value_or(0);
    map_.disc = tissue.disc.body;
    map_.disc_sheet = tissue.disc.middle;
    map_.distal = wrist_.way({-1, 0, 0});
  }

  cases::ArthroscopicMap make() {
    take_joints();
    place_portals();
    for (std::uint8_t j = 0; j < map_.joints.size(); ++j) {
      if (!is_reached(j)) map_.problems.push_back(map_.joints[j].name + ": no portal leads there");
    }
    if (map_.portals.empty()) return std::move(map_);
    place_points();
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
                             fields::build_distance_field(space->surface, {0.4, kFarMm}), *proximal,
                             *distal});
      Walls walls{space, fields::TriangleTree(space->surface), {}};
      for (const Vec3& v : space->surface.vertices) walls.nearest.push_back(nearest_body(v));
      walls_.push_back(std::move(walls));
    }
  }

  [[nodiscard]] std::optional<std::uint8_t> joint_of(const std::string& id) const {
    for (std::uint8_t j = 0; j < map_.joints.size(); ++j) {
      if (map_.joints[j].id == id) return j;
    }
    return std::nullopt;
  }

  [[nodiscard]] bool is_reached(std::uint8_t joint) const {
    return std::any_of(map_.portals.begin(), map_.portals.end(),
                       [&](const cases::Portal& portal) { return portal.joint == joint; });
  }

  void place_portals() {
    const std::optional<Vec3> lister = lister_of(data_, wrist_);
    if (!lister) {
      map_.problems.emplace_back("there is no radius to feel Lister's tubercle on");
      return;
    }
    std::vector<std::pair<std::string, Vec3>> marks{{"lister", *lister}};
    const auto radial = styloid_of(data_, wrist_, BoneId::Radius);
    if (radial) marks.emplace_back("radial_styloid", *radial);
    const auto ulnar = styloid_of(data_, wrist_, BoneId::Ulna);
    if (ulnar) marks.emplace_back("ulnar_styloid", *ulnar);
    for (const TabledPortal& portal : table_.portals) {
      const auto mark = std::find_if(marks.begin(), marks.end(),
                                     [&](const auto& m) { return m.first == portal.from; });
      if (mark == marks.end()) {
        map_.problems.push_back(portal.name + ": " + portal.from + " was not found");
        continue;
      }
      const auto joint = joint_of(portal.joint);
      if (!joint) continue;  // named already
      const Vec3 nominal = mark->second + Vec3{-portal.distal_mm, portal.ulnar_mm, portal.volar_mm};
      if (const std::optional<Vec3> at = place(portal, *joint, nominal))
        marks.emplace_back(portal.id, *at);
    }
  }

  /// A way in that was tried; the greater is the better.
  struct Tried {
    WayIn way;
    Vec3 mark;               ///< in the frame of the generic wrist
    double off_mm = 0;       ///< of the usual place
    double leant_deg = 0;    ///< about the forearm, of the usual way
    double past_mm = 0;      ///< what lies ahead
    bool is_apart = true;    ///< from the portals before it
    bool is_between = true;  ///< the structures that it belongs between
    /// Too near to a nerve or an artery by so much, and into a tendon.
    std::array<double, 2> cut_mm{};

    [[nodiscard]] bool has_room() const { return way.room_mm >= kLeastRoomMm; }
    /// Of two ways with much the same room the one nearer to the usual.
    [[nodiscard]] double value() const {
      return std::min(way.room_mm, kEnoughRoomMm) - kPerMmOff * off_mm - kPerDegLeant * leant_deg -
             kPerMmTendon * cut_mm[1] - kPerMmPast * past_mm;
    }
    [[nodiscard]] bool operator<(const Tried& other) const {
      return std::tuple(has_room(), is_apart, is_between, -cut_mm[0], value()) <
             std::tuple(other.has_room(), other.is_apart, other.is_between, -other.cut_mm[0],
                        other.value());
    }
  };

  [[nodiscard]] std::optional<Tried> best_way(const TabledPortal& portal,
                                              const cases::JointSpace& joint,
                                              const Vec3& nominal) const {
    using anatomy::StructureKind;
    static constexpr std::array kVital{StructureKind::Nerve, StructureKind::Artery};
    static constexpr std::array kSpread{StructureKind::Tendon};
    std::optional<Tried> best;
    const double middle_rad = (portal.ulnar_deg[0] + portal.ulnar_deg[1]) / 2 * kRadPerDeg;
    const Vec3 across{0, std::cos(middle_rad), -std::sin(middle_rad)};
    const Vec3 before = Vec3{0, std::sin(middle_rad), std::cos(middle_rad)} * -kOverMarkMm;
    const double step_mm = portal.is_usual ? kSearchStepMm : 2 * kSearchStepMm;
    const std::optional<Vec3> ahead = under_traction(portal.ahead);
    for (const auto& [tilt, turn] : ways_of(portal)) {
      const Vec3 inwards = wrist_.way(
          {std::sin(tilt), std::cos(tilt) * std::sin(turn), std::cos(tilt) * std::cos(turn)});
      for (double x = -portal.search_mm[0]; x <= portal.search_mm[0]; x += step_mm) {
        for (double y = -portal.search_mm[1]; y <= portal.search_mm[1]; y += step_mm) {
          const Vec3 mark = nominal + Vec3{x, 0, 0} + across * y;
          const auto way = way_in(joint, bones_, wrist_.point(mark + before), inwards,
                                  best && best->has_room() ? kLeastRoomMm : 0.0);
          if (!way) continue;
          const bool is_apart = !shares_hole(*way);
          if (!is_apart && !portal.is_usual) continue;
          Tried tried{*way,
                      mark,
                      std::hypot(x, y),
                      std::abs(turn - middle_rad) / kRadPerDeg,
                      ahead ? past_mm(*way, *ahead) : 0.0,
                      is_apart};
          if (tried.has_room()) {
            const Vec3 along = wrist_.way(across);
            tried.is_between = bones_.is_beyond(portal.between[0], along, way->capsule, inwards) &&
                               (portal.between[1].empty() ||
                                bones_.is_beyond(portal.between[1], -along, way->capsule, inwards));
            tried.cut_mm = {bones_.cut_mm(kVital, kVitalClearMm, way->capsule, inwards),
                            bones_.cut_mm(kSpread, kLeastRoomMm, way->capsule, inwards)};
          }
          if (!best || *best < tried) best = tried;
        }
      }
    }
    return best;
  }

  /// Where a point of the tour lies as the hand is pulled.
  [[nodiscard]] std::optional<Vec3> under_traction(const std::string& id) const {
    for (const TabledPoint& point : table_.points) {
      const auto joint = joint_of(point.joint);
      if (point.id != id || !joint) continue;
      const std::optional<Vec3> at = place_of(point, walls_[*joint]);
      if (!at) return std::nullopt;
      return (bones_.inverse(nearest_body(*at)).inverse() * Point<frame::Bone>{*at}).v;
    }
    return std::nullopt;
  }

  [[nodiscard]] static double past_mm(const WayIn& way, const Vec3& point) {
    const Vec3 to = point - way.capsule;
    return length(to - way.inwards * std::max(0.0, dot(to, way.inwards)));
  }

  /// Whether it would share a hole with a portal that has been placed.
  [[nodiscard]] bool shares_hole(const WayIn& way) const {
    return std::any_of(taken_.begin(), taken_.end(), [&](const WayIn& other) {
      return segment_distance(way.capsule, way.capsule - way.inwards * kOutsideMm, other.capsule,
                              other.capsule - other.inwards * kOutsideMm) < kApartMm;
    });
  }

  /// Every lean of a way in that is tried: towards the forearm, about it [rad].
  [[nodiscard]] static std::vector<std::array<double, 2>> ways_of(const TabledPortal& portal) {
    std::vector<std::array<double, 2>> ways;
    const double step = portal.is_usual ? kTiltStepDeg : 2 * kTiltStepDeg;
    for (double deg = portal.proximal_deg[0]; deg <= portal.proximal_deg[1]; deg += step) {
      for (double turn = portal.ulnar_deg[0]; turn <= portal.ulnar_deg[1]; turn += step) {
        ways.push_back({deg * kRadPerDeg, turn * kRadPerDeg});
      }
    }
    return ways;
  }

  /// @return where it was placed, in the frame of the generic wrist.
  std::optional<Vec3> place(const TabledPortal& portal, std::uint8_t in, const Vec3& nominal) {
    const cases::JointSpace& joint = map_.joints[in];
    const std::optional<Tried> best = best_way(portal, joint, nominal);
    if (!best || !best->has_room()) {
      map_.problems.push_back(portal.name +
                              ": no room between the bones, apart from the other portals" +
                              (best ? " (" + millimetres(best->way.room_mm) + ")" : std::string()));
      return std::nullopt;
    }
    cases::Portal placed;
    placed.id = portal.id;
    placed.name = portal.name;
    placed.landmarks = portal.landmarks;
    placed.number = static_cast<std::uint8_t>(&portal - table_.portals.data());
    placed.is_usual = portal.is_usual;
    placed.joint = in;
    placed.body = joint.proximal;  // which carries it from where it was found under traction
    const auto& as_scanned = bones_.inverse(placed.body);
    const Vec3 capsule = (as_scanned * Point<frame::Patient>{best->way.capsule}).v;
    placed.inwards = (as_scanned * Direction<frame::Patient>{best->way.inwards}).v;
    placed.capsule_mm =
        way_to_skin(data_.skin, capsule, -placed.inwards).value_or(kSkinOverCapsuleMm);
    placed.skin = capsule - placed.inwards * placed.capsule_mm;
    placed.room_mm = best->way.room_mm;
    for (std::size_t kind = 0; kind < placed.beside.size(); ++kind) {
      placed.beside[kind] = bones_.beside(static_cast<anatomy::StructureKind>(kind),
                                          best->way.capsule, best->way.inwards);
    }
    if (!best->is_apart) {
      map_.problems.push_back(portal.name + ": its hole lies beside another portal's");
    }
    if (!best->is_between) {
      map_.problems.push_back(portal.name + ": no room in its interval between tendons");
    }
    say_what_is_cut(placed);
    map_.portals.push_back(placed);
    taken_.push_back(best->way);
    return best->mark;
  }

  /// No way near the landmark is clear: said, for the portal is used all the same.
  void say_what_is_cut(const cases::Portal& portal) {
    for (const auto& beside : portal.beside) {
      if (!beside || beside->mm >= kLeastRoomMm) continue;
      map_.problems.push_back(portal.name + ": a scope on its way reaches " +
                              millimetres(kLeastRoomMm - beside->mm) + " into the " +
                              data_.structures[beside->structure].name);
    }
  }

  [[nodiscard]] static std::string millimetres(double mm) {
    return std::to_string(mm).substr(0, 4) + " mm";
  }

  /// The vertex of the joint's wall nearest to a point: of this lining, and beside this body, where
  /// they are asked for.
  [[nodiscard]] std::optional<Vec3> on_wall(const Walls& walls,
                                            const Vec3& point,
                                            std::optional<Lining> lining,
                                            std::optional<std::uint8_t> body = std::nullopt) const {
    const std::vector<Vec3>& vertices = walls.space->surface.vertices;
    std::optional<Vec3> best;
    double least = 1e18;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (lining && walls.space->lining[i] != *lining) continue;
      const double far = squared_length(vertices[i] - point);
      if (far < least && (!body || walls.nearest[i] == *body)) {
        least = far;
        best = vertices[i];
      }
    }
    return best;
  }

  /// The bone's body; of a broken one the part on the joint's side, proximal.
  [[nodiscard]] std::optional<std::uint8_t> body_at(BoneId bone) const {
    const cases::Bone* found = cases::find_bone(data_, bone);
    if (found == nullptr) found = cases::find_bone(data_, bone, BonePart::Proximal);
    if (found == nullptr) return std::nullopt;
    return static_cast<std::uint8_t>(found - data_.bones.data());
  }

  /// Where two bones' surfaces come nearest to the joint's wall at once, not far from a place.
  [[nodiscard]] std::optional<Vec3> between(const Walls& walls,
                                            const std::array<BoneId, 2>& bones,
                                            const Vec3& near) const {
    std::optional<Vec3> best;
    double least = 1e18;
    for (const Vec3& v : walls.space->surface.vertices) {
      double cost = kPerMmAside * distance(v, near);
      for (const BoneId bone : bones) cost += distance_to(bone, v);
      if (cost >= least) continue;
      least = cost;
      best = v;
    }
    for (const BoneId bone : bones) {
      if (best && distance_to(bone, *best) >= kFarMm) return std::nullopt;
    }
    return best;
  }

  /// To the nearest part of it; kFarMm where it is farther or missing.
  [[nodiscard]] double distance_to(BoneId id, const Vec3& point) const {
    double least = kFarMm;
    for (const cases::Bone& bone : data_.bones) {
      if (bone.bone != id || bone.distance_field.values().empty()) continue;
      const auto s = fields::sample_distance(bone.distance_field, point);
      if (s.is_inside_grid) least = std::min(least, s.distance_mm);
    }
    return least;
  }

  [[nodiscard]] std::optional<Vec3> place_of(const TabledPoint& point, const Walls& walls) const {
    if (point.on) {
      const auto body = body_at(*point.on);
      if (!body) return std::nullopt;
      // Where no other bone or disc came near in any posture, cartilage was not made.
      const Vec3 near = wrist_.point(point.at);
      const auto cartilage = on_wall(walls, near, Lining::Cartilage, body);
      return cartilage ? cartilage : on_wall(walls, near, std::nullopt, body);
    }
    if (point.between) return between(walls, *point.between, wrist_.point(point.at));
    if (point.is_place) return on_wall(walls, wrist_.point(point.at), std::nullopt);
    if (point.is_disc) {
      if (tissue_.disc.middle.vertices.empty()) return std::nullopt;
      Vec3 sum;
      for (const Vec3& v : tissue_.disc.middle.vertices) sum += v;
      return on_wall(walls, sum / static_cast<double>(tissue_.disc.middle.vertices.size()),
                     Lining::Disc);
    }
    for (const soft_tissue::Ligament& l : tissue_.ligaments) {
      if (l.id != point.ligament || l.strands.empty()) continue;
      const std::vector<Vec3>& course = l.strands[l.strands.size() / 2].course;
      const double at = point.fraction * static_cast<double>(course.size() - 1);
      return on_wall(walls, course[static_cast<std::size_t>(at + 0.5)], std::nullopt);
    }
    return std::nullopt;
  }

  [[nodiscard]] std::uint8_t nearest_body(const Vec3& point) const {
    std::uint8_t best = 0;
    double least = 1e18;
    for (std::size_t b = 0; b < data_.bones.size(); ++b) {
      if (data_.bones[b].distance_field.values().empty()) continue;
      const auto s = fields::sample_distance(data_.bones[b].distance_field, point);
      if (s.is_inside_grid && s.distance_mm < least) {
        least = s.distance_mm;
        best = static_cast<std::uint8_t>(b);
      }
    }
    return best;
  }

  void place_points() {
    for (const TabledPoint& point : table_.points) {
      const auto joint = joint_of(point.joint);
      if (!joint || !is_reached(*joint)) continue;  // the joint is named already
      const std::optional<Vec3> at = place_of(point, walls_[*joint]);
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
      placed.body = lies_on_disc(walls_[*joint], *at) ? map_.forearm : nearest_body(*at);
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

  /// The disc goes with the forearm, whatever bone is nearest.
  [[nodiscard]] static bool lies_on_disc(const Walls& walls, const Vec3& at) {
    const std::vector<Vec3>& vertices = walls.space->surface.vertices;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (vertices[i] == at) return walls.space->lining[i] == Lining::Disc;
    }
    return false;
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
  Wrist wrist_;
  PulledBones bones_;
  std::vector<Walls> walls_;  ///< by joint
  std::vector<WayIn> taken_;  ///< by the portals that were placed, under traction
  cases::ArthroscopicMap map_;
};

}  // namespace

cases::ArthroscopicMap make_map(const cases::CaseData& data, const SoftTissue& tissue) {
  return MapMaker(data, tissue).make();
}

}  // namespace carpus::arthroscopy
