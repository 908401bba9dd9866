// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// For the controller's board (70 x 50 mm) beside the arm, its cables tied to the rim.
include <numbers.scad>
use <shapes.scad>

difference() {
  union() {
    linear_extrude(3) rounded(5) square([100, 64], center = true);
    for (x = [-31, 31], y = [-21, 21]) translate([x, y, 0]) cylinder(d = 8, h = 9, $fn = 24);
    translate([-50, 27, 0]) cube([100, 5, 12]);
  }
  for (x = [-31, 31], y = [-21, 21]) hole(2.6, [x, y]);
  for (x = [-44, 44], y = [-22, 22]) hole(m4, [x, y]);
  for (x = [-40 : 16 : 40]) translate([x, 0, 8]) rotate([-90, 0, 0]) linear_extrude(60) square([8, 3], center = true);
}
