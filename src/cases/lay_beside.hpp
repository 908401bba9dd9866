// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Moves tendons, arteries and nerves out of the soft tissue that is made after them.
#pragma once

#include <span>

#include "cases/case_data.hpp"

namespace carpus::cases {

/// Lets the case's tubes give way to closed bodies (ligaments, cartilage), to bone and to each
/// other, under the skin; away from the bone where a body lies between it and the tube. Each point
/// keeps its share of the hand's motion. Tubes that are clear stay as they are, to the bit; what
/// there is no room for stays in something and is for the checks to tell.
/// Runs through parallel_for, the same bits on any number of threads; a second or two.
void lay_structures_beside(CaseData& data, std::span<const TriangleMesh* const> bodies);

}  // namespace carpus::cases
