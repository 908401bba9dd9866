// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether a new snapshot shows anything that the picture does not: a still hand costs no drawing.
import type { SnapshotMessage, Vec3 } from "../protocol";

/** Less is not seen: a tenth of a pixel at the closest look [mm], and of a 100 mm shaft [1]. */
const SEEN_MM = 0.002;
const SEEN_TURN = 0.0002;
/** The arrow's length says no less [N]. */
const SEEN_N = 0.05;

function apart(a: Vec3, b: Vec3, seen: number): boolean {
  return (
    Math.abs(a[0] - b[0]) > seen || Math.abs(a[1] - b[1]) > seen || Math.abs(a[2] - b[2]) > seen
  );
}

export function looksDifferent(a: SnapshotMessage, b: SnapshotMessage): boolean {
  return (
    a.instrument !== b.instrument ||
    a.wire_engaged !== b.wire_engaged ||
    a.screw_index !== b.screw_index ||
    a.touching !== b.touching ||
    apart(a.tip_mm, b.tip_mm, SEEN_MM) ||
    apart(a.shaft, b.shaft, SEEN_TURN) ||
    (b.wire_engaged && wireLooksDifferent(a, b)) ||
    (b.touching && contactLooksDifferent(a, b))
  );
}

function wireLooksDifferent(a: SnapshotMessage, b: SnapshotMessage): boolean {
  return (
    apart(a.wire_tip_mm, b.wire_tip_mm, SEEN_MM) ||
    apart(a.wire_entry_mm, b.wire_entry_mm, SEEN_MM) ||
    apart(a.wire_direction, b.wire_direction, SEEN_TURN) ||
    Math.abs(a.screw_advance_mm - b.screw_advance_mm) > SEEN_MM ||
    a.screw_length_mm !== b.screw_length_mm
  );
}

function contactLooksDifferent(a: SnapshotMessage, b: SnapshotMessage): boolean {
  return (
    apart(a.force_n, b.force_n, SEEN_N) || apart(a.contact_normal, b.contact_normal, SEEN_TURN)
  );
}
