// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a case holds: one patient's wrist, ready to operate on. Plain values; folders and files are
// case_io's business.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "cases/arthroscopic_map.hpp"
#include "cases/hand_motion.hpp"
#include "cases/lesson.hpp"
#include "cases/prepared_pathology.hpp"
#include "cases/structures.hpp"
#include "geometry/convex_polytope.hpp"
#include "geometry/grid.hpp"
#include "geometry/mesh_in.hpp"
#include "geometry/pose.hpp"

namespace carpus::cases {

/// Schema of the case folder that this program writes; it reads this one and older ones.
inline constexpr int kCaseSchemaVersion = 2;

/// One bone, or one part of a broken one.
struct Bone {
  BoneId bone = BoneId::Radius;
  BonePart part = BonePart::Whole;
  std::uint8_t label = 0;       ///< its value in CaseData::labels
  MeshIn<frame::Bone> surface;  ///< closed, outward; Bone is Patient as scanned [mm]
  ConvexPolytope hull;          ///< of the surface's vertices, same frame
  Grid<float>
      distance_field;  ///< signed distance to the surface [mm], negative inside, clamped to a band
  /// Where the bone is now, relative to where it was scanned; identity until a posture moves it.
  Pose<frame::Patient, frame::Bone> patient_from_bone;
};

/// A line along which the screw should lie, with both ends on the bone's surface, frame Patient
/// [mm].
struct AxisSegment {
  Vec3 proximal;  ///< where the line enters at the proximal pole
  Vec3 distal;    ///< where it leaves at the distal pole
};

/// What the score measures against (docs/scoring.md). Frame Patient as scanned, which is where the
/// scaphoid stays in every posture.
struct ScaphoidLandmarks {
  AxisSegment central_axis;      ///< axis of the widest cylinder that fits inside the bone
  double central_radius_mm = 0;  ///< that cylinder's radius
  AxisSegment longest_line;      ///< the longest straight line through the bone, reported beside it
  Vec3 waist;                    ///< point of the central axis where the bone is narrowest
};

/// A scaphoid whose pieces lie apart as scanned, put together again: its pieces' faces meet.
struct ReducedScaphoid {
  ScaphoidLandmarks marks;  ///< of the bone so, frame Bone of the proximal piece
  Pose<frame::Bone, frame::Bone> proximal_from_distal;
};

/// Where a case comes from and how it was made.
struct Provenance {
  bool simulated =
      false;            ///< true for anything not scanned from a person; shown wherever it is used
  std::string source;   ///< what was read, in words; never a path or a patient's name
  std::string made_by;  ///< program and version
  std::string made_at;  ///< UTC, ISO 8601
  /// What was taken by convention when the scan was read (scaling, order of slices and axes), in
  /// words; empty in cases of older programs.
  std::vector<std::string> conventions;
  /// Of which case a person corrected the bones: its folder's name, where that is plain (letters,
  /// digits, hyphens); empty where it is no version of another.
  std::string version_of{};
};

/// One patient's wrist. `ct`, `labels` and surfaces share the Patient frame.
struct CaseData {
  std::string pseudonym;  ///< e.g. "demo wrist"
  Side side = Side::Left;
  Provenance provenance;
  Pose<frame::Wrist, frame::Patient> wrist_from_patient;  ///< rigid, never a reflection
  Grid<std::int16_t> ct;                                  ///< HU
  Grid<std::uint8_t> labels;                              ///< see anatomy/bone_id.hpp
  std::vector<Bone> bones;                                ///< in the order of their labels
  MeshIn<frame::Patient>
      skin;  ///< as scanned [mm]; may be empty, may be open at the field of view's ends
  ScaphoidLandmarks scaphoid;
  /// Where it is to be reduced first; found when a case is opened (reduced_scaphoid.hpp).
  std::optional<ReducedScaphoid> reduced;
  std::optional<Lesson> lesson;  ///< from its own file; none where nobody wrote one
  /// From its own file; none: what is wrong is left to each examination's seed.
  std::optional<PreparedPathology> pathology;
  /// Where the bones are for any way the hand is held; empty in a case of an older program until
  /// ensure_hand_motion (make_hand_motion.hpp).
  HandMotion hand_motion;
  /// Tendons, arteries and nerves, generated; none in a case of an older program.
  std::vector<Structure> structures;
  /// Portals, tour and walls of the joint, made of the generated soft tissue when a case is opened;
  /// none in a case without it.
  std::shared_ptr<const ArthroscopicMap> arthroscopy;
};

/// The bone or part with this name, or nullptr.
[[nodiscard]] const Bone* find_bone(const CaseData& data,
                                    BoneId bone,
                                    BonePart part = BonePart::Whole) noexcept;

/// The parts that make up the scaphoid: one whole, or proximal and distal.
[[nodiscard]] std::vector<const Bone*> scaphoid_parts(const CaseData& data);

}  // namespace carpus::cases
