// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Clipped about the tool's shaft between portal and handle, it holds the tip in the middle of the workspace: there
// drive B is switched on and calibrated. Printed portal side down.
include <numbers.scad>
use <shapes.scad>

frame_top = portal_z + 4.5;        // silicone's upper half and the frame
handle_end = centre_z - 9 - 44;    // as the handle is clamped on the shaft
cup = 3;
height = handle_end - frame_top;
difference() {
  union() {
    cylinder(d = 20, h = height);
    translate([0, 0, height]) cylinder(d = 20, h = cup);
  }
  translate([0, 0, height]) cylinder(d = 14.6, h = cup + 1);
  hole(tool_shaft + 2 * 0.3);
  translate([0, -(tool_shaft + 0.6) / 2, -1]) cube([20, tool_shaft + 0.6, height + cup + 2]);
}
