// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A net thinned from a triangle sheet that lies on one body: the disc.
#pragma once

#include "geometry/triangle_mesh.hpp"
#include "yielding/net.hpp"

namespace carpus::yielding {

/// How stiff it is [E where nothing else is said].
struct SheetMaterial {
  double along_n_per_mm = 6.0;         ///< of a spring between neighbours
  double foundation_n_per_mm2 = 0.05;  ///< of what lies under a mm2 of it
  /// More than it weighs, so that a tick's small steps resolve its springs; against a hand it is
  /// nothing still.
  double mass_g_per_mm2 = 0.4;
  double damping_per_s = 60.0;
};

/// Where it has come off what holds it, foundation and rim: within `radius_mm` of a line.
struct ComeOff {
  Vec3 from;
  Vec3 to;
  double radius_mm = 0;
  double left_share = 1;    ///< of the foundation and of the springs there
  double rests_off_mm = 0;  ///< by how much it stands off there
};

/// Particles about `spacing_mm` apart on the sheet; those nearer than that to its rim are held.
/// @param sheet  its middle, turned one way all over. @param towards  the side that is touched.
/// @param come_off  nullptr: nowhere
[[nodiscard]] Net net_of_sheet(const TriangleMesh& sheet,
                               const Vec3& towards,
                               const SheetMaterial& material,
                               double spacing_mm,
                               const ComeOff* come_off = nullptr);

}  // namespace carpus::yielding
