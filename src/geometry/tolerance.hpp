// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Every tolerance of the geometric modules, with its derivation. Signs that decide topology use
// none: they are exact (geometry/predicates.hpp).
#pragma once

namespace carpus {

/// Magnitudes of coordinates for which exact answers are promised. Outside, algorithms report
/// ScaleRange. The cube of a difference of two such values still fits a double with room to spare.
inline constexpr double kLargestCoordinate = 1e100;
inline constexpr double kSmallestCoordinate = 1e-100;  ///< zero is allowed

/// Half a unit in the last place of 1.0: the relative error of one rounded operation.
inline constexpr double kRoundoff = 0x1.0p-53;

/// Relative error of the 3 x 3 determinant in orient3d against the sum of the magnitudes of its
/// products: 7 roundings a product path, and the rounding of the bound itself
/// [shewchuk1997predicates] §4.3 proves (7 + 56 u) u; rounded up to 8 u.
inline constexpr double kOrient3dFilter = 8 * kRoundoff;

/// The same for orient2d: (3 + 16 u) u, rounded up to 4 u.
inline constexpr double kOrient2dFilter = 4 * kRoundoff;

/// Added to both bounds for products that underflow: with coordinates up to kLargestCoordinate an
/// underflowed product contributes at most 6 * 2^-1074 * 2e100 < 1e-220.
inline constexpr double kUnderflowBound = 1e-200;

/// Methods that decide contact by rounded coordinates call bodies nearer than this touching [mm].
/// A vertex of three planes of a hull some 100 mm wide carries about 1e-13 mm of rounding, a
/// hundred times that where planes meet at 1 degree; nothing the trainer shows or feels is below
/// 1e-6 mm.
inline constexpr double kContactToleranceMm = 1e-9;

/// A ratio of 3 x 3 determinants of unit normals below this is rounding: its own error is a few
/// kRoundoff over a determinant of about 1e-4 (facets meeting at 1 degree). Ignoring so small a
/// weight moves the contact interval program's verdict by at most 1e-11 times the bodies' size (200
/// mm), within twice kContactToleranceMm.
inline constexpr double kLeastLpWeight = 1e-11;

/// Boxes of moved bodies grow by this times the sizes that enter: (9 + 7) u for the rounded pose of
/// one body as another sees it (survey::relative_pose), 8 u for the box's own sums of six
/// products, and as much again for bodies far from the origin.
inline constexpr double kMovedBoxRounding = 32 * kRoundoff;

/// Volumes in a tree of triangles are taken as apart only by more than this times the sizes that
/// enter: 12 u for the coordinates of moved corners, some 30 u for moving and comparing volumes,
/// the rest for axes that are not quite orthonormal; about 5e-12 mm for a wrist.
inline constexpr double kVolumeRounding = 256 * kRoundoff;

}  // namespace carpus
