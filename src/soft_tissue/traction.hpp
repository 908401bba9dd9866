// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Traction by finger traps, at rest: how far strands, slack and joint surfaces let the wrist open.
// A measuring bench for stiffness and slack, not the mechanics of an exercise.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "cases/case_data.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::soft_tissue {

struct TractionOptions {
  double force_n = 98;
  /// Of every strand, times the table's.
  double stiffness_factor = 1;
  /// How much longer than in the scan a strand gets before it pulls [mm].
  double radiocarpal_slack_mm = 0;        ///< groups radiocarpal and ulnocarpal
  double midcarpal_slack_mm = 0;          ///< group midcarpal
  std::vector<std::string_view> without;  ///< beginnings of ids of cut ligaments
};

struct StrandForce {
  std::string id;
  double newtons = 0;  ///< sum of the ligament's strands
};

/// Openings are shifts along the traction, which pulls along the forearm, of a body's middle: of
/// the proximal row's against the forearm, and of the hand's against that.
struct TractionResult {
  double radiocarpal_mm = 0;
  double midcarpal_mm = 0;
  double unbalanced_n = 0;          ///< greatest force left on a body
  std::vector<StrandForce> forces;  ///< greatest first
};

/// Scaphoid, lunate, triquetrum with pisiform, and the hand (held against turning) as rigid bodies;
/// strands that only pull, as polylines through their anchors; joint surfaces that only push. The
/// energy's minimum, by its exact gradient.
/// @param data  needs distance fields. Pure, the same bits each time; about a second.
[[nodiscard]] TractionResult pull(const cases::CaseData& data,
                                  const SoftTissue& tissue,
                                  const TractionOptions& options);

/// Slacks with which a pull opens both joints as asked; other options as given.
[[nodiscard]] TractionOptions fit_slack(const cases::CaseData& data,
                                        const SoftTissue& tissue,
                                        TractionOptions options,
                                        double radiocarpal_mm,
                                        double midcarpal_mm);

}  // namespace carpus::soft_tissue
