// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What `carpus collide` is told in words: poses, velocities, methods.
#pragma once

#include <string>

#include "cli/collide_report.hpp"
#include "survey/methods.hpp"

namespace carpus::cli {

/// "x,y,z" or "x,y,z,qw,qx,qy,qz" [mm, unit quaternion to within 1e-3]; empty is identity.
/// @throws UsageError naming the option and what is wrong.
[[nodiscard]] Placement parse_pose(const std::string& option, const std::string& text);

/// "x,y,z", finite. @throws UsageError
[[nodiscard]] Vec3 parse_vector(const std::string& option, const std::string& text);

/// @throws UsageError naming methods whose names are near.
[[nodiscard]] const survey::Method& method_named(const std::string& name);

}  // namespace carpus::cli
