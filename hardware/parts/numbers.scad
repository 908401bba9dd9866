// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Lengths [mm] and angles [degrees] of the arm, revision 1. What the program computes with as well is marked; those are
// held to it by hardware/workshop/numbers_test.cpp. Frame of a leg: x outwards from its axis, y along the axis, z up.

// --- as the program has them (firmware/core/delta.hpp, src/arm) ---
upper_arm = 80;
rod = 160;
offset = 45;           // radius of the legs' axes less that of the platform's joints
least_angle = -58;     // of a leg below the horizontal
most_angle = 78.3;
slot_gap = 9;          // drive A: from the middle of the slot to its edge
capstan_ratio = 10;    // drive B
tool_length = 125;     // from the gimbal's centre to the tip
portal_z = -230;
centre_z = -130;       // of the workspace

gauge_first = -40;     // notches of the calibration gauge
gauge_step = 20;
gauge_last = 60;

// --- of the mechanism ---
platform_radius = 26;
base_radius = offset + platform_radius;
ball = 12;             // diameter, on a stud of 4 mm: thicker ones would meet the magnet when a rod leans
magnet = 10;           // outer diameter of the rings, 4 inside, 5 high
magnet_hole = 4;
magnet_height = 5;
magnet_recess = 3;     // in its holder
half_pair = 22;        // of two parallel rods
plate_top = -24;       // below the legs' axes
plate_thickness = 8;
leg_thickness = 12;
board_top = -310;
corner_radius = 90;    // the plate's corners
post_radius = 115;     // where the posts leave it: the platform's corners pass inside
post_foot_radius = 165;
post = 16;             // tube
post_depth = 26;       // in its socket
// An elastic cord from each leg to its bearing block's mast carries most of the weight. At spring_length between the two
// it pulls with spring_tension [N], farther apart spring_rate [N/mm] more.
spring_length = 30;
spring_tension = 1.3;
spring_rate = 0.03;
spring_on_leg = 30;    // from the leg's axis
mast_x = 5;            // where the cord hangs, outwards of the axis and above it
mast_z = 58;
sector_radius = 45;    // effective, with half the cord
cord = 0.5;
drum_angle = 115;      // where the drum lies, above the outward horizontal
drum_radius = sector_radius / capstan_ratio;
sector_margin = 8;
tool_shaft = 6;

// --- of printing ---
fit = 0.15;            // a hole that a part slides into is wider by this on each side
m3 = 3.3;              // holes that a screw passes
m4 = 4.4;
m5 = 5.2;
m3_insert = 4.0;       // heat-set
m4_insert = 5.6;
$fn = 48;
