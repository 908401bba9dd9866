// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How far it is from within to outside.
#pragma once

#include <optional>

#include "geometry/mesh_in.hpp"
#include "geometry/vec3.hpp"

namespace carpus::arthroscopy::detail {

/// Where a line from within goes through the skin for the last time, in lengths of `way`; none
/// where there is no skin.
[[nodiscard]] std::optional<double> way_to_skin(const MeshIn<frame::Patient>& skin,
                                                const Vec3& from,
                                                const Vec3& way);

}  // namespace carpus::arthroscopy::detail
