// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Holds the mushroom switch (22 mm) on the board. Printed on its face; screwed down from above at both sides.
include <numbers.scad>
use <shapes.scad>

size = 48;
height = 34;
wall = 3;
difference() {
  union() {
    linear_extrude(height) rounded(4) square(size, center = true);
    for (x = [-29, 29]) translate([x - 8, -8, 0]) cube([16, 16, height]);
  }
  translate([0, 0, wall]) linear_extrude(height) square(size - 2 * wall, center = true);
  hole(22.4);
  // Screws 4 x 16, their heads 8 mm above the board.
  for (x = [-30.5, 30.5]) { hole(m4, [x, 0]); translate([x, 0, -1]) cylinder(d = 9, h = height - 7, $fn = 24); }
  // Its cable.
  translate([0, size / 2, height]) rotate([90, 0, 0]) cylinder(d = 9, h = 20, center = true, $fn = 24);
}
