// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The items that scores of scaphoid fixation share. Limits are those of docs/scoring.md; the weight
// is the procedure's.
#pragma once

#include "procedures/scaphoid_fixation/facts.hpp"

namespace carpus::procedures::scaphoid_fixation {

[[nodiscard]] procedure::ScoreItem angle_item(const Facts& facts, double points);
[[nodiscard]] procedure::ScoreItem waist_item(const Facts& facts, double points);
[[nodiscard]] procedure::ScoreItem proximal_offset_item(const Facts& facts, double points);
[[nodiscard]] procedure::ScoreItem distal_offset_item(const Facts& facts, double points);
/// Bone at the proximal end of the screw: its tail or its tip, as the approach is.
[[nodiscard]] procedure::ScoreItem proximal_cover_item(const Facts& facts, double points);
[[nodiscard]] procedure::ScoreItem distal_cover_item(const Facts& facts, double points);
[[nodiscard]] procedure::ScoreItem penetration_item(const Facts& facts, double points);
[[nodiscard]] procedure::ScoreItem length_item(const Facts& facts,
                                               const procedure::ScoreReport& report,
                                               double points);
[[nodiscard]] procedure::ScoreItem passes_item(const Facts& facts, double points);
[[nodiscard]] procedure::ScoreItem views_item(const Facts& facts, double points);
/// Bones that are neither target nor allowed.
[[nodiscard]] procedure::ScoreItem wrong_bones_item(const Facts& facts, double points);
/// Shots, dose, time and undos, in this order.
[[nodiscard]] std::vector<procedure::ScoreItem> thrift_items(const Facts& facts,
                                                             double shots,
                                                             double dose,
                                                             double time,
                                                             double undos);

}  // namespace carpus::procedures::scaphoid_fixation
