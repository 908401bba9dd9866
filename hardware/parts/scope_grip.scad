// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The dummy arthroscope's camera head: pushed over the carrier's lower end and held by a set screw, it does not turn
// with the shaft. The hand holds it level.
include <numbers.scad>
use <shapes.scad>

difference() {
  linear_extrude(26) rounded(5) square([26, 20], center = true);
  translate([0, 0, 18]) cylinder(d = 13 + 2 * fit, h = 10);
  hole(tool_shaft + 2 * 0.4);
  translate([0, 0, 22]) rotate([0, 90, 0]) cylinder(d = 2.6, h = 20, $fn = 16);
  for (y = [-10, 10], z = [4 : 4 : 16]) translate([-20, y, z]) rotate([0, 90, 0]) cylinder(r = 0.8, h = 40, $fn = 8);
}
