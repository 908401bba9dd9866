// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Drive A: from the leg's shaft (8 mm) to the potentiometer's (6.35 mm); a clamp screw at either end.
include <numbers.scad>
use <shapes.scad>

difference() {
  union() { cylinder(d = 16, h = 12.5); translate([0, -5, 0]) cube([12, 10, 12.5]); }
  translate([0, 0, -1]) cylinder(d = 8 + 0.1, h = 7.01);
  cylinder(d = 6.35 + 0.1, h = 20);
  translate([0, -0.6, -1]) cube([20, 1.2, 20]);
  for (z = [3.2, 9.8]) translate([9.3, -20, z]) rotate([-90, 0, 0]) cylinder(d = 2.2, h = 40, $fn = 16);
}
