// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What both legs have: the hub on its 8 mm shaft with a clamp, the arm, the elbow with its stud. In the plane of the leg.
include <numbers.scad>
use <shapes.scad>

module leg_outline() {
  difference() {
    union() {
      circle(13);
      hull() { circle(9); translate([upper_arm, 0]) circle(6.5); }
      hull() { translate([-13, -1]) circle(5); circle(9); }  // the clamp's lips
    }
    circle(d = 8 + 2 * 0.05);
    translate([-30, -0.75]) square([30, 1.5]);
    translate([upper_arm, 0]) circle(d = m4, $fn = 24);
    translate([60, 0]) circle(d = 3.1, $fn = 24);             // the calibration gauge's pin
    translate([spring_on_leg, 0]) circle(d = m3, $fn = 16);
    hull() for (x = [38, 50]) translate([x, 0]) circle(3.2, $fn = 24);
  }
}

// The clamp's M3 screw, across the lips.
module clamp_screw() { translate([-14, 0, leg_thickness / 2]) rotate([90, 0, 0]) cylinder(d = m3, h = 60, center = true, $fn = 24); }
