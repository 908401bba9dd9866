// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The dummy arthroscope's light post: clamped on the shaft, it turns the view of 30 degrees about it.
include <numbers.scad>
use <shapes.scad>

difference() {
  union() {
    cylinder(r = 10, h = 9);
    hull() { translate([6, -3.5, 0]) cube([1, 7, 7]); translate([26, 0, 0]) cylinder(r = 3.5, h = 7, $fn = 24); }
    translate([26, 0, 0]) cylinder(r = 5, h = 9, $fn = 24);
    for (turn = [0 : 30 : 330]) rotate(turn) translate([10, 0, 0]) cylinder(r = 1.2, h = 9, $fn = 12);
  }
  hole(tool_shaft + 2 * fit);
  translate([0, 0, 4.5]) rotate([0, 90, 150]) cylinder(d = 2.6, h = 20, $fn = 16);
}
