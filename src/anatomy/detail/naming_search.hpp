// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The search behind bone_naming.hpp: the best assignment of bodies to bones over sides, postures
// and orientations. Private to anatomy.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "anatomy/model_shapes.hpp"
#include "anatomy/region_shape.hpp"
#include "anatomy/similarity_fit.hpp"

namespace carpus::anatomy::detail {

/// What a body that is no bone of the wrist costs: as much as a bone in a wrong place.
inline constexpr double kNamelessCost = 12.0;

/// One way to name the bodies.
struct Naming {
  double cost = 0;  ///< of all bones, missing bones and nameless bodies
  Side side = Side::Left;
  Similarity patient_from_model;
  std::array<std::optional<std::size_t>, kBoneCount> body_of_bone;  ///< order of kAllBones
  std::array<double, kBoneCount> bone_cost{};
};

/// Best naming of `bodies` as the given side, over all postures and orientations.
[[nodiscard]] Naming best_naming(std::span<const BodyShape> bodies, Side side);

/// Best naming near the orientation of `known` (within about 20 degrees), over all postures.
[[nodiscard]] Naming best_naming_near(std::span<const BodyShape> bodies, const Naming& known);

}  // namespace carpus::anatomy::detail
