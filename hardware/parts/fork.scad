// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Drive A: the slot. Screwed to the servo's round horn; the leg's dog has slot_gap to either side, less nothing for the
// pads: 1 mm of rubber is glued to its four faces.
include <numbers.scad>
use <shapes.scad>

pad = 1;
floor = 4;

difference() {
  cylinder(r = 17, h = floor + 6.5);
  translate([0, 0, floor]) linear_extrude(10) {
    circle(6);
    // Where the dog can be, and its pads.
    for (turn = [-slot_gap : slot_gap / 9 : slot_gap]) rotate(turn) square([26.4, 8 + 2 * pad], center = true);
  }
  hole(8);  // the horn's own screw
  for (turn = [0 : 90 : 270]) rotate(turn + 45) hole(2.2, [7.2, 0]);
}
