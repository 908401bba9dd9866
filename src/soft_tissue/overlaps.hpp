// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which tissues of a case lie in each other, and how deep: ligaments, disc and cartilage by their
// closed surfaces, tendons, arteries and nerves by their tubes. Spaces are not asked: they hold
// cartilage, and ligaments lie within the capsule that bounds them.
#pragma once

#include <vector>

#include "cases/case_data.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::soft_tissue {

/// More than this in bone or in another tissue is a fault [mm].
inline constexpr double kDeepestMm = 0.1;

/// Every pair that lies in each other by more than `least_mm`, the deepest first. The depth is that
/// of the deepest place of one's surface in the other, or of a tube in what it runs along; sampled
/// four times a mm, so that a place between the samples may lie deeper by up to 0.13 mm.
/// Runs through parallel_for, the same bits on any number of threads.
[[nodiscard]] std::vector<Overlap> overlaps_of(const SoftTissue& tissue,
                                               const cases::CaseData& data,
                                               double least_mm = kDeepestMm);

/// How deep two closed surfaces lie in each other [mm]; 0 where they do not.
[[nodiscard]] double depth_between(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace carpus::soft_tissue
