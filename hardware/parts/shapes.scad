// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Shapes that several parts share. Parts are modelled as they are printed: flat side on z = 0.

// A hole through everything along z.
module hole(diameter, at = [0, 0]) { translate([at[0], at[1], -100]) cylinder(d = diameter, h = 400, $fn = 24); }

// A hole that is printed lying: a drop, so that its roof needs no support. Along z; the tip points to +y.
module drop(diameter) {
  circle(d = diameter, $fn = 24);
  polygon([[-diameter / 2 * cos(45), diameter / 2 * sin(45)], [0, diameter / 2 * sqrt(2) * 0.92], [diameter / 2 * cos(45), diameter / 2 * sin(45)]]);
}

// A hole along x through a standing wall, at (y, z).
module lying_hole_x(diameter, y, z, length = 400) {
  translate([-length / 2, y, z]) rotate([90, 0, 90]) linear_extrude(length) drop(diameter);
}
module lying_hole_y(diameter, x, z, from = -200, length = 400) {
  translate([x, from + length, z]) rotate([90, 0, 0]) linear_extrude(length) drop(diameter);
}

// Both where corners are round.
module rounded(radius) { offset(r = radius, $fn = 24) offset(delta = -radius) children(); }
