// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// On the board: the post rises inwards, away from the screws' side.
include <numbers.scad>
use <socket_outline.scad>

socket(0, [[-18, -14], [-18, 14], [-32, 0]]);
