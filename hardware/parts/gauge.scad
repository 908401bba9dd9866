// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Sits astride a bearing block: a pin of 3 mm through one of its holes and the leg's holds the leg at a known angle,
// as `carpus device calibrate` asks for them.
include <numbers.scad>
use <shapes.scad>

angles = [gauge_first : gauge_step : gauge_last];
difference() {
  linear_extrude(8) difference() {
    union() {
      circle(21);
      translate([-21, -14]) square([42, 14]);
      intersection() {
        difference() { circle(67); circle(52); }
        polygon(concat([[0, 0]], [for (a = [-48, -30, -10, 10, 30, 50, 68]) 140 * [cos(a), -sin(a)]]));
      }
      for (a = [-45, 0, 45]) rotate(-a) translate([14, -5]) square([42, 10]);
    }
    circle(15 + fit);
    translate([-15 - fit, -60]) square([30 + 2 * fit, 60]);
  }
  for (a = angles) rotate(-a) hole(3.1, [60, 0]);
  // As many dots as the notch is in the order in which it is asked for: the first is the highest.
  for (i = [0 : (gauge_last - gauge_first) / gauge_step], k = [0 : i])
    rotate(-gauge_first - gauge_step * i + 2.1 * (k - i / 2)) translate([54.5, 0, 7]) cylinder(d = 1.3, h = 2, $fn = 12);
}
