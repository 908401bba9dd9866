// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Drive B: the motor above the leg's axis; behind it its encoder's board on four pillars, M2 holes 17 mm apart.
include <numbers.scad>
use <shapes.scad>

thickness = 6;
pillar = 2;
board_hole = 17 / sqrt(2);
// Seen from behind, where its foot is.
at = (sector_radius + drum_radius) * [-cos(drum_angle), sin(drum_angle)];
difference() {
  union() {
    linear_extrude(thickness) hull() { translate(at) circle(18); translate([20, plate_top]) square([24, 10]); }
    translate([20, plate_top, 0]) cube([24, 6, 22]);
    // Across the motor's screws.
    translate(at) for (turn = [0 : 90 : 270]) rotate(turn) translate([board_hole, 0, 0]) cylinder(d = 5, h = thickness + pillar, $fn = 24);
    translate([29.5, plate_top, 0]) rotate([90, 0, 90]) linear_extrude(5) polygon([[0, 0], [0, 22], [6, 22], [50, 6], [50, 0]]);
  }
  translate([at[0], at[1], -1]) cylinder(d = 9, h = 30);
  translate(at) for (turn = [0 : 90 : 270]) rotate(turn) hole(1.7, [board_hole, 0]);
  // 2804: M2 on 12 and on 16 mm; slots take both.
  translate(at) for (turn = [45 : 90 : 315]) rotate(turn) hull() { hole(2.3, [6, 0]); hole(2.3, [8.2, 0]); }
  for (x = [25, 37]) translate([x, plate_top - 1, 13]) rotate([-90, 0, 0]) cylinder(d = m4_insert, h = 9.5, $fn = 24);
  // The bearing block's shoulder.
  translate([0, 0, -1]) linear_extrude(40) circle(16);
  translate([-23, plate_top - 1, -1]) cube([40, 24, 40]);
}
