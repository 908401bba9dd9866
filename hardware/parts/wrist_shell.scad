// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The back of a wrist, through which the tool passes: a flat ridge with portals (3-4, 4-5, 6R; midcarpal radial and
// ulnar), printed standing on its proximal end. x across the wrist, y up, z towards the hand; the 3-4 portal is at
// x = 0, z = first.
include <numbers.scad>
use <shapes.scad>

length = 110;
first = 40;
height = portal_z - 1.5 - board_top;  // up to the silicone, whose middle is the portal
wall = 4;
plug = 12;

// Where the portals are from 3-4 [mm]: across, towards the hand. Positions for training, no measured wrist.
portals = [[0, 0], [11, 2], [20, 3], [2, 11], [13, 12]];

module back(inset) {
  hull() {
    translate([-14 + inset, height - 6 - inset]) square([46 - 2 * inset, 6]);
    translate([-26 + inset, height - 22]) square([64 - 2 * inset, 4]);
    translate([-29 + inset, -0.01]) square([70 - 2 * inset, 12]);
  }
}
difference() {
  linear_extrude(length) {
    difference() { back(0); translate([0, -1]) back(wall); translate([-29 + wall, -1]) square([70 - 2 * wall, 14]); }
    for (x = [-43, 37]) translate([x, 0]) square([18, 5]);
  }
  for (p = portals) translate([p[0], height + 1, first + p[1]]) rotate([90, 0, 0]) cylinder(d = 8, h = 12, $fn = 24);
  // The sheet of silicone and its frame.
  for (x = [-11, 29], z = [first - 12, first + 26]) translate([x, height + 1, z]) rotate([90, 0, 0]) cylinder(d = m3_insert, h = 12, $fn = 16);
  for (x = [-36, 48], z = [15, length - 15]) translate([x, 20, z]) rotate([90, 0, 0]) cylinder(d = m4, h = 30, $fn = 24);
}
