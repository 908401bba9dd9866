// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Turns about the platform's y on two points and bears the inner axis, x, on two more.
include <numbers.scad>
use <shapes.scad>

height = 7;
difference() {
  cylinder(r = 17, h = height);
  translate([0, 0, -1]) cylinder(r = 11.5, h = height + 2);
  // M3 set screws of the inner axis cut their thread here.
  lying_hole_x(2.6, 0, height / 2);
  // The outer screws' points.
  for (side = [0, 180]) rotate(side) translate([0, 17.01, height / 2]) rotate([90, 0, 0]) cylinder(d1 = 3, d2 = 0.4, h = 2, $fn = 24);
}
