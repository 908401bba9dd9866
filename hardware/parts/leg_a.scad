// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Drive A: the leg with its dog, which moves freely in the fork's slot. Printed dog upwards.
include <numbers.scad>
use <leg_outline.scad>

difference() {
  union() {
    linear_extrude(leg_thickness) leg_outline();
    // Closed towards the fork, so that the dog does not yield with the clamp.
    translate([0, 0, leg_thickness]) linear_extrude(6) intersection() { circle(12.5); square([25, 8], center = true); }
  }
  clamp_screw();
  translate([-30, -0.75, leg_thickness - 0.01]) cube([19, 1.5, 8]);
}
