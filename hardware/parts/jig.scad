// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Two pairs of seats for balls: a rod's length apart, for gluing rods, and a stud's, for bonding balls to studs.
include <numbers.scad>

depth = 3.5;
difference() {
  translate([-92, -26, 0]) cube([184, 40, 14]);
  for (x = [-rod / 2, rod / 2]) translate([x, 0, 14 + ball / 2 - depth]) sphere(d = ball + 0.1, $fn = 32);
  for (x = [-half_pair, half_pair]) translate([x, -17, 14 + ball / 2 - depth]) sphere(d = ball + 0.1, $fn = 32);
  // Room for the magnets' holders, and for the leg or platform in which a stud sits.
  translate([-rod / 2 + 7, -9, 6]) cube([rod - 14, 18, 20]);
  translate([-half_pair + 5.5, -23.5, 8]) cube([2 * half_pair - 11, leg_thickness + 1, 20]);
}
