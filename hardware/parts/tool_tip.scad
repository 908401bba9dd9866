// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A blunt probe's hook, or nothing worse: glued to the shaft's lower end. Nothing about it can hurt.
include <numbers.scad>
use <shapes.scad>

difference() {
  union() { cylinder(r1 = 4, r2 = 4, h = 8); translate([0, 0, 8]) cylinder(r1 = 4, r2 = 2, h = 4); translate([0, 0, 12]) sphere(2, $fn = 24); }
  translate([0, 0, -1]) cylinder(d = tool_shaft + 0.1, h = 9);
}
