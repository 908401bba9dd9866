// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture of two hulls and of what `carpus collide` found out about them.
#pragma once

#include <string>

#include "cli/collide_report.hpp"

namespace carpus::cli {

/// SVG: the first hull solid, the second translucent, seen so that the way between them (or the
/// depth) lies in the picture; on it the nearest points and the line between them, or the arrow
/// along which the second must move to part; with a sweep the second's outline at first contact.
/// Figures and a scale stand beside.
[[nodiscard]] std::string draw_collision(const CollideBody& first,
                                         const CollideBody& second,
                                         const CollideReport& report);

}  // namespace carpus::cli
