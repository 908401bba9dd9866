// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A wrist on a bench: a moment turns its hand, ligaments are cut one after another, and what the
// bones do is read off. A measuring bench like traction.hpp's, not the mechanics of an exercise.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "soft_tissue/sectioning_table.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::soft_tissue {

/// Turn of a body from the scan: its rotation vector in the Wrist frame of a left wrist [deg].
struct BodyTurn {
  double twist_deg = 0;
  double flexion_deg = 0;
  double radial_deviation_deg = 0;

  [[nodiscard]] double along(const BenchDirection& d) const noexcept {
    return d.flexes * flexion_deg + d.deviates_radially * radial_deviation_deg;
  }
};

/// The wrist at rest under what is done to its hand.
struct RestingWrist {
  double moment_nm = 0;
  BodyTurn hand;  ///< with capitate and the rest of the distal row
  BodyTurn scaphoid;
  BodyTurn lunate;
  BodyTurn triquetrum;
  /// By how much scaphoid and lunate lie farther apart than in the scan, along the strands of
  /// their own ligament as the lunate carries them (cut or not), in the mean; negative is nearer.
  double gap_mm = 0;
  double left_n = 0;    ///< greatest force left on a body
  double left_nmm = 0;  ///< greatest moment left on a body
  bool is_settled = false;

  [[nodiscard]] double sl_angle_deg() const noexcept {  ///< change from the scan
    return scaphoid.flexion_deg - lunate.flexion_deg;
  }
};

/// Up to the full moment, by equal steps of it.
struct MomentCurve {
  std::string direction;
  std::vector<RestingWrist> steps;
  double range_deg = 0;             ///< the hand's turn along the direction at the full moment
  double stiffness_nm_per_deg = 0;  ///< over the last quarter of the moment
};

struct HeldWrist {
  std::string position;
  RestingWrist wrist;
};

struct SectionedWrist {
  std::string cut;
  std::vector<MomentCurve> curves;  ///< in the table's order
  std::vector<HeldWrist> held;      ///< in the table's order
};

struct SectioningResult {
  std::vector<SectionedWrist> wrists;  ///< in the order of the table's cuts
  /// How much longer than in the scan each line of the table's capsule gets before it pulls.
  std::vector<double> capsule_slack_mm;
  std::size_t rests = 0;
  std::size_t unsettled = 0;  ///< of the rests
  double worst_left_n = 0;    ///< of the settled ones
  double worst_left_nmm = 0;
};

/// Scaphoid, lunate, triquetrum with pisiform, and the hand as rigid bodies that are free in all
/// six ways; strands that only pull, held where they touch a bone on their way; joint surfaces that
/// only push; a press along the forearm. Led from rest to rest by small steps of the moment, or of
/// the position at which the hand is held. A scaphoid in pieces is one body.
/// @param data  needs distance fields, a capitate, and the ligaments of the table's capsule.
/// @throws InvalidInput naming what is missing.
/// Pure, the same bits for any number of threads; about a second a cut.
[[nodiscard]] SectioningResult section(const cases::CaseData& data,
                                       const SoftTissue& tissue,
                                       const SectioningTable& table);

}  // namespace carpus::soft_tissue
