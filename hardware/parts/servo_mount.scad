// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Drive A: holds a standard servo (40 x 20 mm) upright, its spline on the leg's axis.
include <numbers.scad>
use <shapes.scad>

thickness = 5;
difference() {
  union() {
    linear_extrude(thickness) rounded(3) translate([-15, plate_top]) square([30, 63]);
    translate([-15, plate_top, 0]) cube([30, 6, 22]);
    for (x = [-15, 11]) translate([x, plate_top, 0]) rotate([90, 0, 90]) linear_extrude(4)
      polygon([[0, 0], [22, 0], [0, 22]]);
  }
  // The servo's body: its spline is 10 mm from one end.
  translate([-10.25, -10.3, -1]) cube([20.5, 41, thickness + 2]);
  translate([-10.25, -10.3, thickness - 0.01]) cube([20.5, 41, 40]);
  for (x = [-5, 5], y = [-14.4, 34.9]) hole(m4, [x, y]);
  for (x = [-10, 5]) translate([x, plate_top - 1, 13]) rotate([-90, 0, 0]) cylinder(d = m4_insert, h = 20, $fn = 24);
}
