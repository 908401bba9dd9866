// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Lays each bone of the generic wrist on the patient's own, so that it takes along what is told
// relative to it.
#pragma once

#include <array>
#include <optional>

#include "anatomy/bone_fit.hpp"
#include "cases/case_data.hpp"

namespace carpus::cases {

struct LaidModel {
  /// Of the whole wrist, by its radius.
  anatomy::Similarity wrist;
  /// By kAllBones; empty where the bone is missing, was not asked for, or could not be laid on.
  std::array<std::optional<anatomy::BoneFit>, kBoneCount> bones;
};

/// Each bone starts from where the wrist's frame puts it, and about its own middle with the hand
/// held in several ways; the best is kept. A broken bone is laid on both its parts.
/// @param is_needed  by kAllBones.
/// Runs through parallel_for, the same bits on any number of threads; about a second for all.
[[nodiscard]] LaidModel lay_model(const CaseData& data,
                                  const std::array<bool, kBoneCount>& is_needed);

}  // namespace carpus::cases
