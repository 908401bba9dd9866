// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The tool's shaft (6 mm) turns in it; above, the sensor that sees its roll. Printed head down.
include <numbers.scad>
use <shapes.scad>

head = 3;
above = 22;  // from the gimbal's centre to the head
below = 8;
difference() {
  union() {
    linear_extrude(head) rounded(3) square(26, center = true);
    translate([0, 0, head]) cylinder(r1 = 10, r2 = 6.5, h = 3.5);
    cylinder(r = 6.5, h = head + above + below);
  }
  hole(tool_shaft + 2 * fit);
  for (side = [0, 180]) rotate(side) translate([6.51, 0, head + above]) rotate([0, -90, 0]) cylinder(d1 = 3, d2 = 0.4, h = 2, $fn = 24);
  for (x = [-8.5, 8.5], y = [-8.5, 8.5]) hole(2.2, [x, y]);  // the sensor's board: M2, 17 mm
}
