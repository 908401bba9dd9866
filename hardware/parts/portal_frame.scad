// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Presses a sheet of silicone rubber (3 mm, a slit at each portal) on the wrist shell's ridge.
include <numbers.scad>
use <shapes.scad>

portals = [[0, 0], [11, 2], [20, 3], [2, 11], [13, 12]];
linear_extrude(3) difference() {
  translate([9, 7]) rounded(4) square([46, 44], center = true);
  for (p = portals) translate(p) circle(d = 10, $fn = 24);
  for (x = [-11, 29], y = [-12, 26]) translate([x, y]) circle(d = m3, $fn = 16);
}
