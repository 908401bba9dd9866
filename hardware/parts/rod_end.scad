// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// On either end of a rod: a ring magnet, on whose edge the ball sits, and the tube.
include <numbers.scad>
use <shapes.scad>

tube = 6;
difference() {
  union() { cylinder(d = magnet + 2.8, h = 5); translate([0, 0, 5]) cylinder(d1 = magnet + 2.8, d2 = 9.5, h = 3); cylinder(d = 9.5, h = 17); }
  translate([0, 0, -0.01]) cylinder(d = magnet + 0.1, h = magnet_recess);
  translate([0, 0, magnet_recess + 2]) cylinder(d = tube + 0.1, h = 20);
  hole(2);  // lets air and glue out
}
