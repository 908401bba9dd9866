// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Two 608 bearings for a leg's shaft. Its back is round about the axis: the calibration gauge sits on it.
include <numbers.scad>
use <shapes.scad>

length = 24;
seat = 22 + 2 * 0.05;

difference() {
  union() {
    linear_extrude(length) hull() {
      circle(15);
      translate([-16, plate_top]) square([32, 8]);
      translate([-15, -10]) square([30, 10]);
    }
    // The mast, on the side away from the leg: the gauge sits before it.
    linear_extrude(14) hull() { translate([mast_x - 5, 0]) square(10); translate([mast_x, mast_z]) circle(5); }
  }
  translate([mast_x, mast_z, -1]) cylinder(d = 2.6, h = 30, $fn = 16);  // M3 x 30, to the leg
  translate([0, 0, -0.01]) cylinder(d = seat, h = 7);
  translate([0, 0, 6.98]) cylinder(d1 = seat, d2 = 13, h = 4.6);  // a cone: no roof to support
  cylinder(d = 13, h = length);
  translate([0, 0, length - 7]) cylinder(d = seat, h = 10);
  // Inserts from below, where the plate is.
  for (x = [-12, 4], z = [6, 18]) translate([x, plate_top - 0.01, z]) rotate([-90, 0, 0]) cylinder(d = m4_insert, h = 9, $fn = 24);
}
