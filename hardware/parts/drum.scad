// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Drive B: the capstan's drum on the bell of a 2804 motor (slots for M2 from 14.4 to 16 mm across). Two flat turns of cord.
include <numbers.scad>
use <shapes.scad>

radius = drum_radius - cord / 2;
difference() {
  union() {
    cylinder(d = 20, h = 2.5);
    translate([0, 0, 2.5]) cylinder(r1 = 6.5, r2 = radius, h = 1.5);
    cylinder(r = radius, h = 14.5);
    translate([0, 0, 13]) cylinder(r1 = radius, r2 = radius + 1.5, h = 1.5);
  }
  for (turn = [0 : 90 : 270]) rotate(turn) hull() { hole(2.2, [7.2, 0]); hole(2.2, [8, 0]); }
  hole(2.2);
  translate([0, 0, 8]) rotate([90, 0, 0]) cylinder(d = 1, h = 20, $fn = 12);
}
