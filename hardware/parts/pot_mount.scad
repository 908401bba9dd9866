// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Drive A: holds a potentiometer with a 3/8 inch bushing on the leg's axis.
include <numbers.scad>
use <shapes.scad>

thickness = 4;
difference() {
  union() {
    linear_extrude(thickness) hull() { circle(13); translate([-14, plate_top]) square([28, 6]); }
    translate([-14, plate_top, 0]) cube([28, 6, 14]);
  }
  hole(9.7);
  hole(3, [0, -7.9]);  // keeps the body from turning
  for (x = [-2, 10]) translate([x, plate_top - 1, 8]) rotate([-90, 0, 0]) cylinder(d = m4_insert, h = 20, $fn = 24);
}
