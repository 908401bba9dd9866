// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The two languages of a pair: rows of the growth program, and the features of the bodies that they
// stand for. Two faces of a body are an edge, three faces a vertex; an optimal basis is two edges,
// or a vertex and a face.
#pragma once

#include <cstdint>

#include "convex/exact_meeting.hpp"
#include "convex/features/feature_pair.hpp"
#include "convex/growth/growth_memory.hpp"
#include "convex/growth/proof_body.hpp"
#include "convex/relative_pose.hpp"

namespace carpus::convex {

/// The memory's rows from a pair of features: the faces of two edges; or a face and those three of
/// the faces about a vertex whose cone holds the direction opposite to it. False, and nothing
/// changes, for a vertex with an edge or a vertex, which no basis stands for.
bool set_rows(const ProofBody& first,
              const ProofBody& second,
              const RelativePose& pose,
              const FeaturePair& pair,
              GrowthMemory& memory) noexcept;

/// What the memory's rows stand for; where faces have no common edge or vertex, a vertex near them.
/// False where a row is no face's.
[[nodiscard]] bool features_of_rows(const ProofBody& first,
                                    const ProofBody& second,
                                    const GrowthMemory& memory,
                                    FeaturePair& pair) noexcept;

/// A face of the body's graph at which the feature lies.
[[nodiscard]] std::uint32_t face_at(const ProofBody& body, const Feature& feature) noexcept;

/// Where exact arithmetic may begin.
/// @param direction  from the first body to the second, in the first's frame.
[[nodiscard]] ExactHint hint_of(const ProofBody& first,
                                const ProofBody& second,
                                const FeaturePair& pair,
                                const Vec3& direction) noexcept;

}  // namespace carpus::convex
