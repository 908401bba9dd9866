// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Between three studs with balls it holds the gimbal, whose centre is the arm's tip; it stays level. The gimbal's outer
// axis is the arm's y: two set screws with points, through the wall.
include <numbers.scad>
use <shapes.scad>

height = 12;
difference() {
  linear_extrude(height) difference() {
    hull() for (i = [0:2]) rotate(120 * i) for (y = [-3.5, 3.5]) translate([platform_radius, y]) circle(5.5, $fn = 24);
    circle(19);
  }
  for (i = [0:2]) rotate(120 * i) {
    lying_hole_y(m4, platform_radius, height / 2);
    // The studs' nuts.
    for (side = [-1, 1]) translate([platform_radius - 4.5, side * 9.5 - 3.5, -1]) cube([20, 7, height + 2]);
  }
  lying_hole_y(2.6, 0, height / 2);
}
