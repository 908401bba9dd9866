// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Drive B: the leg with the capstan's sector. The cord lies on the rim, one turn after the other; its ends are held by
// screws behind the rim's ends.
include <numbers.scad>
use <shapes.scad>
use <leg_outline.scad>

face = sector_radius - cord / 2;
first = drum_angle + least_angle - sector_margin;
last = drum_angle + most_angle + sector_margin;
width = 8;

module wedge(radius, from, to) {
  polygon(concat([[0, 0]], [for (i = [0:24]) let (a = from + (to - from) * i / 24) 2 * radius * [cos(a), sin(a)]]));
}
module arc(inner, outer, from, to) {
  intersection() {
    difference() { circle(outer, $fn = 180); circle(inner, $fn = 90); }
    wedge(outer, from, to);
  }
}

difference() {
  union() {
    linear_extrude(leg_thickness) leg_outline();
    linear_extrude(width) difference() {
      union() {
        arc(face - 6, face, first, last);
        for (a = [first + 7, (first + last) / 2, last - 7]) rotate(a) translate([10, -3.5]) square([face - 11, 7]);
      }
      circle(8);
    }
  }
  clamp_screw();
  translate([-30, -0.75, -1]) cube([30 - 8, 1.5, 20]);
  // The cord's ends: through the rim, under a screw.
  for (a = [first + 7, last - 7]) rotate(a) { hole(2.8, [face - 11, 0]); translate([face - 9, 0, width / 2]) rotate([0, 90, 0]) cylinder(d = 1.4, h = 20, $fn = 12); }
}
