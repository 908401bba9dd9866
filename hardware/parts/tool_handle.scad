// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Clamped on the shaft below the gimbal: what the hand holds.
include <numbers.scad>
use <shapes.scad>

length = 44;
difference() {
  rotate_extrude() polygon([[0, 0], [6, 0], [7.5, 3], [8, 12], [6, 22], [6, 28], [8.5, 38], [7, 44], [0, 44]]);
  hole(tool_shaft + 2 * fit);
  for (z = [5, 38]) translate([0, 0, z]) rotate([0, 90, 0]) cylinder(d = 2.6, h = 20, $fn = 16);  // M3 set screws
}
