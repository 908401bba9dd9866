// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is done to a wrist on the bench as data (data/sectioning.json): the moment, the directions,
// the ligaments that are cut, and what was published of it. Every figure carries its source or mark
// there.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "soft_tissue/tissue_table.hpp"

namespace carpus::soft_tissue {

/// A line of the capsule between places where ligaments hold.
struct CapsuleLine {
  struct End {
    std::string ligament;
    BoneId bone = BoneId::Lunate;
  };
  std::string name;
  std::array<End, 2> ends;
  double stiffness_n_per_mm = 0;
  /// How much longer than in the scan it gets before it pulls, times the wrist's size. Without one
  /// it is as long as the whole wrist's own motion asks for
  /// (SectioningTable::capsule_length_at_nm).
  std::optional<double> slack_mm;
  std::string goes_with;  ///< the ligament with which it is cut; empty: none
};

/// Of a moment, in the plane of flexion and radial deviation; of length 1.
struct BenchDirection {
  std::string id;
  double flexes = 0;
  double deviates_radially = 0;
};

/// Where a jig holds the hand, from the scan; it may still twist [deg].
struct BenchPosition {
  std::string id;
  double flexion_deg = 0;
  double radial_deviation_deg = 0;
};

struct BenchCut {
  std::string id;
  std::string name;
  std::vector<std::string> without;  ///< beginnings of ids of ligaments: "SL_" is all three parts
};

/// One published statement as one figure of ours that lies between two limits where it is reached.
struct PublishedStatement {
  enum class Kind {
    Share,         ///< of a bone's turn in the hand's, along a direction [%]
    RangeChange,   ///< of the angle at the full moment, by a cut [deg]
    RangeOver,     ///< of one direction over that of `other_place`, whole wrist [deg]
    Range,         ///< angle at the full moment [deg]
    Stiffness,     ///< over the last quarter of the moment [N m/deg]
    BoneChange,    ///< how far a cut turns a bone, the hand held at a position [deg]
    BoneFlexion,   ///< of a bone at a position over that at `other_place`, whole wrist [deg]
    SlAngleChange  ///< by a cut, the hand held at a position; scaphoid flexed on lunate [deg]
  };
  std::string id;
  Kind kind = Kind::Range;
  std::string cut;
  std::string place;  ///< direction or position
  std::string other_place;
  BoneId bone = BoneId::Scaphoid;
  Range limits;
  std::string published;  ///< in words
  std::string mark;
  bool is_fitted = false;  ///< a figure was chosen so that it comes out
  std::string why_not;     ///< why it is not reached on the demo; empty where it is
};

struct SectioningTable {
  double moment_nm = 0;
  std::size_t steps = 0;
  double press_n = 0;
  double holding_n_per_mm = 0;
  std::vector<CapsuleLine> capsule;
  double capsule_length_at_nm = 0;  ///< of lines without slack: up to which moment, every direction
  std::vector<BenchDirection> directions;
  std::vector<BenchPosition> positions;
  std::vector<BenchCut> cuts;  ///< the first cuts nothing
  std::vector<PublishedStatement> published;

  /// Reads the format of data/sectioning.json.
  /// @throws InvalidInput naming the entry where the text is no such table.
  [[nodiscard]] static SectioningTable parse(std::string_view json_text);

  /// The built-in table; parsed at the first call.
  [[nodiscard]] static const SectioningTable& generic();
};

}  // namespace carpus::soft_tissue
