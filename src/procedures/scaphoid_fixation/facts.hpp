// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is known of a scaphoid fixation before any item of its score is graded.
#pragma once

#include <optional>
#include <vector>

#include "cases/case_data.hpp"
#include "procedure/operation_record.hpp"
#include "procedure/procedure.hpp"
#include "procedure/score.hpp"
#include "procedures/scaphoid_fixation/placement.hpp"

namespace carpus::procedures::scaphoid_fixation {

/// A way of fixing the scaphoid, as the score has to know it.
struct Fixation {
  const procedure::Procedure* procedure = nullptr;
  Approach approach = Approach::FromProximal;
};

struct Facts {
  const cases::CaseData& data;
  const procedure::OperationRecord& record;
  const Fixation& fixation;
  std::vector<instruments::InstrumentIndex> screws;  ///< on the tray
  /// Of the bone as it lies at the end, seen from the piece in which the line is fixed; as scanned
  /// where there is no line.
  cases::ScaphoidLandmarks marks;
  /// The wire for the screw: the last laid into the scaphoid that fits a screw's bore; the screw's
  /// own line where the wire is out.
  std::optional<procedure::LineFacts> wire;
  std::optional<procedure::LineFacts> screw;  ///< the last that went into the scaphoid
  std::optional<LinePlacement> line;
  std::optional<ScrewPlacement> placed;
  unsigned wire_passes = 0;     ///< of wires into bone
  std::vector<BoneId> entered;  ///< other bones, allowed or not, without repetition
};

/// Intersects lines with the scaphoid; about 0.5 s, 1 s where its pieces were moved.
/// @param data  as scanned; needs `scaphoid` and `bones`.
[[nodiscard]] Facts facts_of(const cases::CaseData& data,
                             const procedure::OperationRecord& record,
                             const Fixation& fixation);

/// The line along which the fixation lies: the screw's, else the wire's.
[[nodiscard]] const std::optional<procedure::LineFacts>& fixed_line(const Facts& facts) noexcept;

/// Longest screw on the tray for that line; its place in `facts.screws`, -1 where none fits.
[[nodiscard]] int ideal_screw_of(const Facts& facts);

/// Lengths, names and the picture; the verdict and the items are graded from the measures.
[[nodiscard]] procedure::ScoreReport references_of(const Facts& facts);

}  // namespace carpus::procedures::scaphoid_fixation
