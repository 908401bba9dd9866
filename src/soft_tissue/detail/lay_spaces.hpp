// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The spaces of the joints, closed by capsule and synovium: morphological closing pair by pair.
#pragma once

#include <string>
#include <vector>

#include "soft_tissue/detail/lay_ligaments.hpp"

namespace carpus::soft_tissue::detail {

struct SpaceInput {
  const TissueTable* table = nullptr;
  const CarriedModel* model = nullptr;
  const Surroundings* bones = nullptr;
  const std::vector<LaidLigament>* ligaments = nullptr;
  const Sheet* disc = nullptr;  ///< nullptr where there is none
  const std::vector<Cartilage>* cartilage = nullptr;
};

/// One of the table's spaces; an empty surface where its bones are missing.
[[nodiscard]] Space lay_space(const TabledSpace& tabled, const SpaceInput& input);

}  // namespace carpus::soft_tissue::detail
