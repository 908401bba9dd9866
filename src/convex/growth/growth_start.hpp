// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the growth program begins that has nothing to go on from.
#pragma once

#include <cstdint>

#include "convex/features/feature_pair.hpp"
#include "convex/growth/proof_body.hpp"
#include "convex/relative_pose.hpp"

namespace carpus::convex {

/// From a face of each body, say where the line of origins leaves it, to a face of one of them and
/// the vertex of the other that lies deepest behind it, on to the face over this vertex, and so on
/// as long as the bound of t that they give rises: features that all but touch, or are a few steps
/// from those that do. Faces are the graphs'.
[[nodiscard]] FeaturePair features_from_faces(const ProofBody& first,
                                              const ProofBody& second,
                                              const RelativePose& pose,
                                              std::uint32_t in_first,
                                              std::uint32_t in_second) noexcept;

}  // namespace carpus::convex
