// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How the pieces of a displaced bone have to be led, in words.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "anatomy/reduction.hpp"
#include "cases/case_data.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::session {

/// A bone in two pieces.
struct BrokenBone {
  std::size_t first = 0;  ///< its place in CaseData::bones
  std::size_t second = 0;
  anatomy::Reduction faces;
};

/// Of the bone that a procedure operates on; nothing where it is whole, or its faces are not found.
[[nodiscard]] std::optional<BrokenBone> broken_bone_of(const cases::CaseData& data, BoneId target);

/// "Lead the distal part of the scaphoid 2 mm ulnar; turn its fracture face 12° more dorsal.", of
/// the second piece towards the first, in the hand's own directions; that they meet where they lie
/// within 1 mm and 7 degrees.
[[nodiscard]] std::string reduction_hint(const cases::CaseData& data,
                                         const BrokenBone& broken,
                                         const simulation::Snapshot& now);

}  // namespace carpus::session
