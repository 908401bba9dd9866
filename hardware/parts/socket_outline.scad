// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What holds a post: a flange with three M4, and a sleeve that leans to +x as it rises, its foot at x = `out`.
include <numbers.scad>
use <shapes.scad>

flange = 6;
lean = atan((post_foot_radius - post_radius) / (plate_top - plate_thickness - 2 * flange - board_top));

module socket(out, screws) {
  difference() {
    union() {
      linear_extrude(flange) hull() {
        translate([out, 0]) circle(14);
        for (p = screws) translate(p) circle(7);
      }
      difference() {
        translate([out, 0, flange]) rotate([0, lean, 0]) translate([0, 0, -8]) cylinder(d = post + 7, h = post_depth + 8);
        translate([-100, -50, -20]) cube([200, 100, 20]);
      }
    }
    translate([out, 0, flange]) rotate([0, lean, 0]) {
      cylinder(d = post + 2 * fit, h = 100);
      // A screw through wall and tube.
      translate([0, 0, post_depth / 2]) rotate([90, 0, 0]) cylinder(d = m4, h = 60, center = true, $fn = 24);
    }
    for (p = screws) { hole(m4, p); translate([p[0], p[1], flange]) cylinder(d = 8.5, h = 50, $fn = 24); }
  }
}
