// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Under a corner of the plate: the post leaves beside it, outwards. Its origin is the corner.
include <numbers.scad>
use <socket_outline.scad>

socket(post_radius - corner_radius, [[-16, -14], [-16, 14], [4, 0]]);
