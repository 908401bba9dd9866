// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How the wall of a joint goes with the bones as they move: on a bone with that one alone, between
// bones as a skin that is stretched from each to the next.
#pragma once

#include <span>
#include <vector>

#include "arthroscopy/carried.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::arthroscopy::detail {

/// @param surface  closed, oriented
/// @param guess    by vertex; of one on a bone how it goes
/// @param hold     by vertex how firmly it keeps to that, 0 to 1, rather than to the mean of its
/// neighbours. Where all are 0 the shares are harmonic: of all ways to go over from bone to bone
/// that which stretches least.
[[nodiscard]] std::vector<Carried> carry_wall(const TriangleMesh& surface,
                                              std::span<const Carried> guess,
                                              std::span<const float> hold);

}  // namespace carpus::arthroscopy::detail
