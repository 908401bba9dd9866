// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The plate that all stands on: three petals between the slots in which legs (and drive B's sectors) swing. 195 x 190 mm.
include <numbers.scad>
use <shapes.scad>

edge = 87;

module each_leg() { for (i = [0:2]) rotate(120 * i) children(); }

module outline() {
  hull() each_leg() {
    for (y = [-44, 44]) translate([edge - 6, y]) circle(6);
    rotate(60) translate([corner_radius, 0]) circle(14);
  }
}

module slot() {
  // Leg, dog, sector, and the elastic cord beside the leg.
  // The platform's rods come as near as 84.6 mm to the middle where the tip is high.
  translate([82.5, -60]) square([40, 120]);
  hull() { translate([26 + 10, 0]) circle(10); translate([edge + 40, -10]) square(20); }
}

linear_extrude(plate_thickness) difference() {
  outline();
  each_leg() {
    slot();
    translate([base_radius, 0]) {
      for (x = [-12, 4], y = [15, 27]) translate([x, y]) circle(d = m4, $fn = 24);              // bearing block
      for (x = [-10, 2]) translate([x, 60]) circle(d = m4, $fn = 24);                             // potentiometer
      for (x = [-10, 5]) translate([x, -39]) circle(d = m4, $fn = 24);                          // servo
      for (x = [-37, -25]) translate([x, 37]) circle(d = m4, $fn = 24);                          // motor
    }
    rotate(60) translate([corner_radius, 0]) for (p = [[-16, -14], [-16, 14], [4, 0]]) translate(p) circle(d = m4, $fn = 24);
  }
  circle(d = 16);
}
